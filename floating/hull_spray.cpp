#include "pelagic/floating/hull_spray.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>
#include <stdexcept>

#include "pelagic/floating/wet_surface.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr NumericField<HullSprayOptions> hull_spray_field_table[] = {
    {"radius_m", &HullSprayOptions::radius_m, 0.001, 1, "[0.001, 1]"},
    {"clump_kg", &HullSprayOptions::clump_kg, 1e-6, 1e6, "[1e-6, 1e6]"},
    {"max_droplets", &HullSprayOptions::max_droplets, 0, static_cast<double>(max_spray_droplets), "[0, 8192]"},
};

/// Sine of 4 degrees. Trapped air cushions impacts at smaller deadrises (S.-L. Chuang, J. Ship
/// Research 10, 1966).
constexpr double least_sine = 0.0698;
/// Air slows drops of faster jets down within a metre.
constexpr double fastest_jet_mps = 50;
/// Largest deviation of a drop from the velocity of its jet, over that velocity; by eye.
constexpr double spread = 0.3;
/// Largest stable diameter of a drop in air times the square of its speed: 12 surface tension /
/// density, with 0.0728 N/m and 1.225 kg/m^3.
constexpr double drop_m3ps2 = 12 * 0.0728 / 1.225;

/// Returns the speed of the edge of a wetted face over that of the face along the surface.
double pile_up(double cosine_of_deadrise) {
    return 1 + (std::numbers::pi / 2 - 1) * cosine_of_deadrise * cosine_of_deadrise;
}

/// Returns the part of a jet that becomes spray.
double thrown_part(double speed_mps, double draught_m) {
    return std::clamp(speed_mps * speed_mps / (2 * gravity_mps2 * draught_m) - 1, 0.0, 1.0);
}

}  // namespace

std::span<const NumericField<HullSprayOptions>> hull_spray_fields() { return hull_spray_field_table; }
std::string check(const HullSprayOptions& options) { return check_fields(options, hull_spray_field_table); }

HullSpray::HullSpray(const Hull& hull, const HullSprayOptions& options) : hull_(&hull), options_(options) {
    require(check(options));
    const DefaultFloatEnvironment environment;
    const HullMesh& mesh = hull.mesh();
    draught_m_ = hull.afloat().floats ? hull.afloat().draught_m : (mesh.upper_m() - mesh.lower_m()).y / 2;
}

void HullSpray::update(const WaterKinematics& water, const HullState& state, const HullLoads& loads, double step_s,
                       HullWorkspace& workspace, const HullWake* wake) {
    const DefaultFloatEnvironment environment(step_s);
    Hull::check_step(water, {.wake = wake}, step_s);
    step_s = Hull::Steps(step_s).each_s;  // of the loads
    require(Hull::check(state));
    jets_.clear();
    emitters_.clear();
    masses_kg_.clear();
    foam_.clear();
    energy_j_ = 0;
    if (!(loads.impact_w > 0)) return;
    workspace.clear();
    hull_->append_points(state, workspace);
    workspace.sample(water);
    hull_->place_vertices(water, 0, state, wake, workspace);
    add_jets(loads, state, step_s, workspace);
    if (jets_.empty()) return;
    add_foam(loads, state, step_s);
    add_droplets(loads, state, step_s, water.time_s());
}

void HullSpray::add_jets(const HullLoads& loads, const HullState& state, double step_s,
                         const HullWorkspace& workspace) {
    const glm::dvec3 up = glm::normalize(glm::dvec3(-loads.water_slope_x, 1, -loads.water_slope_z));
    const double density = hull_->options_.water_density_kgpm3;
    for (const auto& [first, second, third] : hull_->mesh().triangles()) {
        const HullVertex* corners[] = {&workspace.vertices[first], &workspace.vertices[second],
                                       &workspace.vertices[third]};
        HullVertex ends[2];
        int crossings = 0;
        for (int i = 0; i < 3; ++i) {
            const HullVertex &a = *corners[i], &b = *corners[(i + 1) % 3];
            if ((a.depth_m > 0) == (b.depth_m > 0)) continue;
            ends[crossings++] = a.depth_m > 0 ? at_waterline(a, b) : at_waterline(b, a);
        }
        if (crossings == 0) continue;
        const glm::dvec3 area = HullTriangle{*corners[0], *corners[1], *corners[2]}.area_m2();
        const glm::dvec3 normal = area / glm::length(area);
        const glm::dvec3 relative = 0.5 * (ends[0].relative_mps + ends[1].relative_mps);
        const double cosine = -glm::dot(normal, up), across = glm::dot(relative, normal);
        const glm::dvec3 level = normal + cosine * up;
        const double sine = glm::length(level);
        // faces that lean inwards, retreat, or lie on the water
        if (cosine < 0 || across <= 0 || sine < 1e-6) continue;
        Jet jet;
        jet.from_m = ends[0].arm_m;
        jet.to_m = ends[1].arm_m;
        jet.out = level / sine;
        const double limited = std::max(sine, least_sine), edge_mps = pile_up(cosine) * across / limited;
        const double speed_mps = edge_mps * std::sqrt(2 + 2 * cosine);
        jet.jet_mps =
            std::min(1.0, fastest_jet_mps / speed_mps) * edge_mps * (jet.out + cosine * jet.out + sine * up);
        jet.hull_mps =
            state.velocity_mps + glm::cross(state.angular_velocity_radps, 0.5 * (ends[0].arm_m + ends[1].arm_m));
        jet.water_mps = jet.hull_mps - relative;
        jet.energy_j = density * std::numbers::pi / 4 * draught_m_ / limited * across * across * edge_mps *
                       glm::length(jet.to_m - jet.from_m) * step_s * thrown_part(speed_mps, draught_m_);
        if (!(jet.energy_j > 0)) continue;
        energy_j_ += jet.energy_j;
        jets_.push_back(jet);
    }
    const double limit_j = 0.5 * step_s * loads.impact_w;
    if (energy_j_ <= limit_j) return;
    for (Jet& jet : jets_) jet.energy_j *= limit_j / energy_j_;
    energy_j_ = limit_j;
}

