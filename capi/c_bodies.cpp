// C interface of floating bodies.
#include <memory>
#include <string>

#include "pelagic/capi/c_executor.hpp"
#include "pelagic/capi/c_hull.hpp"
#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/floating/floating_bodies.hpp"

struct pelagic_bodies {
    std::weak_ptr<pelagic_ocean> ocean;
    pelagic::FloatingBodies bodies;
};

namespace pelagic::capi {
namespace {

/// Throws std::invalid_argument for null and if the ocean is destroyed.
template <class Bodies>  // const or not
auto& needed_bodies(Bodies* bodies) {
    if (needed(bodies, "bodies").ocean.expired())
        reject("the ocean of the bodies is destroyed, expected one that exists");
    return bodies->bodies;
}

}  // namespace
}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_bodies_create(pelagic_ocean* ocean, const pelagic_bodies_options* options,
                                     pelagic_bodies** bodies) {
    return guarded([&] {
        pelagic_bodies*& out = needed(bodies, "bodies");
        out = nullptr;
        const pelagic_bodies_options from = options ? read_struct(options, "options") : pelagic_bodies_options_make();
        const pelagic_ocean& of = needed(ocean, "ocean");
        if (const FrameContents& contents = of.ocean.contents(); !contents.queries || !contents.depth)
            reject("bodies need queries and depth, which the ocean was created without");
        // throws without dynamic waves
        DynamicWaves* const waves = from.wakes != 0 ? &ocean->ocean.dynamic_waves() : nullptr;
        out = new pelagic_bodies{
            of.alive, FloatingBodies(from.executor ? from.executor->executor : make_default_executor(), waves)};
    });
}

void pelagic_bodies_destroy(pelagic_bodies* bodies) {
    if (!bodies) return;
    // A command that finds no memory leaves a pressure in the waves.
    if (!bodies->ocean.expired()) guarded([&] { bodies->bodies.clear(); });
    delete bodies;
}

pelagic_status pelagic_bodies_add(pelagic_bodies* bodies, const pelagic_hull* hull, const pelagic_hull_state* state,
                                  uint32_t* number) {
    return guarded([&] {
        FloatingBodies& ours = needed_bodies(bodies);
        std::uint32_t& out = needed(number, "number");
        out = ours.add(needed(hull, "hull").hull, hull_state_of(state, "state"));
    });
}

pelagic_status pelagic_bodies_remove(pelagic_bodies* bodies, uint32_t number) {
    return guarded([&] { needed_bodies(bodies).remove(number); });
}

pelagic_status pelagic_bodies_set_inputs(pelagic_bodies* bodies, uint32_t number, const pelagic_hull_inputs* inputs) {
    return guarded([&] { needed_bodies(bodies).set_inputs(number, hull_inputs_of(inputs, "inputs")); });
}

pelagic_status pelagic_bodies_set_state(pelagic_bodies* bodies, uint32_t number, const pelagic_hull_state* state) {
    return guarded([&] {
        FloatingBodies& ours = needed_bodies(bodies);
        HullState next = hull_state_of(state, "state");
        next.radiation = ours.state(number).radiation;  // which the application's struct does not hold
        ours.set_state(number, next);
    });
}

pelagic_status pelagic_bodies_get_state(const pelagic_bodies* bodies, uint32_t number, pelagic_hull_state* state) {
    return guarded([&] {
        const HullState& ours = needed_bodies(bodies).state(number);
        needed(state, "state") = c_hull_state_of(ours);
    });
}

pelagic_status pelagic_bodies_get_loads(const pelagic_bodies* bodies, uint32_t number, pelagic_hull_loads* loads) {
    return guarded([&] {
        const HullLoads& ours = needed_bodies(bodies).loads(number);
        needed(loads, "loads") = c_hull_loads_of(ours);
    });
}

pelagic_status pelagic_bodies_shift(pelagic_bodies* bodies, double x_m, double z_m) {
    return guarded([&] { needed_bodies(bodies).shift(x_m, z_m); });
}

pelagic_status pelagic_bodies_press(pelagic_bodies* bodies, double tick_s) {
    return guarded([&] {
        FloatingBodies& ours = needed_bodies(bodies);
        const std::shared_ptr<pelagic_ocean> ocean = bodies->ocean.lock();
        need_frame(*ocean);
        need_no_frame_in_flight(*ocean);
        ours.press(*ocean->current, tick_s);
    });
}

pelagic_status pelagic_bodies_step(pelagic_bodies* bodies, double step_s, int32_t* is_all) {
    return guarded([&] {
        if (is_all) *is_all = 0;
        FloatingBodies& ours = needed_bodies(bodies);
        const std::shared_ptr<pelagic_ocean> ocean = bodies->ocean.lock();
        const QueryFrames::Reader reader(ocean->query_frames);
        const bool are_all = ours.step(needed_query(*ocean, reader).frame(), step_s);
        if (is_all) *is_all = are_all;
    });
}

pelagic_status pelagic_bodies_save_state(const pelagic_bodies* bodies, uint8_t* bytes, size_t room, size_t* count) {
    return guarded([&] { write_saved(needed_bodies(bodies).save_state(), bytes, room, count); });
}

pelagic_status pelagic_bodies_restore_state(pelagic_bodies* bodies, const uint8_t* bytes, size_t count) {
    return guarded([&] {
        FloatingBodies& ours = needed_bodies(bodies);
        if (count > 0) needed(bytes, "bytes");
        ours.restore_state({bytes, count});
    });
}
