// Functions of C++20 that the C++ library of emscripten 3.1.6, libc++ 13, lacks; included before
// everything else (cmake/wasm.cmake). With a newer library this file is empty.
#pragma once

#if defined(__cplusplus) && __cplusplus > 201703L
#include <version>

#if _LIBCPP_VERSION < 14000
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace std {

template <class To, class From>
constexpr To bit_cast(const From& from) noexcept {
    return __builtin_bit_cast(To, from);
}

/// \pre `value` is finite and the buffer is large enough. Uses the C library to print, and to read
///     back which number of digits suffices.
template <class Number>
requires(is_floating_point_v<Number>) to_chars_result
    to_chars(char* first, char* last, Number value, chars_format format, int precision) {
    const char* const how = format == chars_format::scientific ? "%.*e"
                            : format == chars_format::fixed    ? "%.*f"
                                                               : "%.*g";
    return {first + snprintf(first, static_cast<size_t>(last - first), how, precision, static_cast<double>(value)),
            {}};
}

template <class Number>
requires(is_floating_point_v<Number>) to_chars_result
    to_chars(char* first, char* last, Number value, chars_format format) {
    int digits = 1;
    to_chars_result written{};
    do {
        written = to_chars(first, last, value, chars_format::scientific, digits - 1);
    } while (static_cast<Number>(sizeof(Number) == sizeof(float) ? strtof(first, nullptr) : strtod(first, nullptr)) !=
                 value &&
             ++digits <= 17 && value == value);
    if (format == chars_format::scientific) return written;
    if (format == chars_format::general) return to_chars(first, last, value, format, digits);
    const char* exponent = first;
    while (exponent < written.ptr && *exponent != 'e') ++exponent;
    const int decimals = exponent < written.ptr ? digits - 1 - atoi(exponent + 1) : 0;
    return to_chars(first, last, value, format, decimals > 0 ? decimals : 0);
}

}  // namespace std
#endif
#endif
