// The scene of the window: an ocean that changes to the chosen sea state, splashes, and a boat that
// the user steers.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/viewer/stage_times.hpp"
#include "pelagic/viewer/steered_boat.hpp"
#include "pelagic/viewer/viewer.hpp"

namespace pelagic::viewer {

/// What the user does to the water.
struct UserInput {
    std::optional<glm::dvec2> clicked;  ///< pixel of the window, from its upper left corner
    glm::dvec2 window{1};               ///< size of the window, in the unit of `clicked`
    Helm helm;
    bool boat_is_requested = false;
};

class ViewScene {
   public:
    /// Schedules the frame of time 0. The references must outlive the scene.
    ViewScene(const ViewOptions& options, ViewSettings& settings, ViewCamera& camera, ViewStatistics& statistics);

    /// Starts the change to the chosen sea state without waiting, or rejects an invalid one. Returns
    /// false if only another ocean can have it: create_ocean().
    bool follow_settings(double time_s);
    /// Replaces the ocean and schedules a frame. \pre nothing reads the old ocean's frames
    void create_ocean(double time_s, const std::vector<SeaChange>& changes = {});
    const Ocean& ocean() const { return *ocean_; }

    /// Completes the scheduled frame. \param time_s  of the next frame
    const Frame& complete(double time_s);
    /// Applies the input to the water, unless it is frozen, and schedules the next frame, which is
    /// computed while this one is drawn. Moves the camera with the boat.
    void schedule(const Frame& frame, double time_s, UserInput& input);

    /// Returns the droplets of a frame, none where spray is not drawn.
    std::span<const SprayDroplet> droplets(const Frame& frame) const;
    const std::optional<SteeredBoat>& boat() const { return boat_; }
    const StageTimes& stage_times() const { return *stage_times_; }
    /// Returns the number of changes of the sea state that are complete.
    unsigned long long changes() const { return changes_; }

   private:
    void schedule_frame(double time_s);
    bool starts_transition(double time_s);
    bool ocean_supports(const SeaState& sea) const;
    bool has_spray() const { return options_.spray.value_or(true); }
    Frame boat_water(const Frame& frame);
    void make_splash(const Frame& frame, const UserInput& input);
    void place_boat(const Frame& frame);
    void remove_boat();
    void advance_boat(const Frame& frame, const Helm& helm);

    const ViewOptions& options_;
    ViewSettings& settings_;
    ViewCamera& camera_;
    ViewStatistics& statistics_;
    std::shared_ptr<StageTimes> stage_times_ = std::make_shared<StageTimes>();
    std::optional<Ocean> ocean_;
    SeaState shown_sea_;
    unsigned long long changes_ = 0;
    glm::dvec2 grid_centre_{};  ///< centre of the dynamic-wave grid while there is no boat
    std::optional<SteeredBoat> boat_;
    double boat_time_s_ = 0;            ///< time of the boat's pose
    std::optional<Ocean> still_ocean_;  ///< of boat_water()
};

}  // namespace pelagic::viewer
