// A numeric field of a C struct, as options.g.hpp lists them.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace pelagic::godot4 {

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();
inline constexpr double unlimited = std::numeric_limits<double>::infinity();
inline constexpr double degree = 3.14159265358979323846 / 180;

enum class Kind { real, whole, natural, power, choice };  ///< power: a power of two; choice: one of names

struct Option {
    const char* name;
    Kind kind;
    std::size_t offset;  ///< in the struct
    double min, max;
    bool is_above;         ///< min itself is not accepted
    double also;           ///< an accepted value out of the range, or none
    double unit;           ///< value of the field over that of the option
    const char* accepted;  ///< in messages
    const char* names;     ///< of the values of a choice, with commas between

    bool is_real() const { return kind == Kind::real; }
    bool accepts(double value) const {
        if (value == also) return true;
        if (!(value >= min && value <= max) || (is_above && value == min) || std::isinf(value)) return false;
        if (!is_real() && value != std::floor(value)) return false;
        const auto bits = static_cast<std::uint64_t>(value);
        return kind != Kind::power || (bits & (bits - 1)) == 0;
    }
    double read(const void* from) const {
        if (unit != 1) return std::round(member<double>(from) / unit * 1e9) / 1e9;  // degrees as they were set
        if (is_real()) return member<double>(from);
        if (kind == Kind::natural) return member<std::uint32_t>(from);
        return member<std::int32_t>(from);
    }
    /// \pre accepts(value)
    void write(void* to, double value) const {
        if (is_real()) return set(to, value * unit);
        if (kind == Kind::natural) return set(to, static_cast<std::uint32_t>(value));
        set(to, static_cast<std::int32_t>(value));
    }

   private:
    template <class T>
    T member(const void* from) const {
        T value;
        std::memcpy(&value, static_cast<const char*>(from) + offset, sizeof value);
        return value;
    }
    template <class T>
    void set(void* to, T value) const {
        std::memcpy(static_cast<char*>(to) + offset, &value, sizeof value);
    }
};

}  // namespace pelagic::godot4
