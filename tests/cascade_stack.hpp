// A hand-made stack of cascades: frames of oceans with a cascade each, rotated against one
// another.
#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <memory>
#include <vector>

#include "pelagic/sim/buffers/contraction_map.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

class CascadeStack {
   public:
    struct Part {
        SeaState sea;
        double turn_rad = 0;
        double factor = 1;  ///< multiplies all displacements
    };

    CascadeStack(const std::vector<Part>& parts, double time_s, Isa isa = choose_isa()) {
        for (const Part& part : parts) {
            Ocean ocean(part.sea, {.executor = make_serial_executor(), .isa = isa, .velocities = Velocities::drawn});
            add(ocean.frame_at(time_s).cascades[0], part);
        }
        finish(parts.front().sea, isa);
    }
    CascadeStack(const CascadeStack&) = delete;
    CascadeStack& operator=(const CascadeStack&) = delete;

    const Frame& frame() const { return frame_; }

    /// One sea per cascade, each with its own wind speed. A cascade's texel is as long as the
    /// longest waves of the next, similar to the bands of one sea.
    static std::vector<Part> of_scales(std::size_t cascades, double wind_speed_mps, double choppiness,
                                       std::uint32_t seed, int resolution = 128) {
        std::vector<Part> parts;
        double side_m = 1000 * wind_speed_mps * wind_speed_mps / 144, wind_mps = wind_speed_mps;
        for (std::size_t i = 0; i < cascades; ++i) {
            parts.push_back({.sea = {.resolution = resolution,
                                     .patch_size_m = side_m,
                                     .wind_speed_mps = wind_mps,
                                     .choppiness = choppiness,
                                     .seed = seed + static_cast<std::uint32_t>(i)},
                             .turn_rad = 0.7 * static_cast<double>(i),
                             .factor = i == 0 ? 1 : 0.8});
            side_m /= 6.7;
            wind_mps /= 2.6;
        }
        return parts;
    }

   private:
    void add(const Cascade& from, const Part& part) {
        const int n = from.resolution();
        Cascade cascade;
        cascade.grid = {
            .side_m = from.grid.side_m, .cosine = std::cos(part.turn_rad), .sine = std::sin(part.turn_rad)};
        const std::size_t floats = static_cast<std::size_t>(n / from.height.block_columns) *
                                   static_cast<std::size_t>(from.height.block_stride);
        const auto turned = [&](const PlaneView& x, const PlaneView& y, const PlaneView& z, PlaneView& to_x,
                                PlaneView& to_y, PlaneView& to_z) {
            float* const planes = planes_.emplace_back(floats).data();
            const auto view = [&](const PlaneView& plane) {
                PlaneView to = plane;
                to.data = planes + (plane.data - std::min({x.data, y.data, z.data}));
                return to;
            };
            to_x = view(x), to_y = view(y), to_z = view(z);
            for (int j = 0; j < n; ++j) {
                for (int i = 0; i < n; ++i) {
                    const std::ptrdiff_t at =
                        i / x.block_columns * x.block_stride + j * x.row_stride + i % x.block_columns;
                    const auto set = [&](const PlaneView& plane, double value) {
                        const_cast<float*>(plane.data)[at] = static_cast<float>(part.factor * value);
                    };
                    const auto moved =
                        cascade.grid.in_world(static_cast<double>(x.data[at]), static_cast<double>(z.data[at]));
                    set(to_x, moved.along);
                    set(to_y, static_cast<double>(y.data[at]));
                    set(to_z, moved.across);
                }
            }
        };
        turned(from.dx, from.height, from.dz, cascade.dx, cascade.height, cascade.dz);
        turned(from.velocity_x, from.velocity_y, from.velocity_z, cascade.velocity_x, cascade.velocity_y,
               cascade.velocity_z);
        FrameBounds& bounds = cascade.bounds;
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                bounds.height_min_m = std::min(bounds.height_min_m, cascade.height.at(i, j));
                bounds.height_max_m = std::max(bounds.height_max_m, cascade.height.at(i, j));
                bounds.horizontal_x_max_m = std::max(bounds.horizontal_x_max_m, std::fabs(cascade.dx.at(i, j)));
                bounds.horizontal_z_max_m = std::max(bounds.horizontal_z_max_m, std::fabs(cascade.dz.at(i, j)));
            }
        }
        frame_.bounds.height_min_m += bounds.height_min_m;
        frame_.bounds.height_max_m += bounds.height_max_m;
        frame_.bounds.horizontal_x_max_m += bounds.horizontal_x_max_m;
        frame_.bounds.horizontal_z_max_m += bounds.horizontal_z_max_m;
        cascades_.push_back(cascade);
    }

    void finish(const SeaState& sea, Isa isa) {
        std::vector<ContractionMap*> maps;
        for (const Cascade& cascade : cascades_) maps.push_back(&contraction_.emplace_back(cascade.resolution()));
        ContractionMap::update(cascades_, maps, kernels_for(isa));
        frame_.sea = sea;
        frame_.isa = isa;
        frame_.cascades = cascades_;
    }

    std::deque<AlignedBuffer<float>> planes_;
    std::deque<ContractionMap> contraction_;
    std::vector<Cascade> cascades_;
    Frame frame_;
};

}  // namespace pelagic
