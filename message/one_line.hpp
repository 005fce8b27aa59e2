// Messages stay one line that a terminal shows as it is, whatever text from outside stands in them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pelagic {

/// Most bytes of one_line(): with the program's name before it, a message stays under 300.
inline constexpr std::size_t most_line_bytes = 280;

namespace line_detail {

/// Bytes of the well-formed character that begins at `at`, 0 if none does. RFC 3629.
inline std::size_t character_bytes(std::string_view text, std::size_t at) {
    const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
    const std::uint8_t lead = byte(at);
    if (lead < 0x80) return 1;
    const std::size_t bytes = lead >= 0xc2 && lead < 0xe0 ? 2 : lead >= 0xe0 && lead < 0xf0 ? 3 : 4;
    if (lead < 0xc2 || lead > 0xf4 || at + bytes > text.size()) return 0;
    std::uint32_t code = lead & (0xffu >> (bytes + 1));
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(at + i) & 0xc0) != 0x80) return 0;
        code = code << 6 | (byte(at + i) & 0x3fu);
    }
    constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = code >= 0xd800 && code < 0xe000;
    return code < least[bytes] || code > 0x10ffff || is_surrogate ? 0 : bytes;
}

/// Control characters of ASCII and of Latin 1 (a terminal takes U+009B for an escape), and the two line separators.
inline bool is_control(std::string_view character) {
    if (character.size() == 1) return static_cast<std::uint8_t>(character[0]) < 0x20 || character[0] == 0x7f;
    return (character[0] == '\xc2' && static_cast<std::uint8_t>(character[1]) < 0xa0) ||
           character == "\xe2\x80\xa8" || character == "\xe2\x80\xa9";
}

}  // namespace line_detail

/// Calls write(characters) with the text piece by piece: control characters and bytes that are no UTF-8 as \n or \x1b. Needs
/// no memory, for messages that say that there is none.
template <class Write>
void write_escaped(std::string_view text, Write write) {
    constexpr std::string_view digits = "0123456789abcdef";
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t bytes = line_detail::character_bytes(text, at);
        const std::string_view character = text.substr(at, bytes == 0 ? 1 : bytes);
        at += character.size();
        if (bytes > 0 && !line_detail::is_control(character)) {
            write(character);
        } else if (character == "\n") {
            write("\\n");
        } else {
            for (const char c : character) {
                const auto code = static_cast<std::uint8_t>(c);
                const char escape[] = {'\\', 'x', digits[code >> 4], digits[code & 15]};
                write(std::string_view(escape, sizeof escape));
            }
        }
    }
}

/// The text escaped, and cut in its middle if it is long: what it begins with, "--wind-speed is ...", and what it ends
/// with, "... needs (0, 60]", both say what to do. A line stays as it is.
///
/// \param line  room for most_line_bytes
/// \return bytes written
inline std::size_t write_one_line(std::string_view text, char* line) {
    constexpr std::string_view gap = " ... ";
    constexpr std::size_t most_head = 140, most_tail = most_line_bytes - most_head - gap.size();
    std::size_t all = 0;
    write_escaped(text, [&](std::string_view piece) { all += piece.size(); });

    std::size_t at = 0, length = 0;
    bool has_gap = false;
    write_escaped(text, [&](std::string_view piece) {
        const auto put = [&](std::string_view part) { length += part.copy(line + length, part.size()); };
        const std::size_t begin = at;
        at += piece.size();
        if (all <= most_line_bytes || (at <= most_head && !has_gap) || begin + most_tail >= all) return put(piece);
        if (!has_gap) put(gap);
        has_gap = true;
    });
    return length;
}

inline std::string one_line(std::string_view text) {
    std::string line(most_line_bytes, '\0');
    line.resize(write_one_line(text, line.data()));
    return line;
}

}  // namespace pelagic
