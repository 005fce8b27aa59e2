// Options with a fixed set of values. The command line and the records use the same names.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace pelagic::tools {

template <class Value, std::size_t count>
using NamedValues = std::array<std::pair<Value, std::string_view>, count>;

/// \pre the value has a name
template <class Value, std::size_t count>
constexpr std::string_view name_in(const NamedValues<Value, count>& names, Value value) {
    return std::find_if(names.begin(), names.end(), [&](const auto& entry) { return entry.first == value; })->second;
}

template <class Value, std::size_t count>
constexpr std::optional<Value> value_in(const NamedValues<Value, count>& names, std::string_view name) {
    const auto* entry = std::find_if(names.begin(), names.end(), [&](const auto& one) { return one.second == name; });
    return entry == names.end() ? std::nullopt : std::optional(entry->first);
}

}  // namespace pelagic::tools
