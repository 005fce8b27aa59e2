#include "pelagic/capi/c_sea.hpp"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/statistics.hpp"

namespace pelagic::capi {
namespace {

// generated from schema/sea.toml: c-checks
static_assert(PELAGIC_WAVES_SPECTRUM == static_cast<int>(WaveModel::spectrum));
static_assert(PELAGIC_WAVES_ANALYTIC == static_cast<int>(WaveModel::analytic));
static_assert(PELAGIC_WAVES_POND == static_cast<int>(WaveModel::pond));
static_assert(PELAGIC_WAVES_REGULAR == static_cast<int>(WaveModel::regular));
static_assert(PELAGIC_SPECTRUM_PHILLIPS_PAPER == static_cast<int>(SpectrumModel::phillips_paper));
static_assert(PELAGIC_SPECTRUM_PHILLIPS == static_cast<int>(SpectrumModel::phillips));
static_assert(PELAGIC_SPECTRUM_PIERSON_MOSKOWITZ == static_cast<int>(SpectrumModel::pierson_moskowitz));
static_assert(PELAGIC_SPECTRUM_JONSWAP == static_cast<int>(SpectrumModel::jonswap));
static_assert(PELAGIC_SPECTRUM_NONE == static_cast<int>(SpectrumModel::none));
static_assert(PELAGIC_SPREADING_PAPER == static_cast<int>(SpreadingModel::paper));
static_assert(PELAGIC_SPREADING_COSINE_2S == static_cast<int>(SpreadingModel::cosine_2s));
static_assert(PELAGIC_SPREADING_HASSELMANN == static_cast<int>(SpreadingModel::hasselmann));
static_assert(PELAGIC_SPREADING_DONELAN_BANNER == static_cast<int>(SpreadingModel::donelan_banner));
// end of generated

pelagic_wave_system c_wave_system_of(const WaveSystem& from) {
    pelagic_wave_system to{};
    // generated from schema/wave_system.toml: c-writes
    to.spectrum = static_cast<std::int32_t>(from.spectrum);
    to.spreading = static_cast<std::int32_t>(from.spreading);
    to.wind_speed_mps = from.wind_speed_mps;
    to.fetch_m = from.fetch_m;
    to.height_m = from.height_m;
    to.peak_period_s = from.peak_period_s;
    to.peak_enhancement = from.peak_enhancement;
    to.direction_rad = from.direction_rad;
    to.spread_rad = from.spread_rad;
    // end of generated
    return to;
}

pelagic_system_statistics c_system_of(const SystemReport& of) {
    return {.expected_wave_height_m = of.significant_wave_height_m,
            .realised_wave_height_m = of.realised_significant_wave_height_m,
            .expected_peak_period_s = of.peak_period_s,
            .realised_peak_period_s = of.realised_peak_period_s.value_or(0),
            .expected_direction_rad = of.expected_directions.mean_rad,
            .realised_direction_rad = of.realised_directions.mean_rad,
            .expected_spread_rad = of.expected_directions.spread_rad,
            .realised_spread_rad = of.realised_directions.spread_rad};
}

pelagic_sea c_sea_of(const SeaState& from) {
    pelagic_sea to{};
    // generated from schema/sea.toml: c-writes
    to.waves = static_cast<std::int32_t>(from.waves);
    to.spectrum = static_cast<std::int32_t>(from.spectrum);
    to.spreading = static_cast<std::int32_t>(from.spreading);
    to.cascades = from.cascades;
    to.resolution = from.resolution;
    to.patch_size_m = from.patch_size_m;
    to.wind_speed_mps = from.wind_speed_mps;
    to.wind_direction_rad = from.wind_direction_rad;
    to.fetch_m = from.fetch_m;
    to.peak_period_s = from.peak_period_s;
    to.peak_enhancement = from.peak_enhancement;
    to.depth_m = from.depth_m;
    to.choppiness = from.choppiness;
    to.lean = from.lean;
    to.roughness = from.roughness;
    to.short_wave_cutoff = from.short_wave_cutoff;
    to.wind_alignment = from.wind_alignment;
    to.swell_height_m = from.swell_height_m;
    to.swell_period_s = from.swell_period_s;
    to.swell_direction_rad = from.swell_direction_rad;
    to.swell_spread_rad = from.swell_spread_rad;
    to.loop_period_s = from.loop_period_s;
    to.seed = from.seed;
    to.wave_count = from.wave_count;
    to.longest_wave_m = from.longest_wave_m;
    to.shortest_wave_m = from.shortest_wave_m;
    to.wave_strength = from.wave_strength;
    to.wave_height_m = from.wave_height_m;
    to.wave_drag = from.wave_drag;
    to.regular_height_m = from.regular_height_m;
    to.regular_period_s = from.regular_period_s;
    to.order = from.order;
    to.system_count = write_records(from.systems, to.systems, c_wave_system_of);
    // end of generated
    return to;
}

std::string preset_names() {
    std::string names;
    for (const SeaPreset& preset : sea_presets())
        if (!preset.name.starts_with("beaufort-")) names.append(preset.name).append(", ");
    return names + "beaufort-0 to beaufort-12";
}

}  // namespace

void write_sea(const SeaState& from, pelagic_sea* sea) {
    struct_bytes(sea, "sea");
    write_struct(c_sea_of(from), sea);
}

WaveSystem wave_system_of(const pelagic_wave_system& from, std::string_view prefix) {
    WaveSystem to;
    // generated from schema/wave_system.toml: c-reads
    to.spectrum = enum_of<SpectrumModel>(from.spectrum, prefix, "spectrum", "one of PELAGIC_SPECTRUM_...");
    to.spreading = enum_of<SpreadingModel>(from.spreading, prefix, "spreading", "one of PELAGIC_SPREADING_...");
    to.wind_speed_mps = from.wind_speed_mps;
    to.fetch_m = from.fetch_m;
    to.height_m = from.height_m;
    to.peak_period_s = from.peak_period_s;
    to.peak_enhancement = from.peak_enhancement;
    to.direction_rad = from.direction_rad;
    to.spread_rad = from.spread_rad;
    // end of generated
    return to;
}

SeaState sea_of(const pelagic_sea* pointer) {
    const pelagic_sea from = read_struct(pointer, "sea");
    SeaState to;
    constexpr std::string_view prefix = "";
    // generated from schema/sea.toml: c-reads
    to.waves = enum_of<WaveModel>(from.waves, prefix, "waves", "one of PELAGIC_WAVES_...");
    to.spectrum = enum_of<SpectrumModel>(from.spectrum, prefix, "spectrum", "one of PELAGIC_SPECTRUM_...");
    to.spreading = enum_of<SpreadingModel>(from.spreading, prefix, "spreading", "one of PELAGIC_SPREADING_...");
    to.cascades = from.cascades;
    to.resolution = from.resolution;
    to.patch_size_m = from.patch_size_m;
    to.wind_speed_mps = from.wind_speed_mps;
    to.wind_direction_rad = from.wind_direction_rad;
    to.fetch_m = from.fetch_m;
    to.peak_period_s = from.peak_period_s;
    to.peak_enhancement = from.peak_enhancement;
    to.depth_m = from.depth_m;
    to.choppiness = from.choppiness;
    to.lean = from.lean;
    to.roughness = from.roughness;
    to.short_wave_cutoff = from.short_wave_cutoff;
    to.wind_alignment = from.wind_alignment;
    to.swell_height_m = from.swell_height_m;
    to.swell_period_s = from.swell_period_s;
    to.swell_direction_rad = from.swell_direction_rad;
    to.swell_spread_rad = from.swell_spread_rad;
    to.loop_period_s = from.loop_period_s;
    to.seed = from.seed;
    to.wave_count = from.wave_count;
    to.longest_wave_m = from.longest_wave_m;
    to.shortest_wave_m = from.shortest_wave_m;
    to.wave_strength = from.wave_strength;
    to.wave_height_m = from.wave_height_m;
    to.wave_drag = from.wave_drag;
    to.regular_height_m = from.regular_height_m;
    to.regular_period_s = from.regular_period_s;
    to.order = from.order;
    to.systems = records_of(from.systems, from.system_count, prefix, "systems", wave_system_of);
    // end of generated
    return to;
}

}  // namespace pelagic::capi

