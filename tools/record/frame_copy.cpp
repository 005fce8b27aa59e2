#include "pelagic/tools/record/frame_copy.hpp"

#include <cstddef>
#include <span>
#include <utility>

#include "pelagic/sim/frame_buffers.hpp"

namespace pelagic::tools {
namespace {

/// Replaces views of an ocean by views of copies. The bindings name every member of a type: a new
/// member does not compile before it is treated here.
class ViewCopier {
   public:
    explicit ViewCopier(std::vector<std::shared_ptr<const void>>& memory) : memory_(memory) {}

    void copy_views(Cascade& cascade) {
        auto& [grid, dx, height, dz, velocity_x, velocity_y, velocity_z, folds, contraction, displacement, gradient,
               slopes, moments, slope_ranges, compression, snapshots, snapshots_version, drift_columns,
               drift_rows, compression_scale, slope_variance, bounds] = cascade;
        auto& [blocks, around, largest_m, stretch, steepness] = contraction;
        copy_planes(dx, height, dz, velocity_x, velocity_y, velocity_z);
        copy(folds, blocks, around, gradient, compression);
        for (auto& image : snapshots) copy(image);
        displacement = {};
        slopes = moments = {};
    }
    /// Copies all views but those of cascades.
    void copy_views(Frame& frame) {
        auto& [time_s, sea, statistics, isa, cascades, bounds, dynamic_waves, shore, has_foam, foam, water_frame] =
            frame;
        auto& [resolution, grid_texel_m, first_x, first_z, grid_height, vertical_velocity, grid_foam, grid_min_m,
               grid_max_m] = dynamic_waves;
        copy(grid_height, vertical_velocity, grid_foam);
        auto& [columns, rows, texel_m, x_m, z_m, depth, weights, height, velocity, potential, reach, shore_foam,
               min_m, max_m, weights_change] = shore;
        copy(depth, weights, height, velocity, potential, reach, shore_foam);
    }

   private:
    template <class... Texels>
    void copy(std::span<const Texels>&... views) {
        (copy_view(views), ...);
    }
    template <class Texel>
    void copy_view(std::span<const Texel>& view) {
        if (view.empty()) return;
        const auto copied = std::make_shared<const std::vector<Texel>>(view.begin(), view.end());
        memory_.push_back(copied);
        view = *copied;
    }
    template <class... Planes>
    void copy_planes(Planes&... planes) {
        (copy_plane_view(planes), ...);
    }
    void copy_plane_view(PlaneView& plane) {
        if (!plane.data) return;
        const int side = plane.resolution;
        const auto copied =
            std::make_shared<std::vector<float>>(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
        copy_plane(plane, *copied);
        memory_.push_back(copied);
        plane = {copied->data(), side, side, side, 0};
    }

    std::vector<std::shared_ptr<const void>>& memory_;
};

}  // namespace

FrameCopy::FrameCopy(const Frame& frame) : frame_(frame), cascades_(frame.cascades.begin(), frame.cascades.end()) {
    ViewCopier copier(memory_);
    copier.copy_views(frame_);
    for (Cascade& cascade : cascades_) copier.copy_views(cascade);
    frame_.cascades = cascades_;
}

}  // namespace pelagic::tools
