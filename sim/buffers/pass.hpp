// The two computations of a cascade that may be in flight together: of a frame, and of a foam tick.
#pragma once

#include <array>
#include <cstddef>

namespace pelagic {

/// Both passes write displacement to one buffer, so a frame's stages run after those of its tick.
enum class Pass { tick, frame };
inline constexpr std::size_t passes = 2;

/// One value for each pass.
template <class T>
struct OfEachPass {
    T& operator[](Pass pass) { return values[static_cast<std::size_t>(pass)]; }
    const T& operator[](Pass pass) const { return values[static_cast<std::size_t>(pass)]; }
    std::array<T, passes> values{};
};

}  // namespace pelagic
