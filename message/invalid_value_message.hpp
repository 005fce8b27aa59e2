// Error messages for values out of range: "wind_speed_mps -3 is out of range (0, 60]".
#pragma once

#include <string>
#include <string_view>
#include <type_traits>

#include "pelagic/message/number_text.hpp"
#include "pelagic/message/numeric_field.hpp"
#include "pelagic/message/one_line.hpp"

namespace pelagic {

/// Returns "NAME VALUE is out of range ACCEPTED" if `accepted` begins with an interval, such as
/// "(0, 60] m/s"; otherwise "NAME is VALUE, expected ACCEPTED". The message is one line of at most
/// max_line_bytes, escaped by one_line().
///
/// \param name      name of the option or field
/// \param value     a number, or the text of the input
/// \param accepted  accepted range or list of values
template <class Value>
std::string invalid_value_message(std::string_view name, const Value& value, std::string_view accepted) {
    // "(n, 2)" is a shape, not an interval.
    const bool is_interval = accepted.starts_with('[') || accepted.starts_with("(0") || accepted.starts_with("(-");
    std::string text(name);
    text += is_interval ? " " : " is ";
    if constexpr (std::is_arithmetic_v<Value>)
        append_number(text, value);
    else
        text += value;
    return one_line(text.append(is_interval ? " is out of range " : ", expected ").append(accepted));
}

/// Checks the fields in the order of the table. Returns the invalid_value_message() of the first
/// field that does not accept its value, or an empty string.
template <class Options, class Fields>
std::string check_fields(const Options& options, const Fields& fields) {
    for (const NumericField<Options>& field : fields) {
        if (field.accepts(field.value_in(options))) continue;
        return std::visit([&](auto at) { return invalid_value_message(field.name, options.*at, field.accepted); },
                          field.member);
    }
    return {};
}

/// Checks a list of records. Returns for the first invalid one "systems[1].height_m -1 is out of
/// range [0, 30]", or an empty string.
/// \param name   name of the list
/// \param check  returns a message about a record, or an empty string
template <class Records, class Check>
std::string check_records(std::string_view name, const Records& records, const Check& check) {
    for (std::size_t i = 0; i < records.size(); ++i)
        if (const std::string reason = check(records[i]); !reason.empty())
            return std::string(name) + "[" + number_text(i) + "]." + reason;
    return {};
}

}  // namespace pelagic
