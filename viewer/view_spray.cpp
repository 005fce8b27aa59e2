#include "pelagic/viewer/view_spray.hpp"

#include <utility>

namespace pelagic::viewer {
namespace {

OceanOptions with_velocities(OceanOptions options) {
    options.velocities = true;
    return options;
}

}  // namespace

ViewSpray::ViewSpray(const Forecast& forecast, OceanOptions options)
    : spray_({.loop_period_s = forecast.first.loop_period_s}),
      ocean_(forecast, with_velocities(std::move(options))) {}

bool ViewSpray::complete(std::optional<double> wanted_s) {
    if (!scheduled_s_) return false;
    ocean_.complete();
    return std::exchange(scheduled_s_, std::nullopt) == wanted_s;
}

void ViewSpray::complete_sea() {
    complete({});
    ocean_.complete_sea();
}

std::span<const SprayDroplet> ViewSpray::at(double time_s, const glm::dvec3& viewer_m, bool schedules_next) {
    while (const std::optional<double> missing_s = spray_.missing_tick_s(time_s)) {
        const Frame& frame = complete(missing_s) ? ocean_.complete() : ocean_.frame_at(*missing_s);
        spray_.add_tick(frame, viewer_m.x, viewer_m.z);
    }
    if (schedules_next && !scheduled_s_) {
        scheduled_s_ = spray_.missing_tick_s(time_s + spray_.tick_s());
        if (scheduled_s_) ocean_.schedule(*scheduled_s_);
    }
    return spray_.droplets_at(time_s);
}

}  // namespace pelagic::viewer
