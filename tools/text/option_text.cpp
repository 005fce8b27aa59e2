#include "pelagic/tools/text/option_text.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
    if (text.starts_with("+-")) return {};
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

struct SpeedUnit {
    std::string_view name;
    double mps;
};

/// The international knot and mile (1852 m an hour, 1609.344 m an hour).
constexpr double knot_mps = 1852.0 / 3600;
constexpr std::array speed_table = {SpeedUnit{"m/s", 1.0},        SpeedUnit{"km/h", 1000.0 / 3600},
                                    SpeedUnit{"kn", knot_mps},    SpeedUnit{"knot", knot_mps},
                                    SpeedUnit{"knots", knot_mps}, SpeedUnit{"mph", 1609.344 / 3600}};

constexpr std::array<std::string_view, 16> compass = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                                      "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};

/// Returns the index of the compass point, clockwise from north, in units of 22.5 degrees.
std::optional<int> compass_point(std::string_view text) {
    const auto found = std::find(compass.begin(), compass.end(), text);
    if (found == compass.end()) return {};
    return static_cast<int>(found - compass.begin());
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    const auto value = parse_whole<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> parse_seconds(std::string_view text) {
    const bool are_minutes = text.ends_with("min");
    if (are_minutes || text.ends_with('s')) {
        text.remove_suffix(are_minutes ? 3 : 1);
        if (text.ends_with(' ')) text.remove_suffix(1);
    }
    const auto number = parse_number(text);
    if (!number) return {};
    return are_minutes ? *number * 60 : *number;
}

std::optional<std::int64_t> parse_integer(std::string_view text) { return parse_whole<std::int64_t>(text); }

double number_in(const std::string& option, const std::string& text, double min, double max,
                 const std::string& accepted) {
    const auto value = parse_number(text);
    if (!value || *value < min || *value > max) throw bad_value(option, text, accepted);
    return *value;
}

int whole_number_in(const std::string& option, const std::string& text, int min, int max) {
    const auto value = parse_integer(text);
    if (!value || *value < min || *value > max)
        throw bad_value(option, text, "a whole number from " + number_text(min) + " to " + number_text(max));
    return static_cast<int>(*value);
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> split_at_commas(std::string_view text) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

std::optional<double> parse_speed_mps(std::string_view text) {
    if (text.starts_with("bft")) {
        const auto force = parse_integer(text.substr(3));
        if (!force || *force < 1 || *force > 12) return {};
        const auto b = static_cast<double>(*force);
        return 0.836 * (b * std::sqrt(b));
    }
    double scale = 1;
    for (const SpeedUnit& unit : speed_table) {
        if (!text.ends_with(unit.name)) continue;
        text.remove_suffix(unit.name.size());
        if (text.ends_with(' ')) text.remove_suffix(1);
        scale = unit.mps;
        break;
    }
    const auto number = parse_number(text);
    if (!number) return {};
    return *number * scale;
}

std::optional<double> parse_compass_deg(std::string_view text) {
    const bool comes_from = text.starts_with("from-");
    if (!comes_from && !text.starts_with("to-")) return {};
    const auto point = compass_point(text.substr(text.find('-') + 1));
    if (!point) return {};
    const int towards = (*point + (comes_from ? 8 : 0)) % 16;
    // A bearing is measured from north, -z; the result from east, +x. Both increase clockwise.
    return towards * 22.5 - 90;
}

bool is_compass_point(std::string_view text) { return compass_point(text).has_value(); }

}  // namespace pelagic::tools
