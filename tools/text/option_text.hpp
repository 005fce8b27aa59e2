// Parsing of option values: decimal numbers and named values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/message/enum_names.hpp"
#include "pelagic/message/near_names.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {

/// Parses the whole text as a finite decimal number, in any locale with a decimal point. Returns
/// none for anything else (NaN, inf, hex, units).
std::optional<double> parse_number(std::string_view text);

/// Parses "4", "4s" or "2min", with or without a blank before the unit. Returns seconds, or none for
/// anything else.
std::optional<double> parse_seconds(std::string_view text);

/// Parses the whole text as a decimal integer. Returns none if the value is out of range of
/// std::int64_t.
std::optional<std::int64_t> parse_integer(std::string_view text);

/// Returns the number. Throws InputError "OPTION is TEXT, expected ACCEPTED" unless it lies in
/// [min, max].
double number_in(const std::string& option, const std::string& text, double min, double max,
                 const std::string& accepted);

/// Returns the whole number. Throws InputError "OPTION is TEXT, expected a whole number from MIN to
/// MAX" unless it lies in [min, max].
int whole_number_in(const std::string& option, const std::string& text, int min, int max);

/// Returns the error "OPTION is TEXT, expected a, b or c (the nearest is b)".
template <class Names>
InputError unknown_name(const std::string& option, const std::string& text, const Names& names) {
    return bad_value(option, text, list_of(names) + nearest_hint(text, names));
}

/// Returns the value with the name `text`. Throws unknown_name() if there is none.
template <NamedEnum Enum>
Enum one_of(const std::string& option, const std::string& text) {
    if (const auto value = value_named<Enum>(text)) return *value;
    throw unknown_name(option, text, names_of<Enum>());
}

/// Returns "a|b|c", the type of an option with named values in help texts.
template <class Names>
std::string alternatives(const Names& names) {
    std::string text;
    for (const auto& name : names) text.append(text.empty() ? "" : "|").append(name);
    return text;
}

/// Returns the text without the spaces, tabs and carriage returns at its ends.
std::string_view trimmed(std::string_view text);

/// Splits "a,b" into {"a", "b"}. Empty pieces are kept.
std::vector<std::string> split_at_commas(std::string_view text);

/// Parses "9", "9m/s", "20kn", "20knots", "40km/h", "25mph" or "bft6", with or without a blank
/// before the unit. Returns m/s, or none for anything else.
/// A force B of the Beaufort scale, 1 to 12, is 0.836 B^(3/2) m/s, the mean speed 10 m above the
/// sea (World Meteorological Organization, The Beaufort Scale of Wind Force, Marine Science Affairs
/// report 3, 1970).
std::optional<double> parse_speed_mps(std::string_view text);
inline constexpr const char* speed_units = "m/s, or with a unit such as 20kn, 20knots, 40km/h, 25mph, bft6";

/// Parses "from-NW" or "to-SE": one of the 16 compass points, north along -z. Returns the angle of
/// --wind-direction, in degrees: the direction towards which the wind blows, from +x (east) towards
/// +z (south). None for anything else.
std::optional<double> parse_compass_deg(std::string_view text);

/// Returns true for a compass point such as "NW" without "from-" or "to-", which is ambiguous.
bool is_compass_point(std::string_view text);

}  // namespace pelagic::tools
