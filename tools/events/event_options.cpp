#include "pelagic/tools/events/event_options.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

/// A day of ticks takes about ten minutes on one core.
constexpr double longest_replay_s = 86400;
/// The default border of 12 m on 64 m.
constexpr double border_part = 0.1875;
/// Lengths of a hull along the grid's side. 256 texels are 25 along the hull, which needs 12.
constexpr double hull_lengths = 10;
/// Crest height over wavelength at which foam begins, for waves as long as the hull. It is full at
/// twice this height, near the steepest wave, whose crest is 0.08 wavelengths high.
constexpr double breaking_part = 0.05;

std::array<double, 2> place_in(const std::string& text) {
    const std::vector<std::string> parts = split_at_commas(text);
    std::array<double, 2> place{};
    const auto reject = [&] { throw bad_value("--events-at", text, "X,Z: two numbers of metres in [-1e8, 1e8]"); };
    if (parts.size() != 2) reject();
    for (std::size_t i = 0; i < 2; ++i) {
        const auto value = parse_number(parts[i]);
        if (!value || std::fabs(*value) > 1e8) reject();
        place[i] = *value;
    }
    return place;
}

/// Returns the centre of the smallest box around the places where events begin.
std::array<double, 2> middle_of(const EventFile& file) {
    const Disturbance& first = file.events.front().push;
    double min_x = first.x_m, max_x = first.x_m, min_z = first.z_m, max_z = first.z_m;
    for (const WaterEvent& event : file.events) {
        min_x = std::min(min_x, event.push.x_m), max_x = std::max(max_x, event.push.x_m);
        min_z = std::min(min_z, event.push.z_m), max_z = std::max(max_z, event.push.z_m);
    }
    return {(min_x + max_x) / 2, (min_z + max_z) / 2};
}

}  // namespace

std::array<std::int64_t, 2> EventOptions::first_texels() const {
    const auto first = [&](double middle_m) {
        return static_cast<std::int64_t>(std::floor(middle_m / texel_m() + 0.5)) - water.resolution / 2;
    };
    return {first(middle_x_m), first(middle_z_m)};
}

std::size_t EventOptions::events_outside() const {
    const auto [first_x, first_z] = first_texels();
    const auto is_inside = [&](double at_m, std::int64_t first) {
        const double texel = at_m / texel_m() - static_cast<double>(first);
        return texel >= 0 && texel < water.resolution;
    };
    return static_cast<std::size_t>(std::count_if(
        file->events.begin(), file->events.end(), [&, x = first_x, z = first_z](const WaterEvent& event) {
            return !is_inside(event.push.x_m, x) || !is_inside(event.push.z_m, z);
        }));
}

std::vector<std::string> warnings_about(const EventOptions& options, bool is_loop) {
    std::vector<std::string> warnings;
    if (const std::size_t outside = options.events_outside(); outside > 0)
        warnings.push_back(number_text(outside) + " of " + number_text(options.file->events.size()) +
                           " events begin outside of the grid of " + number_text(options.water.side_m) +
                           " m around " + number_text(options.middle_x_m) + "," + number_text(options.middle_z_m) +
                           " and have no effect; --events-side and --events-at place it");
    if (is_loop)
        warnings.push_back("the frames are a loop, but dynamic waves events does not come back to where it began");
    return warnings;
}

void require_reachable(const EventOptions& options, double last_frame_s) {
    if (options.file->events.empty()) return;
    const double first_s = options.file->first_s();
    if (last_frame_s - first_s > longest_replay_s)
        throw InputError("--events has a first event at " + number_text(first_s) + " s and the last frame is at " +
                         number_text(last_frame_s) +
                         " s, expected 86400 s between them at most: each tick is computed");
}

void EventFlags::add_to(CLI::App& app) {
    const auto add = [&](const char* name, std::optional<std::string>& typed, const std::string& type,
                         const char* help) {
        app.add_option(name, typed, help)->type_name(type)->group(help_group::dynamic_waves);
    };
    add("--events", file_, "FILE.csv",
        "add disturbances; columns time,x,z,radius,height, optionally "
        "velocity,heading,duration,length,mode,hull");
    add("--events-side", side_, "METRES", "side of the grid; [1, 10000] (default: 64, or 10 lengths of a hull)");
    add("--events-resolution", resolution_, "64|128|256|512|1024", "texels along the grid's side (default: 256)");
    add("--events-at", at_, "X,Z", "centre of the grid in metres (default: the hull, or the centre of the events)");
    add("--events-step", step_, alternatives(names_of<DynamicWavesStep>()),
        "dispersive waves, or one speed for all waves, which is cheaper (default: spectral)");
}

std::optional<EventOptions> EventFlags::resolve(double depth_m, const std::optional<HullPlace>& hull) const {
    if (!file_ && !hull) {
        for (const auto& [flag, typed] :
             {std::pair("side", &side_), {"resolution", &resolution_}, {"at", &at_}, {"step", &step_}})
            if (*typed)
                throw InputError(std::string("--events-") + flag + " is " + **typed + "; it requires --events");
        return {};
    }
    EventOptions options;
    if (hull) {
        options.water.side_m = std::clamp(hull_lengths * hull->length_m, 1.0, 10000.0);
        options.water.foam_height_m = std::clamp(breaking_part * hull->length_m, 0.001, 100.0);
    }
    if (side_) options.water.side_m = number_in("--events-side", *side_, 1, 10000, "metres in [1, 10000]");
    if (resolution_) {
        constexpr const char* accepted = "64, 128, 256, 512 or 1024";
        const auto texels = parse_integer(*resolution_);
        if (!texels || *texels < 64 || *texels > 1024 || (*texels & (*texels - 1)) != 0)
            throw bad_value("--events-resolution", *resolution_, accepted);
        options.water.resolution = static_cast<int>(*texels);
    }
    if (step_) options.water.step = one_of<DynamicWavesStep>("--events-step", *step_);
    options.water.border_m = options.water.side_m * border_part;
    options.water.depth_m = depth_m;
    if (const std::string reason = check(options.water); !reason.empty())
        throw InputError("dynamic waves with --events-side " + number_text(options.water.side_m) +
                         " and --events-resolution " + number_text(options.water.resolution) + ": " + reason);
    std::optional<std::array<double, 2>> at;
    if (at_) at = place_in(*at_);
    if (file_ && file_->empty()) throw InputError("--events is empty, expected a CSV file");
    options.file = file_ ? read_events(*file_) : std::make_shared<const EventFile>();
    // Rejects too many events in one tick before anything is written.
    event_commands(*options.file, options.water.ticks_per_s);
    options.follows_hull = hull && !at;
    if (!at) at = hull ? std::array{hull->x_m, hull->z_m} : middle_of(*options.file);
    options.middle_x_m = (*at)[0];
    options.middle_z_m = (*at)[1];
    return options;
}

}  // namespace pelagic::tools
