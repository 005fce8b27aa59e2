// C interface of shores.
#include "pelagic/sim/shore.hpp"

#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic::capi {
namespace {

const ShoreSurface& shown_shore(const pelagic_ocean& ocean) {
    need_frame(ocean);
    if (!ocean.current->shore) reject("the ocean has no shore: it was created without pelagic_ocean_options.shore");
    return ocean.current->shore;
}

}  // namespace

ShoreOptions shore_options_of(const pelagic_shore_options* options) {
    const pelagic_shore_options from = read_struct(options, "shore");
    ShoreOptions to;
    // generated from schema/shore.toml: c-reads
    to.columns = from.columns;
    to.rows = from.rows;
    to.corner_x_m = from.corner_x_m;
    to.corner_z_m = from.corner_z_m;
    to.metres_per_sample = from.metres_per_sample;
    to.resolution = from.resolution;
    to.fade_m = from.fade_m;
    to.swash_m = from.swash_m == 0 ? -1 : from.swash_m;
    // end of generated
    // Read heights only if the counts are valid.
    constexpr int max = ShoreOptions::max_samples_per_side;
    if (from.columns >= 2 && from.columns <= max && from.rows >= 2 && from.rows <= max) {
        const float* const heights = &needed(from.heights_m, "shore.heights_m");
        to.heights_m.assign(heights,
                              heights + static_cast<std::size_t>(from.columns) * static_cast<std::size_t>(from.rows));
    }
    if (const std::string reason = check(to); !reason.empty()) reject("shore." + reason);
    return to;
}

}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_ocean_shore(const pelagic_ocean* ocean, pelagic_shore_surface* surface) {
    return guarded([&] {
        const ShoreSurface& shore = shown_shore(needed(ocean, "ocean"));
        pelagic_shore_surface& out = needed(surface, "surface");
        out.columns = shore.columns;
        out.rows = shore.rows;
        out.weights_change_per_m = shore.weights_change_per_m;
        out.texel_m = shore.texel_m;
        out.x_m = shore.x_m;
        out.z_m = shore.z_m;
        out.depth_m = shore.depth_m.data();
        out.weights_rgba8 = shore.weights_rgba8.data();
        out.height_m = shore.height_m.data();
        out.vertical_velocity_mps = shore.vertical_velocity_mps.data();
        out.reach_m = shore.reach_m.data();
        out.foam = shore.foam.data();
        out.height_min_m = shore.bounds.height_min_m;
        out.height_max_m = shore.bounds.height_max_m;
        out.potential_m2ps = shore.potential_m2ps.data();
    });
}
