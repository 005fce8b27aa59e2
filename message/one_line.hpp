// Escaping and truncation: a message that contains external text stays one printable line.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "pelagic/message/utf8.hpp"

namespace pelagic {

/// Maximum length of one_line() in bytes. With the program's name a message stays under 300 bytes.
inline constexpr std::size_t max_line_bytes = 280;

/// Returns true for control characters of ASCII and Latin-1 (terminals interpret U+009B as an
/// escape sequence) and for the line separators U+2028 and U+2029. \pre `character` is one UTF-8
/// character
inline bool is_control_character(std::string_view character) {
    if (character.size() == 1) return static_cast<std::uint8_t>(character[0]) < 0x20 || character[0] == 0x7f;
    return (character[0] == '\xc2' && static_cast<std::uint8_t>(character[1]) < 0xa0) ||
           character == "\xe2\x80\xa8" || character == "\xe2\x80\xa9";
}

/// Calls write(characters) for successive pieces of the text. Control characters and invalid UTF-8
/// bytes are written as \n or \x1b. Allocates no memory, so that it can report std::bad_alloc.
template <class Write>
void write_escaped(std::string_view text, Write write) {
    constexpr std::string_view digits = "0123456789abcdef";
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t bytes = utf8_character_bytes(text, at);
        const std::string_view character = text.substr(at, bytes == 0 ? 1 : bytes);
        at += character.size();
        if (bytes > 0 && !is_control_character(character)) {
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

/// Returns the text with control characters escaped, of any length: names in summaries.
inline std::string escaped(std::string_view text) {
    std::string line;
    write_escaped(text, [&](std::string_view piece) { line += piece; });
    return line;
}

/// Escapes the text and, if it exceeds max_line_bytes, replaces its middle by " ... ". Keeps the
/// beginning, "--wind-speed ...", and the end, "... is out of range (0, 60]". Allocates no memory.
///
/// \param line  buffer of at least max_line_bytes
/// \return number of bytes written
inline std::size_t write_one_line(std::string_view text, char* line) {
    constexpr std::string_view gap = " ... ";
    constexpr std::size_t max_head = 140, max_tail = max_line_bytes - max_head - gap.size();
    std::size_t all = 0;
    write_escaped(text, [&](std::string_view piece) { all += piece.size(); });

    std::size_t at = 0, length = 0;
    bool has_gap = false;
    write_escaped(text, [&](std::string_view piece) {
        const auto put = [&](std::string_view bytes) { length += bytes.copy(line + length, bytes.size()); };
        const std::size_t begin = at;
        at += piece.size();
        if (all <= max_line_bytes || (at <= max_head && !has_gap) || begin + max_tail >= all) return put(piece);
        if (!has_gap) put(gap);
        has_gap = true;
    });
    return length;
}

inline std::string one_line(std::string_view text) {
    std::string line(max_line_bytes, '\0');
    line.resize(write_one_line(text, line.data()));
    return line;
}

}  // namespace pelagic
