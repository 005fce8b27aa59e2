#include "pelagic/sim/foam/history.hpp"

#include <algorithm>

#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/foam/foam_source.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"

namespace pelagic {
namespace {

constexpr std::size_t rows_a_job = 16;
constexpr std::size_t foam_stack_bytes = 40 * 1024 + stack_margin;

}  // namespace

FoamHistory::FoamHistory(FrameSlots& slots, const Kernels& kernels, const Allocator& memory)
    : slots_(slots), kernels_(kernels) {
    const std::size_t texels =
        static_cast<std::size_t>(slots.resolution()) * static_cast<std::size_t>(slots.resolution());
    for (std::size_t i = 0; i < slots.cascade_count(); ++i)
        cascades_.push_back(
            {{},
             0,
             0,
             0,
             {AlignedBuffer<std::uint8_t>(texels, memory), AlignedBuffer<std::uint8_t>(texels, memory)}});
    forget();
}

std::vector<StageId> FoamHistory::add_tick_stages(JobGraph& graph, std::span<const StageId> surfaces_done) {
    std::vector<StageId> done;
    for (std::size_t cascade = 0; cascade < surfaces_done.size(); ++cascade)
        done.push_back(
            graph.add({.name = stage_name("tick foam", cascade),
                       .count = static_cast<std::size_t>(slots_.resolution()) / rows_a_job,
                       .waits_for = {surfaces_done[cascade]},
                       .body = for_each_item([this, cascade](std::size_t job) { tick_rows(cascade, job); }),
                       .stack_bytes = foam_stack_bytes}));
    return done;
}

void FoamHistory::tick_rows(std::size_t cascade, std::size_t job) {
    CascadeMemory& memory = cascades_[cascade];
    if (memory.ticks_to_fade == 0) return;  // both maps are empty
    const int n = slots_.resolution();
    const CascadeGrid& grid = memory.at_tick.grid;
    // The derivatives are those of the stage that writes the half floats.
    const bool is_one = cascades_.size() == 1;
    const double near = is_one ? 0.5 : SlopesJob::near_weight, far = is_one ? 0 : SlopesJob::far_weight;
    kernels_.foam_tick({.surface = slots_.buffers(cascade).surface.data(),
                        .resolution = static_cast<std::size_t>(n),
                        .block_stride = column_block_floats(n, kernels_.lanes),
                        .cosine = static_cast<float>(grid.cosine),
                        .sine = static_cast<float>(grid.sine),
                        .difference_factor = static_cast<float>(near / (grid.side_m / n)),
                        .far_over_near = static_cast<float>(far / near),
                        .source = foam_source(memory.at_tick),
                        .before = memory.maps[1 - newest_].data(),
                        .shift_x = memory.shift_x,
                        .shift_z = memory.shift_z,
                        .first_row = job * rows_a_job,
                        .rows = rows_a_job,
                        .after = memory.maps[newest_].data()});
}

void FoamHistory::set_drift(std::size_t cascade, int texels_x, int texels_z) {
    const int n = slots_.resolution();
    const auto wrapped = [n](int texels) { return static_cast<std::size_t>((texels % n + n) % n); };
    cascades_[cascade].shift_x = wrapped(texels_x);
    cascades_[cascade].shift_z = wrapped(texels_z);
    int& remaining = cascades_[cascade].ticks_to_fade;
    remaining = cascades_[cascade].at_tick.makes_whitecaps() ? ticks_to_empty : std::max(0, remaining - 1);
}

void FoamHistory::forget() {
    for (CascadeMemory& cascade : cascades_) {
        for (AlignedBuffer<std::uint8_t>& map : cascade.maps) std::fill_n(map.data(), map.size(), std::uint8_t{0});
        cascade.ticks_to_fade = 0;
    }
}

void FoamHistory::advance() { newest_ = 1 - newest_; }

std::size_t FoamHistory::bytes() const {
    std::size_t bytes = 0;
    for (const CascadeMemory& cascade : cascades_)
        bytes += sizeof(CascadeMemory) + cascade.maps[0].bytes() + cascade.maps[1].bytes();
    return bytes;
}

}  // namespace pelagic
