#include "pelagic/tools/text/typed_number.hpp"

#include <cmath>
#include <limits>

namespace pelagic::tools {

double degrees_of(double radians) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const double quotient = radians / radians_per_degree;
    for (const double degrees : {std::round(1e6 * quotient) / 1e6, quotient, std::nextafter(quotient, infinity),
                                 std::nextafter(quotient, -infinity)})
        if (degrees * radians_per_degree == radians) return degrees;
    return quotient;
}

std::string accepted_when_typed(std::string_view field, std::string accepted, bool has_also) {
    if (is_direction(field)) return "degrees in [-360, 360], or one of 16 points such as from-NW or to-SE";
    if (const std::size_t at = accepted.find(", or "); has_also) accepted.erase(at);
    if (is_duration(field)) return accepted + " s, or with a unit such as 4s, 2min";
    return is_speed(field) ? accepted + " " + speed_units : accepted;
}

std::optional<double> parse_typed(std::string_view field, bool is_whole, const std::string& text) {
    if (is_speed(field)) return parse_speed_mps(text);
    if (is_duration(field)) return parse_seconds(text);
    if (is_direction(field))
        if (const auto degrees = parse_compass_deg(text)) return degrees;
    if (is_whole && !parse_integer(text)) return {};
    return parse_number(text);
}

}  // namespace pelagic::tools
