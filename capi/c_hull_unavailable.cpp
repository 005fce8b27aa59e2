// C interface of hulls and floating bodies in a library that was built without GLM.
#include "pelagic/capi/c_status.hpp"

namespace {

pelagic_status unavailable() {
    return pelagic::capi::failure(PELAGIC_INVALID_ARGUMENT,
                                  "hulls are unavailable, expected a library built with PELAGIC_FLOATING");
}

/// Creates nothing.
template <class Handle>
pelagic_status unavailable(Handle** out) {
    if (out) *out = nullptr;
    return unavailable();
}

}  // namespace

pelagic_status pelagic_hull_create(const pelagic_hull_mesh*, const pelagic_hull_options*, pelagic_hull** hull) {
    return unavailable(hull);
}
void pelagic_hull_destroy(pelagic_hull*) {}
pelagic_status pelagic_hull_describe(const pelagic_hull*, pelagic_hull_info*) { return unavailable(); }
pelagic_status pelagic_hull_at_rest(const pelagic_hull*, double, double, double, pelagic_hull_state*) {
    return unavailable();
}
pelagic_status pelagic_hull_compute_loads(pelagic_hull*, const pelagic_ocean*, pelagic_hull_state*, double,
                                          const pelagic_hull_inputs*, pelagic_hull_loads*) {
    return unavailable();
}
pelagic_status pelagic_hull_accelerate(pelagic_hull*, const pelagic_ocean*, pelagic_hull_state*, double,
                                       const pelagic_hull_inputs*, pelagic_hull_loads*) {
    return unavailable();
}
pelagic_status pelagic_bodies_create(pelagic_ocean*, const pelagic_bodies_options*, pelagic_bodies** bodies) {
    return unavailable(bodies);
}
void pelagic_bodies_destroy(pelagic_bodies*) {}
pelagic_status pelagic_bodies_add(pelagic_bodies*, const pelagic_hull*, const pelagic_hull_state*, uint32_t*) {
    return unavailable();
}
pelagic_status pelagic_bodies_remove(pelagic_bodies*, uint32_t) { return unavailable(); }
pelagic_status pelagic_bodies_set_inputs(pelagic_bodies*, uint32_t, const pelagic_hull_inputs*) {
    return unavailable();
}
pelagic_status pelagic_bodies_set_state(pelagic_bodies*, uint32_t, const pelagic_hull_state*) {
    return unavailable();
}
pelagic_status pelagic_bodies_get_state(const pelagic_bodies*, uint32_t, pelagic_hull_state*) {
    return unavailable();
}
pelagic_status pelagic_bodies_get_loads(const pelagic_bodies*, uint32_t, pelagic_hull_loads*) {
    return unavailable();
}
pelagic_status pelagic_bodies_shift(pelagic_bodies*, double, double) { return unavailable(); }
pelagic_status pelagic_bodies_press(pelagic_bodies*, double) { return unavailable(); }
pelagic_status pelagic_bodies_step(pelagic_bodies*, double, int32_t*) { return unavailable(); }
pelagic_status pelagic_bodies_save_state(const pelagic_bodies*, uint8_t*, size_t, size_t*) { return unavailable(); }
pelagic_status pelagic_bodies_restore_state(pelagic_bodies*, const uint8_t*, size_t) { return unavailable(); }
