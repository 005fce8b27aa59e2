// A frame of several tiles, made from frames of one tile each that belong to seas of their own.
#pragma once

#include <cmath>
#include <deque>
#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/simd/isa.hpp"
#include "pelagic/tests/kernel_slopes.hpp"

namespace pelagic {

class TileStack {
   public:
    TileStack() = default;
    TileStack(const TileStack&) = delete;
    TileStack& operator=(const TileStack&) = delete;

    /// Adds the only tile of a frame, turned by `turn_rad`, its waves too. Tiles come from the coarsest to the finest.
    void add(const Frame& one_tile, double turn_rad = 0) {
        const Tile& from = one_tile.tiles[0];
        const int n = from.resolution();
        const double c = std::cos(turn_rad), s = std::sin(turn_rad);
        Held& held = held_.emplace_back();
        held.planes = {n, from.lattice.side_m, static_cast<float>(c), static_cast<float>(s), {}, {}, {}};
        double mss = 0;
        for (int j = 0; j < n; ++j)
            for (int i = 0; i < n; ++i) {
                const double dx = from.dx.at(i, j), dz = from.dz.at(i, j);
                held.planes.dx.push_back(static_cast<float>(c * dx - s * dz));
                held.planes.dz.push_back(static_cast<float>(s * dx + c * dz));
                held.planes.height.push_back(from.height.at(i, j));
                const double hx = (from.height.at((i + 1) % n, j) - from.height.at(i, j)) / from.texel_m();
                const double hz = (from.height.at(i, (j + 1) % n) - from.height.at(i, j)) / from.texel_m();
                mss += (hx * hx + hz * hz) / (n * n);
            }
        const SlopeRanges ranges = slope_ranges(mss);
        held.maps = slopes_by(kernels_for(choose_isa()), held.planes, ranges);

        Tile tile;
        tile.lattice = {from.lattice.side_m, c, s};
        const auto view = [n](const std::vector<float>& plane) { return PlaneView{plane.data(), n, n, n, 0}; };
        tile.dx = view(held.planes.dx);
        tile.height = view(held.planes.height);
        tile.dz = view(held.planes.dz);
        tile.displacement_rgba16f = held.maps.halves;
        tile.slopes_rgba8 = held.maps.slopes;
        tile.moments_rgba8 = held.maps.moments;
        tile.slope_ranges = ranges;
        tile.longest_wave_m = from.lattice.side_m;
        tile.bounds = from.bounds;
        tile.bounds.sideways_x_max_m = tile.bounds.sideways_z_max_m =
            std::hypot(from.bounds.sideways_x_max_m, from.bounds.sideways_z_max_m);
        tile.whitecap_jacobian = from.whitecap_jacobian;
        tiles_.push_back(tile);

        if (tiles_.size() == 1) {
            frame_ = one_tile;
            frame_.bounds = {};
        }
        frame_.tiles = tiles_;
        frame_.bounds.height_min_m += tile.bounds.height_min_m;
        frame_.bounds.height_max_m += tile.bounds.height_max_m;
        frame_.bounds.sideways_x_max_m += tile.bounds.sideways_x_max_m;
        frame_.bounds.sideways_z_max_m += tile.bounds.sideways_z_max_m;
    }

    const Frame& frame() const { return frame_; }
    Tile& tile(std::size_t number) { return tiles_[number]; }

   private:
    struct Held {
        unfused::TilePlanes planes;
        unfused::TileSlopes maps;
    };
    std::deque<Held> held_;
    std::vector<Tile> tiles_;
    Frame frame_;
};

}  // namespace pelagic
