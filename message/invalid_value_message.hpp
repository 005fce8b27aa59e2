// What is said of a value that can't be taken: "wind_speed_mps is -3, needs (0, 60]".
#pragma once

#include <string>
#include <string_view>
#include <type_traits>

#include "pelagic/message/number_text.hpp"
#include "pelagic/message/numeric_field.hpp"
#include "pelagic/message/one_line.hpp"

namespace pelagic {

/// \param name      of the option or field
/// \param value     a number, or a text as it was given
/// \param accepted  a range or a list
/// One line of at most max_line_bytes, whatever is in the parts.
template <class Value>
std::string invalid_value_message(std::string_view name, const Value& value, std::string_view accepted) {
    std::string text(name);
    text += " is ";
    if constexpr (std::is_arithmetic_v<Value>)
        append_number(text, value);
    else
        text += value;
    return one_line(text.append(", needs ").append(accepted));
}

/// Empty if every field accepts its value, else the invalid_value_message of the first that doesn't. The table's order is that of checks.
template <class Options, class Fields>
std::string check_fields(const Options& options, const Fields& fields) {
    for (const NumericField<Options>& field : fields) {
        if (field.accepts(field.value_in(options))) continue;
        return std::visit([&](auto at) { return invalid_value_message(field.name, options.*at, field.accepted); },
                          field.member);
    }
    return {};
}

}  // namespace pelagic
