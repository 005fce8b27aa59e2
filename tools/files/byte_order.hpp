// Conversion between numbers and bytes in the byte order of a file format, on machines of either
// byte order.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace pelagic::tools {

using Bytes = std::vector<unsigned char>;

template <std::endian Order, class Number>
void append_number_bytes(Bytes& bytes, Number number) {
    auto all = std::bit_cast<std::array<unsigned char, sizeof(Number)>>(number);
    if constexpr (std::endian::native != Order) std::reverse(all.begin(), all.end());
    bytes.insert(bytes.end(), all.begin(), all.end());
}

/// Appends the bytes of the number, least significant first.
template <class Number>
void append_little_endian(Bytes& bytes, Number number) {
    append_number_bytes<std::endian::little>(bytes, number);
}

/// Appends each word as 4 bytes, least significant first.
inline void append_words(Bytes& bytes, std::initializer_list<std::size_t> words) {
    for (const std::size_t word : words) append_little_endian(bytes, static_cast<std::uint32_t>(word));
}

/// Appends the bytes of the number, most significant first.
template <class Number>
void append_big_endian(Bytes& bytes, Number number) {
    append_number_bytes<std::endian::big>(bytes, number);
}

/// Returns the number that `bytes` encode, least significant byte first.
/// \pre bytes.size() == sizeof(Number)
template <class Number>
Number little_endian(std::span<const unsigned char> bytes) {
    std::array<unsigned char, sizeof(Number)> all;
    std::copy(bytes.begin(), bytes.end(), all.begin());
    if constexpr (std::endian::native != std::endian::little) std::reverse(all.begin(), all.end());
    return std::bit_cast<Number>(all);
}

}  // namespace pelagic::tools
