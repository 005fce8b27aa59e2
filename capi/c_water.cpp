// C interface of the water of a frame below its surface.
#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/c_water_points.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/water_query.hpp"

namespace pelagic::capi {
namespace {

WaterQueryOptions water_query_options_of(const pelagic_ocean& ocean, const pelagic_water_points& points) {
    WaterQueryOptions options{.surface = query_options_of(ocean, points.tolerance_m, points.interpolation)};
    if (points.water_density_kgpm3 != 0) options.water_density_kgpm3 = points.water_density_kgpm3;
    return options;
}

}  // namespace
}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_ocean_sample_water(const pelagic_ocean* ocean, const pelagic_water_points* points,
                                          const pelagic_water_samples* samples) {
    return guarded([&] {
        const pelagic_water_points where = read_struct(points, "points");
        const QueryFrames::Reader reader(needed(ocean, "ocean").query_frames, where.frame);
        const Frame& frame = needed_query(*ocean, reader, where.frame).frame();
        if (!ocean->ocean.contents().depth)
            reject("the ocean has no water below its surface: it was created without pelagic_ocean_options.depth");
        const WaterQuery water(frame, water_query_options_of(*ocean, where));
        const WaterPoints at = water_points_of(where);
        const WaterSamples to = water_samples_of(read_struct(samples, "samples"), where.count);
        if (where.parallel != 0)
            ocean->idle_water.use(ocean->executor, [&](WaterJobs& jobs) { jobs.sample(water, at, to); });
        else
            water.sample(at, to);
    });
}
