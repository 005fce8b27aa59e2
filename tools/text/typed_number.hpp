// Numeric options as users type them, by the names of their fields: directions may be compass
// points, speeds and durations may have units, and angles are in degrees.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "pelagic/message/numeric_field.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {

inline constexpr double radians_per_degree = std::numbers::pi / 180;
inline double in_degrees(double radians) { return radians * (180 / std::numbers::pi); }

/// Returns degrees that convert to exactly these radians: rounded to 1e-6 if those do, 30 and not
/// 29.999999999999996, else the nearest that do.
double degrees_of(double radians);

inline bool is_angle(std::string_view field) { return field.ends_with("_rad"); }
inline bool is_direction(std::string_view field) { return field.ends_with("direction_rad"); }
inline bool is_speed(std::string_view field) { return field == "wind_speed_mps"; }
inline bool is_duration(std::string_view field) { return field.ends_with("_s"); }
/// Returns true if the field accepts texts such as "20kn" or "from-NW".
inline bool takes_words(std::string_view field) {
    return is_direction(field) || is_speed(field) || is_duration(field);
}

template <class Options>
bool is_whole(const NumericField<Options>& field) {
    return !std::holds_alternative<double Options::*>(field.member) &&
           !std::holds_alternative<float Options::*>(field.member);
}

/// Returns what a field accepts, for messages. An option or a file has no value for "chosen".
/// \param accepted, has_also  of NumericField
std::string accepted_when_typed(std::string_view field, std::string accepted, bool has_also);
template <class Options>
std::string accepted_when_typed(const NumericField<Options>& field) {
    return accepted_when_typed(field.name, std::string(field.accepted), field.also.has_value());
}

/// Parses a number in the unit of users: degrees of angles. Returns none for anything else.
std::optional<double> parse_typed(std::string_view field, bool is_whole, const std::string& text);

/// Sets a field and returns the number in the unit of users.
/// \param option       name and place, for messages
/// \param is_recorded  accepts the field's value for "derived", such as 0, too
/// \throws InputError  for what the field does not accept
template <class Options>
double set_typed(Options& options, const NumericField<Options>& field, const std::string& text,
                 const std::string& option, const std::string& accepted, bool is_recorded) {
    const std::optional<double> number = parse_typed(field.name, is_whole(field), text);
    if (is_direction(field.name) && is_compass_point(text))
        throw bad_value(
            option, text,
            "from-" + text + " or to-" + text + ": winds are named for where they come from, seas by where they go");
    const double value = number ? (is_angle(field.name) ? *number * radians_per_degree : *number) : 0;
    const bool is_chosen = !is_recorded && field.also == value && parse_number(text);
    if (!number || !field.accepts(value) || is_chosen) throw bad_value(option, text, accepted);
    field.set(options, value);
    return *number;
}

}  // namespace pelagic::tools
