#include "pelagic/sim/surface/fold_stages.hpp"

#include <array>
#include <vector>

#include "pelagic/sim/buffers/item_stage.hpp"

namespace pelagic {
namespace {

// find_contraction() keeps a word for each block of a job's rows.
constexpr std::size_t folds_stack_bytes = 4 * ContractionMap::rows_per_job / FindContractionJob::block_rows *
                                              FindContractionJob::max_resolution +
                                          stack_margin;

}  // namespace

void FoldStages::add_stages(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) {
    if (pass == Pass::tick) return;
    const bool is_one = slots_.buffers(0).folds.has_value();
    std::vector<StageId> cells_done;
    for (std::size_t cascade = 0; cascade < surfaces_done.size(); ++cascade) {
        const auto find = [this, cascade, is_one](std::size_t job) {
            CascadeBuffers& buffers = slots_.buffers(cascade);
            if (is_one)
                buffers.folds->find(slots_.cascade(cascade), kernels_, job);
            else
                buffers.contraction->find(slots_.cascade(cascade), kernels_, job);
        };
        const CascadeBuffers& buffers = slots_.buffers(cascade);
        cells_done.push_back(graph.add({.name = stage_name("folds", cascade),
                                        .count = is_one ? buffers.folds->jobs() : buffers.contraction->jobs(),
                                        .waits_for = {surfaces_done[cascade]},
                                        .body = for_each_item(find),
                                        .stack_bytes = folds_stack_bytes}));
    }
    for (std::size_t cascade = 0; cascade < surfaces_done.size(); ++cascade) {
        const auto tail = [this, cascade, is_one](std::size_t) {
            if (is_one)
                slots_.buffers(cascade).folds->mark(slots_.cascade(cascade));
            else
                spread(cascade);
        };
        graph.add({.name = stage_name("folds tail", cascade),
                   .count = 1,
                   .waits_for = cells_done,
                   .body = for_each_item(tail),
                   .stack_bytes = stack_margin});
    }
}

void FoldStages::spread(std::size_t cascade) {
    std::array<const ContractionMap*, max_cascades> maps;
    const std::size_t count = slots_.cascade_count();
    for (std::size_t i = 0; i < count; ++i) maps[i] = &*slots_.buffers(i).contraction;
    slots_.buffers(cascade).contraction->spread(slots_.cascade(cascade), {maps.data(), count}, cascade,
                                                slots_.cascade(count - 1).texel_m(), kernels_);
}

}  // namespace pelagic
