// How much a pixel of water may cost.
#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace pelagic::gl {

/// Look-ups of textures that a pixel takes at most: 8 for a headset, whose nine million pixels are drawn 72 times a second; docs/architecture.md
/// has the others and what each tier leaves out.
enum class Shading { headset, medium, high };

inline constexpr std::array<std::string_view, 3> shading_names = {"headset", "medium", "high"};

constexpr std::string_view name_of(Shading shading) { return shading_names[static_cast<std::size_t>(shading)]; }

constexpr std::optional<Shading> shading_named(std::string_view name) {
    for (std::size_t i = 0; i < shading_names.size(); ++i)
        if (shading_names[i] == name) return static_cast<Shading>(i);
    return std::nullopt;
}

}  // namespace pelagic::gl