/// Returns the next number in [0, 1) of one of two sequences that fill the unit square evenly (M.
/// Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018).
double HullSpray::next_fraction(std::size_t sequence) {
    // 2^32 over p and over p^2, where p^3 = p + 1
    constexpr std::uint32_t steps[] = {3242174889u, 2447445414u};
    sequences_[sequence] += steps[sequence];
    return sequences_[sequence] / 4294967296.0;
}

template <class At>
void HullSpray::for_places(int count, At&& at) {
    std::size_t jet = 0;
    double before_j = 0;
    for (int i = 0; i < count; ++i) {
        const double at_j = (i + next_fraction(0)) / count * energy_j_;
        while (jet + 1 < jets_.size() && before_j + jets_[jet].energy_j < at_j) before_j += jets_[jet++].energy_j;
        const Jet& of = jets_[jet];
        const double along = std::clamp((at_j - before_j) / of.energy_j, 0.0, 1.0);
        at(of, of.from_m + along * (of.to_m - of.from_m));
    }
}

void HullSpray::add_droplets(const HullLoads& loads, const HullState& state, double step_s, double time_s) {
    double water_kg = 0;
    for (const Jet& jet : jets_) water_kg += 2 * jet.energy_j / glm::dot(jet.jet_mps, jet.jet_mps);
    const double clumps = std::min<double>(water_kg / options_.clump_kg, options_.max_droplets);
    const auto count = std::min(static_cast<int>(clumps + next_fraction(1)), options_.max_droplets);
    double momentum = 0;
    for_places(count, [&](const Jet& jet, const glm::dvec3& place_m) {
        const double speed = glm::length(jet.jet_mps), fastest = (1 + spread) * speed,
                     delay_s = step_s * next_fraction(1);
        const glm::dvec3 at = state.position_m + place_m + delay_s * jet.hull_mps + options_.radius_m * jet.out;
        const glm::dvec3 velocity = glm::clamp(jet.water_mps + jet.jet_mps, -100.0, 100.0);
        emitters_.push_back({.time_s = time_s + delay_s,
                             .x_m = at.x,
                             .y_m = at.y,
                             .z_m = at.z,
                             .extent_m = options_.radius_m,
                             .velocity_x_mps = velocity.x,
                             .velocity_y_mps = velocity.y,
                             .velocity_z_mps = velocity.z,
                             .spread_mps = spread * speed,
                             .radius_m = options_.radius_m,
                             .drop_mm = std::clamp(1000 * drop_m3ps2 / (speed * speed), 0.1, 5.0)});
        masses_kg_.push_back(2 * energy_j_ / count / (fastest * fastest));
        momentum += masses_kg_.back() * fastest;
    });
    const double limit = step_s * loads.impact_n;
    if (momentum > limit)
        for (double& mass_kg : masses_kg_) mass_kg *= limit / momentum;
}

void HullSpray::add_foam(const HullLoads& loads, const HullState& state, double step_s) {
    double length_m = 0;
    for (const Jet& jet : jets_) length_m += glm::length(jet.to_m - jet.from_m);
    const double thrown = energy_j_ / (0.5 * step_s * loads.impact_w);
    const double thrust_npm = thrown * loads.impact_n / length_m;
    const double bore_m = std::sqrt(2 * thrust_npm / (hull_->options_.water_density_kgpm3 * gravity_mps2));
    const double radius_m = std::clamp(length_m / max_foam, 0.001, 1000.0);
    for_places(max_foam, [&](const Jet& jet, const glm::dvec3& place_m) {
        const glm::dvec3 at = state.position_m + place_m + 0.5 * radius_m * jet.out;
        foam_.push_back({.mode = Disturbance::Mode::foam,
                         .x_m = at.x,
                         .z_m = at.z,
                         .radius_m = radius_m,
                         .height_m = std::min(bore_m, 100.0)});
    });
}

std::vector<std::uint8_t> HullSpray::save_state() const {
    std::vector<std::uint8_t> saved(sizeof sequences_);
    std::memcpy(saved.data(), sequences_.data(), sizeof sequences_);
    return saved;
}

void HullSpray::restore_state(std::span<const std::uint8_t> saved) {
    if (saved.size() != sizeof sequences_)
        throw std::invalid_argument(
            invalid_value_message("the saved spray's number of bytes", saved.size(), number_text(sizeof sequences_)));
    std::memcpy(sequences_.data(), saved.data(), sizeof sequences_);
}

}  // namespace pelagic
