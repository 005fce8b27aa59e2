// Foam of the sum of cascades, from snapshots of their compression.
//
// Water breaks where the sum of all cascades contracts it most, so foam is no property of a single
// cascade. Each cascade therefore holds bytes of its own compression, now and at 16 past moments,
// and the reader adds the cascades moment by moment:
//
//   q_i(x, t) = -w_i (Dx,x + Dz,z + front . grad h) / sigma    of cascade i
//   S_k(x) = sum_i q_i(x - v (t - t_k), t_k)                   v: the drift of the foam
//   foam(x) = max_k [clamp(1/2 + (S_k - level) / ramp, 0, 1) - age_k]
//
// The trace of the gradient is used instead of the Jacobian, because it adds over cascades. The front
// is a factor along the wind, 0 without lean, which moves foam from crests towards the faces in front
// of them (spectrum/foam_front.hpp). sigma is the standard deviation of the sum of the
// w_i (Dx,x + Dz,z + front . grad h), so that S is a normal variable,
// and the level follows from the whitecap cover in closed form (foam/accumulation.hpp). Foam of 1
// is breaking now; foam of 1/2 broke about 1.4 s ago.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace pelagic {

/// Foam of a square that is too large to resolve the waves that break.
///
/// The mean of S over the square has less variance than S, and a threshold of the mean is not the
/// mean of the thresholds. Let s be the standard deviation of what the mean leaves out. The water
/// under a mean of S has the cover 1 - exp(-N), where ln N = a + b x + c x^2 with x = (level - S) /
/// s, clamped to [0, 8] (foam/accumulation.hpp). Over snapshots, N is the mean with the weights
/// 1 - age. The foam of the square is the larger of this cover and the foam of the means, which a
/// reader may blend near a deviation of 0.3.
struct FoamFilter {
    float deviation = 0;  ///< s, in deviations of S
    float a = -50, b = 0, c = 0;

    /// Filters of squares of 0.25 m, 0.5 m and so on. The square may be a texel of a mip level.
    static constexpr std::size_t widths = 12;
    static constexpr double first_width_m = 0.25;
};

/// Resolves foam from the sums of a frame's cascades.
struct SnapshotFoam {
    /// Snapshots are in the four bytes of the texels of four images: slot s is byte s % 4, from the
    /// lowest up, of image s / 4. Images 0 and 1 hold every second snapshot, so a reader may use
    /// these two alone.
    static constexpr std::size_t images = 4, slots = 16;
    /// A byte b stands for q = lowest + b step.
    static constexpr float lowest = -3, step = 8.f / 255;
    /// Range of S from no foam to full foam, in standard deviations.
    static constexpr float ramp = 0.3f;

    /// S of half foam, in standard deviations; SeaStatistics::no_foam_level if nothing breaks.
    float level = 1000;
    /// Foam that has decayed since each snapshot. A slot of age 1 or more has no effect.
    std::array<float, slots> age = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};

    /// Returns the slot of the snapshot of foam tick `number`.
    static constexpr std::size_t slot_of(std::int64_t number) {
        return static_cast<std::size_t>((number & 1) * 8 + (number >> 1 & 7));
    }
    /// Returns the compression q that a byte stands for.
    static constexpr float value_of(std::uint8_t byte) { return lowest + step * static_cast<float>(byte); }
    /// Returns the foam of water that breaks with this sum, [0, 1].
    float fresh(float sum) const { return std::clamp(0.5f + (sum - level) * (1 / ramp), 0.f, 1.f); }
};

}  // namespace pelagic
