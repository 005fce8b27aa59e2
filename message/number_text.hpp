// Numbers as text, the one place that writes them: messages, files and tables say what the number is, in every locale.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <string>

namespace pelagic {

/// Appends the fewest digits that read back as the same number of that type. People read 100000 more easily than 1e+05,
/// so exponents are for what is very large or very small; "nan", "inf" and "-inf" are written as such.
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

/// For people: `digits` that mean something, 1 to 17. rounded_text(7.65432, 4) is "7.654", of 1234567 "1235000".
inline std::string rounded_text(double value, int digits) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, digits - 1).ptr;
    std::from_chars(text, end, value);
    return number_text(value);
}

}  // namespace pelagic
