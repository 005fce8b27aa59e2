// Numbers as bytes of a file, in the order that its format wants, whatever the machine's own.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>

namespace pelagic::tools {

/// Appends the number's bytes, the lowest first.
template <class Number>
void append_little_endian(std::string& bytes, Number number) {
    auto all = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    if constexpr (std::endian::native == std::endian::big) std::reverse(all.begin(), all.end());
    bytes.append(all.data(), all.size());
}

/// The same, the highest first.
template <class Number>
void append_big_endian(std::string& bytes, Number number) {
    auto all = std::bit_cast<std::array<char, sizeof(Number)>>(number);
    if constexpr (std::endian::native == std::endian::little) std::reverse(all.begin(), all.end());
    bytes.append(all.data(), all.size());
}

}  // namespace pelagic::tools
