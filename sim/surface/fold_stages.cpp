#include "pelagic/sim/surface/fold_stages.hpp"

#include <array>
#include <vector>

#include "pelagic/sim/surface/item_stage.hpp"

namespace pelagic {

void FoldStages::add_to(JobGraph& graph, std::span<const StageId> surfaces_done) {
    const bool is_one = surfaces_done.size() == 1;
    std::vector<StageId> cells_done;
    for (std::size_t tile = 0; tile < surfaces_done.size(); ++tile) {
        const auto find = [this, tile, is_one](std::size_t job) {
            TileBuffers& buffers = slots_.buffers(tile);
            if (is_one)
                buffers.folds->find(slots_.tile(tile), kernels_, job);
            else
                buffers.squeeze->find(slots_.tile(tile), kernels_, job);
        };
        const TileBuffers& buffers = slots_.buffers(tile);
        cells_done.push_back(graph.add({.name = stage_name("folds", tile),
                                        .count = is_one ? buffers.folds->jobs() : buffers.squeeze->jobs(),
                                        .waits_for = {surfaces_done[tile]},
                                        .body = for_each_item(find),
                                        .stack_bytes = stack_margin}));
    }
    for (std::size_t tile = 0; tile < surfaces_done.size(); ++tile) {
        const auto tail = [this, tile, is_one](std::size_t) {
            if (is_one)
                slots_.buffers(tile).folds->mark(slots_.tile(tile));
            else
                spread(tile);
        };
        graph.add({.name = stage_name("folds tail", tile),
                   .count = 1,
                   .waits_for = cells_done,
                   .body = for_each_item(tail),
                   .stack_bytes = stack_margin});
    }
}

void FoldStages::spread(std::size_t tile) {
    std::array<const SqueezeMap*, most_tiles> maps;
    const std::size_t count = slots_.tile_count();
    for (std::size_t i = 0; i < count; ++i) maps[i] = &*slots_.buffers(i).squeeze;
    slots_.buffers(tile).squeeze->spread(slots_.tile(tile), {maps.data(), count}, tile,
                                         slots_.tile(count - 1).texel_m(), kernels_);
}

}  // namespace pelagic
