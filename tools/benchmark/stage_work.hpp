// Minimum work of the stages of a frame, for comparison with measured times and counts.
#pragma once

#include <bit>
#include <cstddef>
#include <string_view>

namespace pelagic::tools {

/// Work per texel: floating-point operations without conversions and packing, and compulsory bytes,
/// which are the inputs and outputs, each once.
struct StageWork {
    double flops, bytes;
};

struct FrameShape {
    int cascades, resolution;
    int lanes;  ///< PlaneView::block_columns
};

/// Returns the job of a stage without its cascade: "evolve+rows" for the second cascade's stage
/// "evolve+rows c1".
inline std::string_view job_of(std::string_view stage_name) {
    const std::size_t cascade = stage_name.rfind(" c");
    const bool is_of_finer_cascade = cascade != std::string_view::npos && cascade + 3 == stage_name.size();
    return is_of_finer_cascade ? stage_name.substr(0, cascade) : stage_name;
}

/// Returns the operations per texel of the transforms in one direction. A complex transform of N
/// points counts 5 N log2 N operations, as is usual, and there are 1.5 N transforms.
inline double transform_flops(int n) { return 1.5 * 5 * (std::bit_width(static_cast<unsigned>(n)) - 1); }

/// Returns the work of a job per texel.
/// \param job  a job of a frame without queries and velocities
inline StageWork work_of(std::string_view job, const FrameShape& shape) {
    const double transforms = transform_flops(shape.resolution);
    // Half a wave per texel: 16 for the rotation, which two waves share, 6 for the height, 8 for
    // the horizontal pair.
    if (job == "evolve+rows") return {0.5 * 22 + transforms, 11 + 12};
    // Choppiness: two products.
    const StageWork columns{2 + transforms, 12 + 12};
    if (job == "columns+finalize") return columns;
    // 42 per texel (differences 6, normal 13, length 7, J 1, bytes 7, averages 8), 33 per texel of
    // the mip levels, which have a third of the texels.
    const StageWork gradients{42 + 33 / 3.0, 12 + 8 + 16 / 3.0};
    if (job == "gradients+mipmaps") return gradients;
    // 46 per texel (differences 24, slopes 6, squares 3, J and foam 5, averages 8), 48 per texel of
    // the mip levels.
    const StageWork slopes{46 + 48 / 3.0, 12 + 8 + 2 * 16 / 3.0};
    if (job == "slopes+mipmaps") return slopes;
    // Without planes. A band has 128 columns, 256 for N = 512. Four blocks of them are edges.
    const double edges = 4.0 * shape.lanes / (shape.resolution < 512 ? 128 : 256);
    if (job == "edge columns") return {edges * columns.flops, edges * columns.bytes};
    if (job == "columns+textures") {
        const StageWork& textures = shape.cascades == 1 ? gradients : slopes;
        return {(1 - edges) * columns.flops + textures.flops, textures.bytes};
    }
    // The tails: mip levels from level 4 on.
    if (job == "slopes tail") return {48.0 / 3 / 64, 2 * 16.0 / 3 / 64};
    return {33.0 / 3 / 64, 16.0 / 3 / 64};
}

}  // namespace pelagic::tools
