// C interface of hulls.
#include "pelagic/capi/c_hull.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/capi/c_ocean.hpp"
#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/floating/given_coefficients.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"

namespace pelagic::capi {
namespace {

glm::dvec3 vector_of(const double (&from)[3]) { return {from[0], from[1], from[2]}; }

void write(const glm::dvec3& from, double (&to)[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = from[axis];
}

pelagic_hull_force c_force_of(const HullForce& force) {
    pelagic_hull_force out{};
    write(force.force_n, out.force_n);
    write(force.torque_nm, out.torque_nm);
    return out;
}

HullMesh mesh_of(const pelagic_hull_mesh* pointer) {
    const pelagic_hull_mesh from = read_struct(pointer, "mesh");
    require(HullMesh::check_counts(from.vertex_count, from.triangle_count));
    if (from.vertex_count > 0) needed(from.vertices_m, "mesh.vertices_m");
    needed(from.triangles, "mesh.triangles");
    std::vector<glm::dvec3> vertices(from.vertex_count);
    for (std::size_t i = 0; i < vertices.size(); ++i)
        vertices[i] = {from.vertices_m[3 * i], from.vertices_m[3 * i + 1], from.vertices_m[3 * i + 2]};
    std::vector<HullMesh::Triangle> triangles(from.triangle_count);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        triangles[i] = {from.triangles[3 * i], from.triangles[3 * i + 1], from.triangles[3 * i + 2]};
    return HullMesh(vertices, triangles);
}

Hull hull_of(HullMesh mesh, const pelagic_hull_options* pointer) {
    HullOptions options = hull_options_of(pointer);
    Hull plain(std::move(mesh), options);
    const pelagic_hull_options from = read_struct(pointer, "options");
    if (!from.radiation_text) {
        if (from.excitation_text) reject("excitation_text needs radiation_text");
        return plain;
    }
    options.coefficients = read_coefficients(plain, {.radiation = from.radiation_text,
                                                     .excitation = from.excitation_text ? from.excitation_text : "",
                                                     .radiation_name = "radiation_text",
                                                     .excitation_name = "excitation_text"});
    return Hull(plain.mesh(), options);
}

/// Computes loads, and with `accelerates` velocities, and writes them if nothing throws.
void compute(pelagic_hull* hull, const pelagic_ocean* ocean, pelagic_hull_state* state, double step_s,
             const pelagic_hull_inputs* inputs, pelagic_hull_loads* loads, bool accelerates) {
    const Hull& ours = needed(hull, "hull").hull;
    if (ours.coefficients()) reject("the hull has radiation_text, expected a hull without: it moves in pelagic_bodies");
    const QueryFrames::Reader reader(needed(ocean, "ocean").query_frames);
    const WaterQuery water(needed_query(*ocean, reader).frame());
    HullState moved = hull_state_of(state, "state");
    const HullInputs acting = inputs ? hull_inputs_of(inputs, "inputs") : HullInputs{};
    const HullLoads result = ours.loads(water, moved, step_s, acting, hull->workspace);
    if (accelerates) ours.accelerate(moved, result, step_s, acting);
    *state = c_hull_state_of(moved);
    if (loads) *loads = c_hull_loads_of(result);
}

}  // namespace

HullOptions hull_options_of(const pelagic_hull_options* pointer) {
    const pelagic_hull_options from = read_struct(pointer, "options");
    HullOptions to;
    // generated from schema/hull.toml: c-reads
    to.mass_kg = from.mass_kg;
    to.heave_damping = from.heave_damping;
    to.roll_damping = from.roll_damping;
    to.pressure_coefficient = from.pressure_coefficient;
    to.suction_coefficient = from.suction_coefficient;
    to.friction_coefficient = from.friction_coefficient;
    to.air_coefficient = from.air_coefficient;
    to.water_density_kgpm3 = from.water_density_kgpm3;
    to.air_density_kgpm3 = from.air_density_kgpm3;
    to.skeg_m2 = from.skeg_m2;
    to.skeg_x_m = from.skeg_x_m;
    to.skeg_y_m = from.skeg_y_m;
    // end of generated
    if (const double* at = from.centre_of_mass_m) to.centre_of_mass_m = glm::dvec3(at[0], at[1], at[2]);
    if (const double* of = from.inertia_kgm2) to.inertia_kgm2 = glm::dvec3(of[0], of[1], of[2]);
    if (from.added_mass) {
        HullMatrix& matrix = to.added_mass.emplace();
        for (std::size_t row = 0; row < 6; ++row) std::copy_n(from.added_mass + 6 * row, 6, matrix[row].begin());
    }
    return to;
}

HullState hull_state_of(const pelagic_hull_state* state, const char* name) {
    const pelagic_hull_state& from = needed(state, name);
    const auto& q = from.orientation;
    return {.position_m = vector_of(from.position_m),
            .orientation = glm::dquat(q[3], q[0], q[1], q[2]),
            .velocity_mps = vector_of(from.velocity_mps),
            .angular_velocity_radps = vector_of(from.angular_velocity_radps),
            .wake_velocity_y_mps = from.wake_velocity_y_mps,
            .wake_rotation_radps = vector_of(from.wake_rotation_radps),
            .submersion = from.submersion,
            .has_previous_step = from.has_previous_step != 0};
}

HullInputs hull_inputs_of(const pelagic_hull_inputs* inputs, const char* name) {
    const pelagic_hull_inputs from = read_struct(inputs, name);
    return {.force = {vector_of(from.force.force_n), vector_of(from.force.torque_nm)},
            .wind_mps = vector_of(from.wind_mps)};
}

pelagic_hull_state c_hull_state_of(const HullState& state) {
    pelagic_hull_state out{};
    write(state.position_m, out.position_m);
    out.orientation[0] = state.orientation.x;
    out.orientation[1] = state.orientation.y;
    out.orientation[2] = state.orientation.z;
    out.orientation[3] = state.orientation.w;
    write(state.velocity_mps, out.velocity_mps);
    write(state.angular_velocity_radps, out.angular_velocity_radps);
    out.wake_velocity_y_mps = state.wake_velocity_y_mps;
    write(state.wake_rotation_radps, out.wake_rotation_radps);
    out.submersion = state.submersion;
    out.has_previous_step = state.has_previous_step;
    return out;
}

pelagic_hull_loads c_hull_loads_of(const HullLoads& loads) {
    pelagic_hull_loads out{};
    out.total = c_force_of(loads.total());
    out.pressure = c_force_of(loads.pressure);
    out.added_mass = c_force_of(loads.added_mass);
    out.drag = c_force_of(loads.drag);
    out.slamming = c_force_of(loads.slamming);
    out.displaced_m3 = loads.displaced_m3;
    out.submersion = loads.submersion;
    out.water_height_m = loads.water_height_m;
    out.water_slope_x = loads.water_slope_x;
    out.water_slope_z = loads.water_slope_z;
    write(loads.water_velocity_mps, out.water_velocity_mps);
    write(loads.water_acceleration_mps2, out.water_acceleration_mps2);
    return out;
}

}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_hull_create(const pelagic_hull_mesh* mesh, const pelagic_hull_options* options,
                                   pelagic_hull** hull) {
    return guarded([&] {
        pelagic_hull*& out = needed(hull, "hull");
        out = nullptr;
        HullMesh ours = mesh_of(mesh);
        out = new pelagic_hull{hull_of(std::move(ours), options)};
    });
}

void pelagic_hull_destroy(pelagic_hull* hull) { delete hull; }

pelagic_status pelagic_hull_describe(const pelagic_hull* hull, pelagic_hull_info* info) {
    return guarded([&] {
        const Hull& ours = needed(hull, "hull").hull;
        const HullMesh& mesh = ours.mesh();
        const HullAfloat& afloat = ours.afloat();
        pelagic_hull_info& out = needed(info, "info");
        out.floats = afloat.floats;
        out.volume_m3 = mesh.volume_m3();
        write(mesh.centre_m(), out.centre_m);
        write(mesh.lower_m(), out.minimum_m);
        write(mesh.upper_m(), out.maximum_m);
        out.mass_kg = ours.mass_kg();
        write(ours.centre_of_mass_m(), out.centre_of_mass_m);
        out.draught_m = afloat.draught_m;
        out.height_m = afloat.height_m;
        out.waterplane_m2 = afloat.waterplane_m2;
        out.roll_gm_m = afloat.roll_gm_m;
        out.pitch_gm_m = afloat.pitch_gm_m;
        out.digest = ours.digest();
        out.vertex_count = static_cast<std::int32_t>(mesh.vertices().size());
        out.triangle_count = static_cast<std::int32_t>(mesh.triangles().size());
    });
}

pelagic_status pelagic_hull_at_rest(const pelagic_hull* hull, double x_m, double z_m, double heading_rad,
                                    pelagic_hull_state* state) {
    return guarded([&] {
        const Hull& ours = needed(hull, "hull").hull;
        if (!std::isfinite(heading_rad)) reject(invalid_value_message("heading_rad", heading_rad, "a finite number"));
        needed(state, "state");
        const HullState rest = ours.at_rest(x_m, z_m, heading_rad);
        require(Hull::check(rest));
        *state = c_hull_state_of(rest);
    });
}

pelagic_status pelagic_hull_compute_loads(pelagic_hull* hull, const pelagic_ocean* ocean, pelagic_hull_state* state,
                                          double step_s, const pelagic_hull_inputs* inputs,
                                          pelagic_hull_loads* loads) {
    return guarded([&] {
        needed(loads, "loads");
        compute(hull, ocean, state, step_s, inputs, loads, false);
    });
}

pelagic_status pelagic_hull_accelerate(pelagic_hull* hull, const pelagic_ocean* ocean, pelagic_hull_state* state,
                                       double step_s, const pelagic_hull_inputs* inputs, pelagic_hull_loads* loads) {
    return guarded([&] { compute(hull, ocean, state, step_s, inputs, loads, true); });
}
