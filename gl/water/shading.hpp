// Shading tiers: how much time the shader may spend on a pixel of water.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace pelagic::gl {

/// Tier of shading. `headset` takes at most 8 texture samples per pixel, for nine million pixels
/// drawn 72 times a second. docs/architecture.md lists the maximum of the other tiers and what each
/// omits.
enum class Shading { headset, medium, high };

inline constexpr std::array<std::string_view, 3> shading_names = {"headset", "medium", "high"};

constexpr std::string_view name_of(Shading shading) { return shading_names[static_cast<std::size_t>(shading)]; }

constexpr std::optional<Shading> shading_named(std::string_view name) {
    for (std::size_t i = 0; i < shading_names.size(); ++i)
        if (shading_names[i] == name) return static_cast<Shading>(i);
    return std::nullopt;
}

}  // namespace pelagic::gl
