// Suggestions for misspelt names in error messages.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pelagic {

/// Joins names as "a, b or c". \tparam Names  a sequence of std::string or std::string_view
template <class Names>
std::string list_of(const Names& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i)
        list.append(i == 0 ? "" : i + 1 < names.size() ? ", " : " or ").append(names[i]);
    return list;
}

/// Returns the Levenshtein distance; only one row of its table is stored.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
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

/// Returns the first of the names with the smallest edit distance to `name`. The distance is at
/// most half of name's length and at most 3; otherwise returns no name.
template <class Names>
std::optional<std::string> near_name(std::string_view name, const Names& names) {
    std::optional<std::string> nearest;
    std::size_t min = std::min<std::size_t>(3, name.size() / 2) + 1;
    for (const std::string_view known : names) {
        // The difference in length bounds the distance from below, so long texts are skipped.
        if (name.size() >= known.size() + min) continue;
        const std::size_t distance = edit_distance(name, known);
        if (distance >= min) continue;
        min = distance;
        nearest = std::string(known);
    }
    return nearest;
}

/// Returns " (the nearest is storm)", or an empty string if near_name() finds no name.
template <class Names>
std::string nearest_hint(std::string_view name, const Names& names) {
    const auto nearest = near_name(name, names);
    return nearest ? " (the nearest is " + *nearest + ")" : "";
}

}  // namespace pelagic
