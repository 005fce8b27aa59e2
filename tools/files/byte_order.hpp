// Numbers as bytes of a file, in the order that its format wants, whatever the machine's own.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
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

/// Appends the number's bytes, the lowest first.
template <class Number>
void append_little_endian(Bytes& bytes, Number number) {
    append_number_bytes<std::endian::little>(bytes, number);
}

/// The same, the highest first.
template <class Number>
void append_big_endian(Bytes& bytes, Number number) {
    append_number_bytes<std::endian::big>(bytes, number);
}

/// The number whose bytes these are, the lowest first. \pre as many as it has
template <class Number>
Number little_endian(std::span<const unsigned char> bytes) {
    std::array<unsigned char, sizeof(Number)> all;
    std::copy(bytes.begin(), bytes.end(), all.begin());
    if constexpr (std::endian::native != std::endian::little) std::reverse(all.begin(), all.end());
    return std::bit_cast<Number>(all);
}

}  // namespace pelagic::tools
