// What the stages of a frame have to do, whoever does it: what times and counts are held against.
#pragma once

#include <bit>
#include <cstddef>
#include <string_view>

namespace pelagic::tools {

/// Of one texel: floating-point operations without conversions and packing, and the compulsory bytes, which are those of the
/// inputs and outputs, each once.
struct StageWork {
    double flops, bytes;
};

/// The job that a stage does, of whichever cascade: "evolve+rows c1", of the second one, is "evolve+rows".
inline std::string_view job_of(std::string_view stage_name) {
    const std::size_t cascade = stage_name.rfind(" c");
    const bool is_of_finer_cascade = cascade != std::string_view::npos && cascade + 3 == stage_name.size();
    return is_of_finer_cascade ? stage_name.substr(0, cascade) : stage_name;
}

/// A complex transform of N points counts 5 N log2 N operations, as is usual; there are 1.5 N of them in each
/// direction.
inline double transform_flops(int n) { return 1.5 * 5 * (std::bit_width(static_cast<unsigned>(n)) - 1); }

/// \param job         one of a frame without queries and velocities
/// \param resolution  texels along a side of each cascade
inline StageWork work_of(std::string_view job, int resolution) {
    // Half a wave a texel: 16 for the rotation, shared by two, 6 for the height, 8 for the horizontal pair.
    if (job == "evolve+rows") return {0.5 * 22 + transform_flops(resolution), 11 + 12};
    // Choppiness: two products.
    if (job == "columns+finalize") return {2 + transform_flops(resolution), 12 + 12};
    // 44 for a texel (differences 6, normal 13, length 7, J and foam 3, bytes 7, averages 8), 33 for one of a mip, of
    // which there is a third.
    if (job == "gradients+mipmaps") return {44 + 33 / 3.0, 12 + 8 + 16 / 3.0};
    // 46 for a texel (differences 24, slopes 6, squares 3, J and foam 5, averages 8), 48 for one of a mip.
    if (job == "slopes+mipmaps") return {46 + 48 / 3.0, 12 + 8 + 2 * 16 / 3.0};
    // The tails: what is left of the mips from level 4 on.
    if (job == "slopes tail") return {48.0 / 3 / 64, 2 * 16.0 / 3 / 64};
    return {33.0 / 3 / 64, 16.0 / 3 / 64};
}

}  // namespace pelagic::tools