using namespace pelagic;
using namespace pelagic::capi;

pelagic_status pelagic_sea_preset(const char* name, pelagic_sea* sea) {
    return guarded([&] {
        const std::string_view wanted = &needed(name, "name");
        struct_bytes(sea, "sea");
        const SeaPreset* const preset = sea_preset_named(wanted);
        if (!preset) reject(invalid_value_message("preset", wanted, "one of " + preset_names()));
        write_struct(c_sea_of(preset->sea), sea);
    });
}

pelagic_status pelagic_preset_at(int32_t index, const char** name, const char** summary) {
    return guarded([&] {
        const std::span<const SeaPreset> all = sea_presets();
        if (index < 0 || static_cast<std::size_t>(index) >= all.size())
            reject(invalid_value_message("index", index, "0 to " + number_text(all.size() - 1)));
        const SeaPreset& preset = all[static_cast<std::size_t>(index)];
        needed(summary, "summary") = preset.summary.data();  // literals, so they end in 0
        needed(name, "name") = preset.name.data();
    });
}

pelagic_status pelagic_sea_check(const pelagic_sea* sea) {
    return guarded([&] {
        if (const std::string reason = check(sea_of(sea)); !reason.empty()) reject(reason);
    });
}

pelagic_status pelagic_sea_statistics(const pelagic_sea* sea, pelagic_statistics* statistics) {
    return guarded([&] {
        pelagic_statistics& out = needed(statistics, "statistics");
        const SeaState state = sea_of(sea);
        if (const std::string reason = check(state); !reason.empty()) reject(reason);
        const SeaReport report = report_on(state);
        pelagic_statistics all{};
        all.expected_wave_height_m = report.expected.significant_wave_height_m;
        all.realised_wave_height_m = report.realised_significant_wave_height_m;
        all.model_wave_height_m = report.expected.model_significant_wave_height_m.value_or(0);
        all.expected_peak_period_s = report.expected.peak_period_s;
        all.realised_peak_period_s =
            report.realised_significant_wave_height_m > 0 ? report.realised_peak_period_s : 0;
        all.peak_wavelength_m = report.expected.peak_wavelength_m;
        all.expected_tm01_s = report.expected_periods.tm01_s;
        all.realised_tm01_s = report.realised_periods.tm01_s;
        all.expected_tm02_s = report.expected_periods.tm02_s;
        all.realised_tm02_s = report.realised_periods.tm02_s;
        all.expected_direction_rad = report.expected_directions.mean_rad;
        all.realised_direction_rad = report.realised_directions.mean_rad;
        all.expected_spread_rad = report.expected_directions.spread_rad;
        all.realised_spread_rad = report.realised_directions.spread_rad;
        for (const CascadeSlopes& cascade : report.cascades) {
            all.slope_variance_along_wind += cascade.slopes.upwind;
            all.slope_variance_across_wind += cascade.slopes.crosswind;
        }
        all.expected_convergence_variance = report.expected_convergence_variance;
        all.realised_convergence_variance = report.realised_convergence_variance;
        if (report.wind_sea) all.wind_sea = c_system_of(*report.wind_sea);
        if (report.swell) all.swell = c_system_of(*report.swell);
        std::transform(report.systems.begin(), report.systems.end(), all.systems, c_system_of);
        all.system_count = static_cast<std::int32_t>(report.systems.size());
        all.effective_fetch_m = report.effective_fetch_m.value_or(0);
        all.repeats_after_m = repeat_length_m(state);
        out = all;
    });
}

pelagic_status pelagic_sea_spectrum(const pelagic_sea* sea, int32_t is_by_wave_number, const double* at, size_t count,
                                    double* energy) {
    return guarded([&] {
        const SeaState state = sea_of(sea);
        if (const std::string reason = check(state); !reason.empty()) reject(reason);
        if (count == 0) return;
        const std::span<const double> places(&needed(at, "at"), count);
        for (const double place : places)
            if (!(place > 0 && place < 1e9)) reject(invalid_value_message("at", place, "(0, 1e9)"));
        const std::vector<double> found =
            is_by_wave_number != 0 ? model_by_wave_number(state, places) : model_by_frequency(state, places);
        std::copy(found.begin(), found.end(), &needed(energy, "energy"));
    });
}
