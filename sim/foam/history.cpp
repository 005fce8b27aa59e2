#include "pelagic/sim/foam/history.hpp"

#include <algorithm>

#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/foam/foam_source.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"

namespace pelagic {
namespace {

constexpr std::size_t tick_rows_a_job = 16;
constexpr std::size_t foam_stack_bytes = 40 * 1024 + stack_margin;

}  // namespace

FoamHistory::FoamHistory(FrameSlots& slots, const Kernels& kernels, const Allocator& memory)
    : slots_(slots), kernels_(kernels) {
    const auto n = static_cast<std::size_t>(slots.resolution());
    for (AlignedBuffer<std::uint8_t>& map : maps_) map = AlignedBuffer<std::uint8_t>(n * n, memory);
    forget();
}

StageId FoamHistory::add_tick_stage(JobGraph& graph, StageId surface_done) {
    return graph.add({.name = "tick foam",
                      .count = static_cast<std::size_t>(slots_.resolution()) / tick_rows_a_job,
                      .waits_for = {surface_done},
                      .body = for_each_item([this](std::size_t job) { tick_rows(job); }),
                      .stack_bytes = foam_stack_bytes});
}

void FoamHistory::tick_rows(std::size_t job) {
    if (ticks_to_fade_ == 0) return;  // both maps are empty
    const int n = slots_.resolution();
    // The derivatives are those of the stage that writes the half floats.
    kernels_.foam_tick({.surface = slots_.surface(0),
                        .resolution = static_cast<std::size_t>(n),
                        .block_stride = column_block_floats(n, kernels_.lanes),
                        .cosine = static_cast<float>(grid_.cosine),
                        .sine = static_cast<float>(grid_.sine),
                        .difference_factor = static_cast<float>(0.5 / (grid_.side_m / n)),
                        .source = source_,
                        .before = maps_[1 - newest_].data(),
                        .shift_x = shift_x_,
                        .shift_z = shift_z_,
                        .first_row = job * tick_rows_a_job,
                        .rows = tick_rows_a_job,
                        .after = maps_[newest_].data()});
}

void FoamHistory::advance(const Cascade& at_tick, const DriftTexels& drift) {
    const int n = slots_.resolution();
    const auto wrapped = [n](int texels) { return static_cast<std::size_t>((texels % n + n) % n); };
    newest_ = 1 - newest_;
    grid_ = at_tick.grid;
    source_ = foam_source(at_tick);
    shift_x_ = wrapped(drift.x);
    shift_z_ = wrapped(drift.z);
    ticks_to_fade_ = at_tick.makes_whitecaps() ? ticks_to_empty : std::max(0, ticks_to_fade_ - 1);
}

void FoamHistory::forget() {
    for (AlignedBuffer<std::uint8_t>& map : maps_) std::fill_n(map.data(), map.size(), std::uint8_t{0});
    ticks_to_fade_ = 0;
}

std::size_t FoamHistory::bytes() const { return maps_[0].bytes() + maps_[1].bytes(); }

}  // namespace pelagic
