// Tables of the numeric fields of an options struct: name, member and accepted range.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

namespace pelagic {

/// Restricts the accepted values in [min, max].
enum class Restriction { none, above_min, even, powers_of_two };

/// One numeric option of a struct.
template <class Options>
struct NumericField {
    std::string_view name;  ///< name of the member, with its unit: "wind_speed_mps"
    std::variant<int Options::*, float Options::*, double Options::*, std::uint32_t Options::*> member;
    double min;
    double max;
    std::string_view accepted;  ///< text of the range: "(0, 60]", "a power of two from 16 to 2048"
    Restriction restriction = Restriction::none;
    /// One more accepted value with a special meaning, such as 0 for a default.
    std::optional<double> also = {};

    /// Returns false for NaN and infinities.
    bool accepts(double value) const {
        if (also && value == *also) return true;
        if (!(value >= min && value <= max)) return false;  // also for NaN
        if (restriction == Restriction::none) return true;
        if (restriction == Restriction::above_min) return value > min;
        const auto whole = static_cast<long long>(value);
        return static_cast<double>(whole) == value &&
               (restriction == Restriction::even ? whole % 2 == 0 : (whole & (whole - 1)) == 0);
    }

    /// Returns the value of this field as a double.
    double value_in(const Options& options) const {
        return std::visit([&](auto at) { return static_cast<double>(options.*at); }, member);
    }

    /// \pre accepts(value)
    void set(Options& options, double value) const {
        std::visit([&]<class Number>(Number Options::*at) { options.*at = static_cast<Number>(value); }, member);
    }
};

}  // namespace pelagic
