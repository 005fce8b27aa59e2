#include "pelagic/tools/maps/name_pattern.hpp"

#include <algorithm>
#include <charconv>

namespace pelagic::tools {
namespace {

constexpr std::size_t max_pattern_length = 100, max_digits = 9;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter_or_digit(char c) { return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Returns true for a character that separates a name from a mark or a number, as in "wave." and
/// "wave_".
bool is_separator(char c) { return c == '.' || c == '_' || c == '-'; }

struct Field {
    std::size_t begin = 0, end = 0, digits = 0;
};

/// Returns the number field if the text has exactly one.
std::optional<Field> number_field_in(std::string_view text) {
    const std::size_t begin = text.find_first_of("#%");
    if (begin == std::string_view::npos) return {};
    Field field{begin, begin, 1};
    if (text[begin] == '#') {
        field.end = std::min(text.find_first_not_of('#', begin), text.size());
        field.digits = field.end - begin;
    } else {
        std::size_t at = begin + 1;
        if (at + 1 < text.size() && text[at] == '0' && is_digit(text[at + 1]) && text[at + 1] != '0') {
            field.digits = static_cast<std::size_t>(text[at + 1] - '0');
            at += 2;
        }
        if (at >= text.size() || text[at] != 'd') return {};
        field.end = at + 1;
    }
    const bool is_only_one = text.find_first_of("#%", field.end) == std::string_view::npos;
    return is_only_one && field.digits <= max_digits ? std::optional(field) : std::nullopt;
}

std::string padded_number(int frame, std::size_t digits) {
    std::string number = std::to_string(frame);
    return std::string(digits > number.size() ? digits - number.size() : 0, '0') + number;
}

}  // namespace

bool NamePattern::is_meant(std::string_view text) { return text.find_first_of("#%") != std::string_view::npos; }

std::optional<NamePattern> NamePattern::parse(std::string_view text) {
    const auto field = number_field_in(text);
    if (!field || text.size() > max_pattern_length || text.front() == '.' || text.front() == '-') return {};
    const auto is_plain = [](char c) { return c > ' ' && c < 127 && c != '/' && c != '\\'; };
    if (!std::all_of(text.begin(), text.end(), is_plain)) return {};
    const std::string_view end = text.substr(field->end);
    if (end.size() < 2 || end[0] != '.' || !std::all_of(end.begin() + 1, end.end(), is_letter_or_digit)) return {};
    NamePattern pattern;
    pattern.before_ = text.substr(0, field->begin);
    pattern.digits_ = field->digits;
    pattern.extension_ = end.substr(1);
    return pattern;
}

std::string NamePattern::name(std::string_view mark, int frame, std::string_view extension) const {
    std::string name = before_;
    if (!mark.empty()) {
        // "wave.####" has a separator; "wave####" needs one before the mark; "####" needs one after
        // the mark only.
        const char separator = !before_.empty() && is_separator(before_.back()) ? before_.back() : '.';
        if (!name.empty() && name.back() != separator) name += separator;
        name.append(mark) += separator;
    }
    name += padded_number(frame, digits_);
    return name.append(".").append(extension);
}

std::optional<NamePattern::Parts> NamePattern::parts_of(std::string_view text) const {
    const std::size_t dot = text.rfind('.');
    if (dot == std::string_view::npos || !text.starts_with(before_)) return {};
    const std::size_t number_begin = text.find_last_not_of("0123456789", dot - 1) + 1;
    const std::string_view digits = text.substr(number_begin, dot - number_begin);
    int frame = 0;
    if (digits.empty() || digits.size() > max_digits || number_begin < before_.size()) return {};
    std::from_chars(digits.data(), digits.data() + digits.size(), frame);
    Parts parts{.mark = text.substr(before_.size(), number_begin - before_.size()),
                .extension = text.substr(dot + 1)};
    while (!parts.mark.empty() && is_separator(parts.mark.front())) parts.mark.remove_prefix(1);
    while (!parts.mark.empty() && is_separator(parts.mark.back())) parts.mark.remove_suffix(1);
    // The parsing above is lenient, so the name is composed again and compared.
    if (name(parts.mark, frame, parts.extension) != text) return {};
    return parts;
}

std::string NamePattern::text() const { return before_ + std::string(digits_, '#') + "." + extension_; }

}  // namespace pelagic::tools
