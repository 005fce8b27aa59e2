// Shading tiers: how much time the shader may spend on a pixel of water.
#pragma once

#include <array>
#include <string_view>

#include "pelagic/message/enum_names.hpp"

namespace pelagic::gl {

/// Tier of shading. `headset` takes at most 8 texture samples per pixel, for nine million pixels
/// drawn 72 times a second. docs/rendering.md lists the maximum of the other tiers and what each
/// omits.
enum class Shading { headset, medium, high };

}  // namespace pelagic::gl

namespace pelagic {

template <>
struct EnumNames<gl::Shading> {
    static constexpr std::array<std::string_view, 3> all = {"headset", "medium", "high"};
};

}  // namespace pelagic
