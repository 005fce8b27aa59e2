// Option values as people type them: strict numbers, one of some words.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/message/near_names.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/named_values.hpp"

namespace pelagic::tools {

/// The whole text as a finite decimal number, in any locale with a point; none for anything else (NaN, inf, hex, units).
std::optional<double> parse_number(std::string_view text);

/// The whole text as a decimal integer that fits.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// The number, if it lies in [least, most]; else throws InputError: "OPTION is TEXT, needs ACCEPTED".
double number_in(const std::string& option, const std::string& text, double min, double max,
                 const std::string& accepted);

/// The same of whole numbers: "OPTION is TEXT, needs a whole number from LEAST to MOST".
int whole_number_in(const std::string& option, const std::string& text, int min, int max);

/// The value of that name; else throws InputError: "OPTION is TEXT, needs a, b or c".
template <class Value, std::size_t count>
Value one_of(const NamedValues<Value, count>& names, const std::string& option, const std::string& text) {
    if (const auto value = value_in(names, text)) return *value;
    std::vector<std::string> accepted;
    for (const auto& entry : names) accepted.emplace_back(entry.second);
    throw bad_value(option, text, list_of(accepted));
}

/// "a,b" as {"a", "b"}; empty parts stay.
std::vector<std::string> split_at_commas(std::string_view text);

}  // namespace pelagic::tools
