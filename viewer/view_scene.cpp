#include "pelagic/viewer/view_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <tuple>

#include "pelagic/viewer/picked_place.hpp"

namespace pelagic::viewer {
namespace {

/// Upper limit of the time to bake a spectrum while frames are drawn.
constexpr double baking_s = 0.1;
constexpr double min_change_s = 0.1;

/// Dynamic-wave grid: large enough for a boat's wake, of which only the crests behind the stern
/// break. Computing a tick takes about 0.14 ms.
constexpr DynamicWavesOptions dynamic_waves{.resolution = 256, .side_m = 128, .border_m = 16, .foam_height_m = 0.35};
constexpr double splash_reach_m = 400;
constexpr Disturbance splash{.mode = Disturbance::Mode::impulse, .radius_m = 1.2, .height_m = 1};
/// Distance ahead of the camera at which a boat is placed.
constexpr double boat_ahead_m = 22;
/// Waves of a millimetre, for a boat on small water, whose waves are only drawn.
const SeaState still_water{.resolution = 16, .patch_size_m = 100, .wind_speed_mps = 0.05};

bool same_sea(const SeaState& a, const SeaState& b) {
    if (std::tie(a.waves, a.spectrum, a.spreading, a.systems) != std::tie(b.waves, b.spectrum, b.spreading, b.systems))
        return false;
    return std::ranges::all_of(sea_state_fields(),
                               [&](const SeaStateField& field) { return field.value_in(a) == field.value_in(b); });
}

}  // namespace

ViewScene::ViewScene(const ViewOptions& options, ViewSettings& settings, ViewCamera& camera,
                     ViewStatistics& statistics)
    : options_(options), settings_(settings), camera_(camera), statistics_(statistics) {
    create_ocean(0, options.changes);
}

bool ViewScene::follow_settings(double time_s) {
    if (statistics_.sea_is_baking || same_sea(settings_.sea, shown_sea_)) return true;
    if (!check(settings_.sea).empty()) {
        settings_.sea = shown_sea_;  // a slider made the sea state invalid
        return true;
    }
    // A transition that the user started ends before the next one starts.
    const std::vector<SeaChange>& changes = ocean_->forecast().changes;
    const double remaining_s = changes.empty() ? 0 : changes.back().end_s() - time_s;
    if (!settings_.frozen && remaining_s > 0 && remaining_s <= settings_.change_over_s + baking_s) return true;
    if (!starts_transition(time_s)) {
        if (!ocean_supports(settings_.sea)) return false;
        ocean_->schedule_sea(settings_.sea);
        statistics_.sea_is_baking = true;
    }
    shown_sea_ = settings_.sea;
    return true;
}

/// Schedules a transition to the chosen sea state. Returns false if it is not possible.
bool ViewScene::starts_transition(double time_s) {
    if (settings_.frozen || settings_.change_over_s < min_change_s) return false;
    try {
        ocean_->schedule_sea(settings_.sea, time_s + baking_s, settings_.change_over_s);
    } catch (const std::invalid_argument&) {
        // The sea has longer waves or other cascades, or a later transition is already scheduled.
        return false;
    }
    return true;
}

/// Returns true if the ocean can change to that sea state. An ocean's number of cascades, resolution
/// and kind of waves are fixed; with a shore, its sea state is fixed too.
bool ViewScene::ocean_supports(const SeaState& sea) const {
    return !options_.shore && cascades_of(sea) == static_cast<int>(ocean_->cascade_count()) &&
           resolution_of(sea) == ocean_->resolution() &&
           (sea.waves == ocean_->sea().waves || !(is_of_fixed_model(sea) || is_of_fixed_model(ocean_->sea())));
}

void ViewScene::create_ocean(double time_s, const std::vector<SeaChange>& changes) {
    shown_sea_ = settings_.sea;
    std::optional<ShoreOptions> shore = options_.shore;
    if (shore && !check(*shore, shown_sea_).empty()) shore.reset();
    ocean_.emplace(Forecast{.first = shown_sea_, .changes = changes},
                   OceanOptions{.executor = make_default_executor(options_.threads),
                                .trace = stage_times_,
                                .queries = true,
                                .depth = true,
                                .slopes = true,
                                .foam = true,
                                .dynamic_waves = dynamic_waves,
                                .shore = shore,
                                .spray = has_spray() ? std::optional(gl::drawn_spray) : std::nullopt});
    ocean_->set_water_frame(options_.water_frame);
    if (boat_) boat_->float_on(ocean_->dynamic_waves());
    ocean_->dynamic_waves().set_center(grid_centre_.x, grid_centre_.y);
    stage_times_->follow(ocean_->graph());
    schedule_frame(time_s);
}

const Frame& ViewScene::complete(double time_s) {
    const Frame& frame = ocean_->complete();
    stage_times_->end_frame();
    if (statistics_.sea_is_baking && ocean_->sea_is_ready()) {
        ocean_->complete_sea();
        statistics_.sea_is_baking = false;
        ++changes_;
    }
    statistics_.sea_is_changing = ocean_->forecast().at(time_s).weight > 0;
    statistics_.cascade_sides_m.clear();
    for (const Cascade& cascade : frame.cascades) statistics_.cascade_sides_m.push_back(cascade.grid.side_m);
    statistics_.significant_wave_height_m = frame.statistics.significant_wave_height_m;
    return frame;
}

void ViewScene::schedule(const Frame& frame, double time_s, UserInput& input) {
    if (!settings_.frozen) {
        if (input.clicked) make_splash(frame, input);
        input.clicked.reset();
        if (input.boat_is_requested && !boat_) place_boat(frame);
        if (!input.boat_is_requested && boat_) remove_boat();
        if (boat_) advance_boat(frame, input.helm);
        // Keeps the grid at its place, from which a current carries it.
        const glm::dvec2 centre = boat_ ? boat_->place_m() : grid_centre_;
        ocean_->dynamic_waves().set_center(centre.x, centre.y);
    }
    schedule_frame(time_s);
}

void ViewScene::schedule_frame(double time_s) {
    const glm::dvec3 viewer_m = camera_.camera().position_m;
    if (has_spray()) ocean_->set_spray_center(viewer_m.x, viewer_m.z);
    ocean_->schedule(time_s);
}

std::span<const SprayDroplet> ViewScene::droplets(const Frame& frame) const {
    const bool is_wanted = options_.spray.value_or(statistics_.shading != gl::Shading::headset);
    if (!is_wanted || settings_.surface != gl::Surface::open || settings_.wireframe) return {};
    return frame.droplets;
}

/// Returns the drawn water. Small water (gl::Surface) replaces the cascades, so their heights are
/// left out.
Frame ViewScene::boat_water(const Frame& frame) {
    if (settings_.surface == gl::Surface::open) return frame;
    if (!still_ocean_)
        still_ocean_.emplace(still_water,
                             OceanOptions{.executor = make_serial_executor(), .queries = true, .depth = true});
    Frame still = still_ocean_->frame_at(0);
    still.time_s = frame.time_s;
    still.water_frame = frame.water_frame;
    still.dynamic_waves = frame.dynamic_waves;
    return still;
}

void ViewScene::make_splash(const Frame& frame, const UserInput& input) {
    const auto place =
        picked_place(SurfaceQuery(frame), camera_.camera(), *input.clicked, input.window, splash_reach_m);
    if (!place) return;
    // Centres the dynamic-wave grid on the splash, unless it follows a boat.
    if (!boat_ && glm::length(*place - grid_centre_) > dynamic_waves.side_m / 4) {
        grid_centre_ = *place;
        ocean_->dynamic_waves().set_center(place->x, place->y);
    }
    Disturbance here = splash;
    here.x_m = place->x;
    here.z_m = place->y;
    ocean_->dynamic_waves().add_impulse(here);
}

void ViewScene::place_boat(const Frame& frame) {
    const Camera seen = camera_.camera();
    const glm::dvec2 ahead(seen.target_m.x - seen.position_m.x, seen.target_m.z - seen.position_m.z);
    const double heading = std::atan2(ahead.y, ahead.x);
    boat_.emplace(boat_water(frame),
                  glm::dvec2(seen.position_m.x, seen.position_m.z) +
                      boat_ahead_m * glm::dvec2(std::cos(heading), std::sin(heading)),
                  heading);
    boat_->float_on(ocean_->dynamic_waves());
    boat_time_s_ = frame.time_s;
    if (settings_.follows_boat) camera_.look_at({boat_->place_m().x, 1, boat_->place_m().y});
}

void ViewScene::remove_boat() {
    grid_centre_ = boat_->place_m();
    boat_->leave_water();
    boat_.reset();
    statistics_.boat_mps.reset();
}

void ViewScene::advance_boat(const Frame& frame, const Helm& helm) {
    const glm::dvec2 before = boat_->place_m();
    boat_->advance(boat_water(frame), frame.time_s - boat_time_s_, helm);
    boat_time_s_ = frame.time_s;
    if (settings_.follows_boat) camera_.go_along(boat_->place_m() - before);
    if (has_spray()) ocean_->emit(boat_->thrown().emitters());
    for (const Disturbance& foam : boat_->thrown().foam()) ocean_->dynamic_waves().add_impulse(foam);
    statistics_.boat_mps = boat_->speed_mps();
}

}  // namespace pelagic::viewer
