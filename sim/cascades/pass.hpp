// The two computations of a cascade that may be in flight at once: a frame's, and a foam tick's.
#pragma once

#include <array>
#include <cstddef>

namespace pelagic {

/// A tick's displacement is stored where the frame's will be: a frame's stages run after those of its tick.
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
