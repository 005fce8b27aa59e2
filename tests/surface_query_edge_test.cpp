// Points exactly on the edge between two cells, under many intersections. Rounding must not miss
// both cells and return the next lower intersection.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/one_cascade_frame.hpp"

namespace pelagic {
namespace {

/// A crumpled surface: each cell is about 60 texels long and one wide when displaced, so rounding
/// errors of its length are large relative to its width, and the patch overlaps itself many times.
/// A texel is a metre. Positions are multiples of 105 units that a float represents exactly, so
/// that a third, a fifth or a seventh of an edge is exactly on it.
class Crumpled {
   public:
    static constexpr int n = 16;
    static constexpr double unit = 0x1p-16;

    explicit Crumpled(unsigned seed) : dx_(n * n), height_(n * n), dz_(n * n), folds_(n * n / 8, 0xFF) {
        std::mt19937 random(seed);
        const auto within = [&](double size) { return (static_cast<double>(random() % 4096) / 2048 - 1) * size; };
        const auto rounded = [](double place) { return std::round(place / (105 * unit)) * (105 * unit); };
        for (std::size_t at = 0; at < n * n; ++at) {
            const auto i = static_cast<double>(at % n), j = static_cast<double>(at / n);
            dx_[at] = static_cast<float>(rounded(i + within(60)) - i);
            dz_[at] = static_cast<float>(rounded(j + within(0.25)) - j);
            height_[at] = static_cast<float>(within(4));
        }
    }

    void show_in(OneCascadeFrame& water) const {
        const auto plane = [](const std::vector<float>& values) { return PlaneView{values.data(), n, n, n, 0}; };
        const auto largest = [](const std::vector<float>& values) {
            float size = 0;
            for (const float value : values) size = std::max(size, std::fabs(value));
            return size;
        };
        water.frame.isa = choose_isa();
        water.cascade.grid.side_m = n;
        water.cascade.dx = plane(dx_);
        water.cascade.height = plane(height_);
        water.cascade.dz = plane(dz_);
        water.cascade.folds = folds_;
        water.set_bounds({-4, 4, largest(dx_), largest(dz_)});
    }

    struct Place {
        double x, z, height;
    };
    /// Returns the displaced position of texel (i, j); displacements are at most n.
    Place place(int i, int j) const {
        const auto at = static_cast<std::size_t>(j % n * n + i % n);
        return {i + static_cast<double>(dx_[at]), j + static_cast<double>(dz_[at]), static_cast<double>(height_[at])};
    }

   private:
    std::vector<float> dx_, height_, dz_;
    std::vector<std::uint8_t> folds_;
};

TEST(SurfaceQueryEdges, APointOnAnEdgeBelongsToOneOfItsCells) {
    constexpr int n = Crumpled::n;
    std::size_t asked = 0, lower = 0;
    for (unsigned seed = 0; seed < 5; ++seed) {
        const Crumpled surface(seed);
        OneCascadeFrame water;
        surface.show_in(water);
        const Frame& frame = water.frame;
        const SurfaceQuery query(frame);
        std::vector<double> x, z, on_edge;
        for (int texel = 0; texel < n * n; ++texel) {
            const int i = texel % n, j = texel / n;
            for (const auto& [to_i, to_j] : {std::pair{i + 1, j}, {i, j + 1}}) {
                const Crumpled::Place from = surface.place(i, j), to = surface.place(to_i, to_j);
                for (const int parts : {3, 5, 7}) {
                    for (int part = 0; part < parts; ++part) {
                        x.push_back(from.x + part * ((to.x - from.x) / parts));
                        z.push_back(from.z + part * ((to.z - from.z) / parts));
                        on_edge.push_back(from.height + part * ((to.height - from.height) / parts));
                    }
                }
            }
        }
        std::vector<float> height(x.size());
        query.sample({x, z}, {.height_m = height});
        asked += x.size();
        // The highest intersection is the result, so no height is below an intersection on the
        // edge. Heights are floats.
        for (std::size_t point = 0; point < x.size(); ++point) lower += height[point] < on_edge[point] - 1e-4;
    }
    EXPECT_EQ(lower, 0u) << "of " << asked;
}

}  // namespace
}  // namespace pelagic
