// Names of enum values: the same in options, files and bindings.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace pelagic {

/// The names of an enum whose values are 0, 1, 2, ... Specialised beside the enum, with a member
/// `all`, an array of names in the order of the values.
template <class Enum>
struct EnumNames {};

template <class Enum>
concept NamedEnum = std::is_enum_v<Enum> && requires {
    EnumNames<Enum>::all.size();
};

/// Returns the name of a value.
template <NamedEnum Enum>
constexpr std::string_view name_of(Enum value) {
    return EnumNames<Enum>::all[static_cast<std::size_t>(value)];
}

/// Returns the names of all values, in their order.
template <NamedEnum Enum>
constexpr const auto& names_of() {
    return EnumNames<Enum>::all;
}

/// Returns all values, in their order.
template <NamedEnum Enum>
constexpr auto values_of() {
    std::array<Enum, EnumNames<Enum>::all.size()> values{};
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<Enum>(i);
    return values;
}

/// Returns the value with this name, if there is one.
template <NamedEnum Enum>
constexpr std::optional<Enum> value_named(std::string_view name) {
    const auto& names = names_of<Enum>();
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) return {};
    return static_cast<Enum>(found - names.begin());
}

}  // namespace pelagic
