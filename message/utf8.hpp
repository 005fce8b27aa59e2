// Validation of UTF-8.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace pelagic {

/// Returns the length in bytes of the well-formed UTF-8 character at byte `at`, or 0 if the bytes
/// there are malformed (RFC 3629). \pre at < text.size()
inline std::size_t utf8_character_bytes(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    const std::uint8_t lead = byte(at);
    if (lead < 0x80) return 1;
    const std::size_t bytes = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    if (lead < 0xc2 || lead > 0xf4 || at + bytes > text.size()) return 0;
    std::uint32_t code = lead & (0xffu >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(at + i) & 0xc0) != 0x80) return 0;
        code = code << 6 | (byte(at + i) & 0x3fu);
    }
    constexpr std::uint32_t min[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xd800 && code < 0xe000;
    return code < min[bytes] || code > 0x10ffff || is_surrogate ? 0 : bytes;
}

}  // namespace pelagic
