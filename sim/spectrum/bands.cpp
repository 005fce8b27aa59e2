#include "pelagic/sim/tile_plan.hpp"

namespace pelagic {

std::vector<TilePlan> plan_tiles(const SeaState& sea) {
    return {{.lattice = {.side_m = sea.patch_size_m}, .resolution = sea.resolution}};
}

}  // namespace pelagic
