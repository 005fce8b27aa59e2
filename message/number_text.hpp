// Locale-independent conversion of numbers to text for messages, files and tables.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <string>
#include <string_view>

namespace pelagic {

/// Appends the shortest text that parses to exactly `value`. Magnitudes in [1e-4, 1e15) have no
/// exponent: 100000 instead of 1e+05. Writes "nan", "inf" and "-inf" for values that are not
/// finite.
template <std::floating_point Number>
void append_number(std::string& text, Number value) {
    char digits[64];
    const Number size = std::fabs(value);
    const bool is_plain = value == 0 || (size >= Number(1e-4) && size < Number(1e15));
    const auto format = is_plain ? std::chars_format::fixed : std::chars_format::general;
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value, format).ptr);
}

template <std::integral Number>
void append_number(std::string& text, Number value) {
    char digits[24];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, value).ptr);
}

template <class Number>
std::string number_text(Number value) {
    std::string text;
    append_number(text, value);
    return text;
}

/// Rounds to significant digits: rounded_text(7.65432, 4) is "7.654", of 1234567 "1235000".
/// \param digits  number of significant digits, 1 to 17
inline std::string rounded_text(double value, int digits) {
    if (value == 0 || !std::isfinite(value)) return number_text(value);
    // Android's C++ library cannot parse "1.2340e+02", so the digits are moved as text.
    char text[40];
    const auto end =
        std::to_chars(text, text + sizeof text, std::fabs(value), std::chars_format::scientific, digits - 1).ptr;
    const std::string_view all(text, static_cast<std::size_t>(end - text));
    const std::size_t e = all.find('e');
    int exponent = 0;
    std::from_chars(text + e + 2, end, exponent);
    if (all[e + 1] == '-') exponent = -exponent;
    std::string kept(1, all[0]);
    if (e > 2) kept += all.substr(2, e - 2);
    kept.erase(kept.find_last_not_of('0') + 1);

    const std::string sign = value < 0 ? "-" : "";
    const auto with_point = [](std::string digits_text, std::size_t whole) {
        return whole < digits_text.size() ? digits_text.insert(whole, ".") : digits_text;
    };
    if (exponent < -4 || exponent >= 15) return sign + with_point(kept, 1) + std::string(all.substr(e));
    if (exponent < 0) return sign + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + kept;
    const auto whole = static_cast<std::size_t>(exponent) + 1;
    if (kept.size() < whole) kept.append(whole - kept.size(), '0');
    return sign + with_point(kept, whole);
}

}  // namespace pelagic
