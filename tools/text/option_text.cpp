#include "pelagic/tools/text/option_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>

#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

template <class Number>
std::optional<Number> parse_whole(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return value;
}

// Levenshtein's distance, one row of the table at a time.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row.back();
}

}  // namespace

std::optional<double> parse_number(std::string_view text) {
    const auto value = parse_whole<double>(text);
    return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<std::int64_t> parse_integer(std::string_view text) { return parse_whole<std::int64_t>(text); }

double number_in(const std::string& option, const std::string& text, double least, double most,
                 const std::string& accepted) {
    const auto value = parse_number(text);
    if (!value || *value < least || *value > most) throw bad_value(option, text, accepted);
    return *value;
}

int whole_number_in(const std::string& option, const std::string& text, int least, int most) {
    const auto value = parse_integer(text);
    if (!value || *value < least || *value > most)
        throw bad_value(option, text, "a whole number from " + number_text(least) + " to " + number_text(most));
    return static_cast<int>(*value);
}

std::string list_of(std::span<const std::string> names) {
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i)
        list += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
    return list;
}

std::optional<std::string> near_name(std::string_view name, std::span<const std::string> names) {
    std::optional<std::string> nearest;
    std::size_t least = std::min<std::size_t>(3, name.size() / 2) + 1;
    for (const std::string& known : names) {
        const std::size_t distance = edit_distance(name, known);
        if (distance >= least) continue;
        least = distance;
        nearest = known;
    }
    return nearest;
}

std::string nearest_hint(std::string_view name, std::span<const std::string> names) {
    const auto nearest = near_name(name, names);
    return nearest ? " (the nearest is " + *nearest + ")" : "";
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
