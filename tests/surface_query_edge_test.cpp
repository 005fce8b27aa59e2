// Points exactly on the edge between two cells, under several sheets: rounding must not let them fall between the cells of
// the highest one, down to the next.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "pelagic/sim/fold_map.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {
namespace {

constexpr int n = 16;

/// A fold along z: going along x, the surface comes back upon itself between x = 6 and 9 and goes on. Its first sheet lies
/// highest, 5 m over the last. Every texel is a little off its place, so that no edge is parallel to another. All numbers
/// have few binary digits, and a texel is a metre: what is drawn on an edge is exactly on it.
class Fold {
   public:
    explicit Fold(unsigned seed) : dx_(n * n), height_(n * n), dz_(n * n), folds_(n * n / 8, 0xFF) {
        constexpr std::array<double, n> drawn_at = {0, 1.5, 3, 4.5, 6, 7.5, 9, 8, 7, 6, 7.5, 9, 10.5, 12, 13.5, 15};
        constexpr std::array<double, n> height = {5, 5, 5, 5, 5, 5, 5, 3, 2, 1, 0, 0, 0, 2, 3, 4};
        std::mt19937 random(seed);
        const auto step = [&] { return (static_cast<double>(random() % 512) - 256) / 1024; };
        for (std::size_t j = 0; j < n; ++j) {
            for (std::size_t i = 0; i < n; ++i) {
                dx_[j * n + i] = static_cast<float>(drawn_at[i] - static_cast<double>(i) + step());
                dz_[j * n + i] = static_cast<float>(step());
                height_[j * n + i] = static_cast<float>(height[i]);
            }
        }
    }

    Frame frame() const {
        const auto plane = [](const std::vector<float>& values) { return PlaneView{values.data(), n, n, n, 0}; };
        Frame frame;
        frame.sea.resolution = n;
        frame.sea.patch_size_m = n;
        frame.isa = choose_isa();
        frame.dx = plane(dx_);
        frame.height = plane(height_);
        frame.dz = plane(dz_);
        frame.folds = folds_;
        const auto largest = [](const std::vector<float>& values) {
            return std::fabs(*std::max_element(values.begin(), values.end(),
                                               [](float a, float b) { return std::fabs(a) < std::fabs(b); }));
        };
        frame.bounds = {0, 5, largest(dx_), largest(dz_)};
        return frame;
    }

    struct Place {
        double x, z, height;
    };
    /// Where texel (i, j) is drawn.
    Place place(int i, int j) const {
        const auto at = static_cast<std::size_t>(j * n + i);
        return {i + static_cast<double>(dx_[at]), j + static_cast<double>(dz_[at]), static_cast<double>(height_[at])};
    }

   private:
    std::vector<float> dx_, height_, dz_;
    std::vector<std::uint8_t> folds_;
};

TEST(SurfaceQueryEdges, APointOnAnEdgeIsOnOneOfItsCells) {
    std::size_t asked = 0, lower = 0;
    for (unsigned seed = 0; seed < 100; ++seed) {
        const Fold fold(seed);
        const Frame frame = fold.frame();
        const SurfaceQuery query(frame);
        std::vector<double> x, z;
        // Edges of the highest sheet that lie over the others, along x and along z, quarters and ends.
        for (int j = 2; j < n - 2; ++j) {
            for (const int i : {4, 5}) {
                for (const auto& [to_i, to_j] : {std::pair{i + 1, j}, {i, j + 1}}) {
                    const Fold::Place from = fold.place(i, j), to = fold.place(to_i, to_j);
                    for (const double part : {0.0, 0.25, 0.5, 0.75, 1.0}) {
                        x.push_back(from.x + part * (to.x - from.x));
                        z.push_back(from.z + part * (to.z - from.z));
                    }
                }
            }
        }
        std::vector<float> height(x.size());
        query.sample({x, z}, {.height_m = height});
        for (std::size_t point = 0; point < x.size(); ++point) {
            ++asked;
            // The sheet is 5 m high all over; the next lower one is at 3 m at most where these edges are.
            if (height[point] < 4.999f) ++lower;
        }
    }
    EXPECT_EQ(lower, 0u) << "of " << asked;
}

}  // namespace
}  // namespace pelagic
