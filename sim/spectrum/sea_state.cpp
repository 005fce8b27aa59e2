#include "pelagic/sim/sea_state.hpp"

#include <algorithm>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/spectrum/system_spectrum.hpp"
#include "pelagic/sim/spectrum/wave_list.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic {
namespace {

// A cascade has 3 texels per shortest wave and 6 grid steps to its longest wave. The ratio of the
// sides of consecutive cascades is therefore at most N / 18. Cascades with fewer texels cannot form
// a stack.
constexpr int min_resolution_of_stacks = 32;

constexpr SeaStateField sea_state_field_table[] = {
    // generated from schema/sea.toml: table
    {"cascades", &SeaState::cascades, 1, 4, "1, 2, 3 or 4, or 0: chosen", Restriction::none, 0},
    {"resolution", &SeaState::resolution, 16, 2048,
     "a power of two from 16 to 2048, or 0: chosen", Restriction::powers_of_two, 0},
    {"patch_size_m", &SeaState::patch_size_m, 0.001, 1e6, "[0.001, 1e6], or 0: chosen", Restriction::none, 0},
    {"wind_speed_mps", &SeaState::wind_speed_mps, 0, 60, "(0, 60]", Restriction::above_min},
    {"wind_direction_rad", &SeaState::wind_direction_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
    {"fetch_m", &SeaState::fetch_m, 0, 2e6, "(0, 2e6]", Restriction::above_min},
    {"peak_period_s", &SeaState::peak_period_s, 1, 40, "[1, 40], or 0: chosen", Restriction::none, 0},
    {"peak_enhancement", &SeaState::peak_enhancement, 1, 10, "[1, 10]"},
    {"depth_m", &SeaState::depth_m, 0.01, 11000, "[0.01, 11000]"},
    {"choppiness", &SeaState::choppiness, 0, 1, "[0, 1]"},
    {"lean", &SeaState::lean, 0, 0.6, "[0, 0.6], or -1: from the wind", Restriction::none, -1},
    {"roughness", &SeaState::roughness, 0, 1, "[0, 1], or -1: from the wind", Restriction::none, -1},
    {"short_wave_cutoff", &SeaState::short_wave_cutoff, 0, 1, "[0, 1]"},
    {"wind_alignment", &SeaState::wind_alignment, 0, 1, "[0, 1]"},
    {"swell_height_m", &SeaState::swell_height_m, 0, 30, "[0, 30]"},
    {"swell_period_s", &SeaState::swell_period_s, 1, 40, "[1, 40]"},
    {"swell_direction_rad", &SeaState::swell_direction_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
    {"swell_spread_rad", &SeaState::swell_spread_rad, two_pi / 360, 2 * two_pi / 9, "[pi/180, 4 pi/9]"},
    {"loop_period_s", &SeaState::loop_period_s, 0.1, 86400, "[0.1, 86400]"},
    {"seed", &SeaState::seed, 0, 4294967295.0, "a whole number from 0 to 4294967295"},
    {"wave_count", &SeaState::wave_count, 1, 64, "1 to 64, or 0: chosen", Restriction::none, 0},
    {"longest_wave_m", &SeaState::longest_wave_m, 0.02, 1000, "[0.02, 1000], or 0: chosen", Restriction::none, 0},
    {"shortest_wave_m", &SeaState::shortest_wave_m, 0.01, 1000, "[0.01, 1000], or 0: chosen", Restriction::none, 0},
    {"wave_strength", &SeaState::wave_strength, 0, 2, "[0, 2]"},
    {"wave_height_m", &SeaState::wave_height_m, 0, 30, "(0, 30], or 0: chosen", Restriction::above_min, 0},
    {"wave_drag", &SeaState::wave_drag, 0, 1, "[0, 1]"},
    {"regular_height_m", &SeaState::regular_height_m, 0, 60, "(0, 60]", Restriction::above_min},
    {"regular_period_s", &SeaState::regular_period_s, 0.2, 60, "[0.2, 60]"},
    {"order", &SeaState::order, 1, 2, "1 or 2"},
    // end of generated
};

constexpr NumericField<WaveSystem> wave_system_field_table[] = {
    // generated from schema/wave_system.toml: table
    {"wind_speed_mps", &WaveSystem::wind_speed_mps, 0, 60, "(0, 60]", Restriction::above_min},
    {"fetch_m", &WaveSystem::fetch_m, 0, 2e6, "(0, 2e6]", Restriction::above_min},
    {"height_m", &WaveSystem::height_m, 0, 30, "(0, 30], or 0: by the wind", Restriction::above_min, 0},
    {"peak_period_s", &WaveSystem::peak_period_s, 1, 40, "[1, 40], or 0: by the wind", Restriction::none, 0},
    {"peak_enhancement", &WaveSystem::peak_enhancement, 1, 10, "[1, 10]"},
    {"direction_rad", &WaveSystem::direction_rad, -two_pi, two_pi, "[-2 pi, 2 pi]"},
    {"spread_rad", &WaveSystem::spread_rad, two_pi / 360, 2 * two_pi / 9,
     "[pi/180, 4 pi/9], or 0: by the spreading model", Restriction::none, 0},
    // end of generated
};

bool is_by_two_laws(SpectrumModel spectrum) {
    return spectrum == SpectrumModel::jonswap || spectrum == SpectrumModel::pierson_moskowitz;
}

/// Returns an empty string, or what is wrong with height and period of a system by their names.
std::string check_height(const WaveSystem& system, std::string_view height, std::string_view period) {
    if (!is_by_height(system)) return {};
    const auto [name, value] =
        system.height_m > 0 ? std::pair(height, system.height_m) : std::pair(period, system.peak_period_s);
    if (!is_by_two_laws(system.spectrum))
        return invalid_value_message(name, value, "0 where the spectrum is " + std::string(name_of(system.spectrum)));
    if (system.fetch_m != WaveSystem{}.fetch_m)
        return invalid_value_message("fetch_m", system.fetch_m, "none beside " + std::string(name));
    return {};
}

/// Checks the systems of a sea whose waves are a spectrum, each of which check_wave_system() accepts.
std::string check_systems(const SeaState& sea) {
    if (sea.spectrum == SpectrumModel::none && sea.swell_height_m == 0 && sea.systems.empty())
        return invalid_value_message("spectrum", "none", "a swell or a system with it, or another spectrum");
    return check_height(wind_sea_of(sea), "wave_height_m", "peak_period_s");
}

}  // namespace

bool is_phillips_paper(const SeaState& sea) {
    return sea.waves == WaveModel::spectrum && sea.spectrum == SpectrumModel::phillips_paper;
}

bool is_of_fixed_model(const SeaState& sea) {
    return sea.waves == WaveModel::pond || sea.waves == WaveModel::regular;
}

bool is_limited_to_one_cascade(const SeaState& sea) {
    return sea.patch_size_m > 0 || is_phillips_paper(sea) || is_of_fixed_model(sea);
}

int cascades_of(const SeaState& sea) {
    if (sea.cascades != 0) return sea.cascades;
    const bool is_one =
        is_limited_to_one_cascade(sea) || (sea.resolution != 0 && sea.resolution < min_resolution_of_stacks);
    return is_one ? 1 : default_cascades;
}

double lean_of(const SeaState& sea) {
    if (sea.waves != WaveModel::spectrum || sea.spectrum == SpectrumModel::none) return 0;
    if (sea.lean >= 0) return sea.lean;
    if (sea.spectrum == SpectrumModel::phillips_paper) return 0;
    // From light winds, in which few waves break, to a fresh breeze. Below that the lean eases in.
    constexpr double none_mps = 3, full_mps = 10;
    const double part = std::clamp((sea.wind_speed_mps - none_mps) / (full_mps - none_mps), 0.0, 1.0);
    return part * part * (3 - 2 * part) * std::min(0.32 + 0.01 * sea.wind_speed_mps, 0.6);
}

int resolution_of(const SeaState& sea) {
    if (sea.resolution != 0) return sea.resolution;
    return is_limited_to_one_cascade(sea) ? 256 : 128;
}

SpreadingModel spreading_of(const SeaState& sea) {
    return is_phillips_paper(sea) ? SpreadingModel::paper : sea.spreading;
}

std::span<const SeaStateField> sea_state_fields() { return sea_state_field_table; }

std::span<const NumericField<WaveSystem>> wave_system_fields() { return wave_system_field_table; }

std::string check_wave_system(const WaveSystem& system) {
    // generated from schema/wave_system.toml: checks
    if (static_cast<std::size_t>(system.spectrum) >= names_of<SpectrumModel>().size())
        return "spectrum is no known model";
    if (static_cast<std::size_t>(system.spreading) >= names_of<SpreadingModel>().size())
        return "spreading is no known model";
    // end of generated
    if (std::string reason = check_fields(system, wave_system_field_table); !reason.empty()) return reason;
    if (system.spectrum == SpectrumModel::none || system.spectrum == SpectrumModel::phillips_paper)
        return invalid_value_message("spectrum", name_of(system.spectrum), "phillips, pierson-moskowitz or jonswap");
    return check_height(system, "height_m", "peak_period_s");
}

std::string check(const SeaState& sea) {
    // generated from schema/sea.toml: checks
    if (static_cast<std::size_t>(sea.waves) >= names_of<WaveModel>().size())
        return "waves is no known model";
    if (static_cast<std::size_t>(sea.spectrum) >= names_of<SpectrumModel>().size())
        return "spectrum is no known model";
    if (static_cast<std::size_t>(sea.spreading) >= names_of<SpreadingModel>().size())
        return "spreading is no known model";
    if (const std::string reason = check_records("systems", sea.systems, check_wave_system);
        !reason.empty())
        return reason;
    // end of generated
    if (const std::string reason = check_fields(sea, sea_state_field_table); !reason.empty()) return reason;
    const bool is_papers = is_phillips_paper(sea);
    if (sea.cascades > 1) {
        if (sea.patch_size_m > 0)
            return invalid_value_message("cascades", sea.cascades, "1 where the side of the cascade is given");
        if (is_papers)
            return invalid_value_message("cascades", sea.cascades, "1 where the spectrum is phillips-paper");
        if (is_of_fixed_model(sea))
            return invalid_value_message("cascades", sea.cascades,
                                         "1 where waves is " + std::string(name_of(sea.waves)));
        if (sea.resolution != 0 && sea.resolution < min_resolution_of_stacks)
            return invalid_value_message("cascades", sea.cascades,
                                         "1 where the resolution is " + number_text(sea.resolution));
    }
    if (sea.waves != WaveModel::spectrum) return check_wave_list(sea);
    if (!is_papers) return check_systems(sea);
    if (!sea.systems.empty())
        return invalid_value_message("the number of systems", sea.systems.size(),
                                     "0 where the spectrum is phillips-paper");
    if (spreading_of(sea) != sea.spreading && sea.spreading != SeaState{}.spreading)
        return invalid_value_message("spreading", name_of(sea.spreading),
                                     "paper where the spectrum is phillips-paper");
    if (sea.swell_height_m != 0)
        return invalid_value_message("swell_height_m", sea.swell_height_m, "0 where the spectrum is phillips-paper");
    return check_height(wind_sea_of(sea), "wave_height_m", "peak_period_s");
}

}  // namespace pelagic
