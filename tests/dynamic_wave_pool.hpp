// A dynamic-wave grid with its own executor.
#pragma once

#include <cstring>
#include <memory>
#include <utility>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/sim/dynamic_waves/grid.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

class DynamicWavePool {
   public:
    explicit DynamicWavePool(const DynamicWavesOptions& options, Isa isa = choose_isa(),
                             std::shared_ptr<Executor> executor = make_serial_executor())
        : grid(options, isa), executor_(std::move(executor)) {
        grid.add_tick_stages(graph_);
        run_ = executor_->prepare(graph_);
    }

    void tick() {
        grid.begin_tick();
        run_->schedule();
        run_->complete();
        grid.end_tick();
    }
    void tick(int times) {
        for (int i = 0; i < times; ++i) tick();
    }

    DynamicWaveGrid grid;

   private:
    JobGraph graph_;
    std::shared_ptr<Executor> executor_;
    std::unique_ptr<GraphRun> run_;
};

/// Sets the grid's heights and companions; both functions take texel coordinates relative to the
/// origin, wrapped periodically.
template <class Height, class Companion>
void fill(DynamicWaveGrid& grid, Height height, Companion companion) {
    std::vector<std::uint8_t> state = grid.saved();
    const std::size_t n = static_cast<std::size_t>(grid.options().resolution);
    const auto at = [&](std::size_t plane, std::int64_t x, std::int64_t z) {
        const auto wrapped = [n](std::int64_t i) { return static_cast<std::size_t>(i) & (n - 1); };
        return state.data() + 3 * sizeof(std::int64_t) + ((plane * n + wrapped(z)) * n + wrapped(x)) * sizeof(float);
    };
    for (std::int64_t z = grid.first_z(); z < grid.first_z() + grid.options().resolution; ++z)
        for (std::int64_t x = grid.first_x(); x < grid.first_x() + grid.options().resolution; ++x) {
            const float texels[2] = {static_cast<float>(height(x, z)), static_cast<float>(companion(x, z))};
            for (std::size_t plane = 0; plane < 2; ++plane)
                std::memcpy(at(plane, x, z), &texels[plane], sizeof(float));
        }
    grid.restore(state);
}

/// Returns the sum of f over the texels of the grid.
template <class OfTexel>
double sum_over(const DynamicWaveGrid& grid, OfTexel of_texel) {
    double sum = 0;
    for (std::int64_t z = grid.first_z(); z < grid.first_z() + grid.options().resolution; ++z)
        for (std::int64_t x = grid.first_x(); x < grid.first_x() + grid.options().resolution; ++x)
            sum += of_texel(x, z);
    return sum;
}

}  // namespace pelagic
