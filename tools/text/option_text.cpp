#include "pelagic/tools/text/option_text.hpp"

#include <charconv>
#include <cmath>

#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
    if (text.starts_with("+-")) return {};
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    const auto value = parse_whole<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<double> parse_seconds(std::string_view text) {
    const bool are_minutes = text.ends_with("min");
    if (are_minutes || text.ends_with('s')) {
        text.remove_suffix(are_minutes ? 3 : 1);
        if (text.ends_with(' ')) text.remove_suffix(1);
    }
    const auto number = parse_number(text);
    if (!number) return {};
    return are_minutes ? *number * 60 : *number;
}

std::optional<std::int64_t> parse_integer(std::string_view text) { return parse_whole<std::int64_t>(text); }

double number_in(const std::string& option, const std::string& text, double min, double max,
                 const std::string& accepted) {
    const auto value = parse_number(text);
    if (!value || *value < min || *value > max) throw bad_value(option, text, accepted);
    return *value;
}

int whole_number_in(const std::string& option, const std::string& text, int min, int max) {
    const auto value = parse_integer(text);
    if (!value || *value < min || *value > max)
        throw bad_value(option, text, "a whole number from " + number_text(min) + " to " + number_text(max));
    return static_cast<int>(*value);
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const auto first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> split_at_commas(std::string_view text) {
    std::vector<std::string> parts(1);
    for (const char c : text) {
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

}  // namespace pelagic::tools
