#include "pelagic/tools/record/sea_json.hpp"

#include <numbers>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/foam_report.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/files/digest.hpp"
#include "pelagic/tools/maps/pixel_meaning.hpp"
#include "pelagic/tools/options/sea_scales.hpp"

namespace pelagic::tools {
namespace {

Json files_as_json(const std::vector<FileRecord>& files) {
    Json list = Json::array();
    for (const FileRecord& file : files) list.push_back({{"name", file.name}, {"xxh3", file.xxh3}});
    return list;
}

Json names_as_json(const std::vector<FileRecord>& files) {
    Json list = Json::array();
    for (const FileRecord& file : files) list.push_back({{"name", file.name}});
    return list;
}

Json statistics_as_json(const FrameRecord& record) {
    Json json = {{"frame", record.frame}, {"time_s", record.time_s}, {"hash", record.hash}};
    if (!record.foam_hash.empty()) json["foam_hash"] = record.foam_hash;
    if (!record.dynamic_waves_hash.empty()) json["dynamic_waves_hash"] = record.dynamic_waves_hash;
    json["significant_wave_height_m"] = record.significant_wave_height_m;
    json["height_min_m"] = record.height_min_m;
    json["height_max_m"] = record.height_max_m;
    return json;
}

Json mesh_as_json(const MeshOptions& options) {
    Json formats = Json::array();
    for (const MeshFormat format : options.formats) formats.push_back(name_of(format));
    return {{"formats", formats},
            {"side_m", options.patch.side_m},
            {"steps", options.patch.steps},
            {"cascades", options.patch.cascades}};
}

Json system_as_json(const WaveSystem& system) {
    Json json = {{"spectrum", name_of(system.spectrum)}, {"spreading", name_of(system.spreading)}};
    for (const NumericField<WaveSystem>& field : wave_system_fields()) {
        std::string name(field.name);
        const double value = field.value_in(system);
        if (is_angle(name)) name.replace(name.size() - 3, 3, "deg");
        json[name] = is_angle(field.name) ? degrees_of(value) : value;
    }
    return json;
}

}  // namespace

Json sea_as_json(const ResolvedSea& resolved) {
    const SeaState& sea = resolved.sea;
    Json json = {
        {"waves", name_of(sea.waves)}, {"spectrum", name_of(sea.spectrum)}, {"spreading", name_of(sea.spreading)}};
    for (const SeaStateField& field : sea_state_fields()) {
        if (const SeaAngle* angle = sea_angle(field.name))
            json[angle->in_file] = resolved.*angle->degrees;  // in degrees, as on the command line
        else
            std::visit([&](auto member) { json[field.name] = sea.*member; }, field.member);
    }
    for (const WaveSystem& system : sea.systems) json["systems"].push_back(system_as_json(system));
    return json;
}

Json weather_as_json(const ResolvedSea& sea) {
    Json changes = Json::array();
    for (const ResolvedChange& change : sea.changes) {
        Json json = {{"from_s", change.from_s}, {"over_s", change.over_s}};
        if (change.swell_from_m) json["swell_from_m"] = *change.swell_from_m;
        json["sea"] = sea_as_json(change.sea);
        changes.push_back(std::move(json));
    }
    return changes;
}

Json options_as_json(const ExportOptions& options) {
    const FrameTimes& times = options.times;
    Json how = {{"start_s", times.start_s}, {"start_number", times.start_number}, {"frames", times.count()}};
    if (!times.is_one_run()) how["frame_numbers"] = text_of(times.ranges);
    if (times.fps)
        how["fps"] = *times.fps;
    else
        how["loop"] = true;
    Json maps = Json::array();
    for (const MapKind map : options.maps.maps) maps.push_back(name_of(map));
    how["maps"] = maps;
    how["mips"] = options.maps.mips;
    how["half"] = options.maps.half;
    if (const auto& patch = options.maps.foam_patch) {
        how["foam_size_m"] = patch->side_m;
        how["foam_pixels"] = patch->pixels;
    }
    how["bit_depth"] = name_of(options.maps.bit_depth);
    how["normal_y"] = name_of(options.maps.normal_y);
    how["axes"] = name_of(options.maps.up_axis);
    how["unit"] = name_of(options.maps.unit);
    how["rows"] = name_of(options.maps.rows);
    how["format"] = name_of(options.maps.format);
    how["compression"] = name_of(options.maps.compression);
    how["pack"] = name_of(options.maps.pack);
    how["tiled"] = options.maps.tiled;
    if (options.flipbook)
        how["flipbook"] = number_text(options.flipbook->columns) + "x" + number_text(options.flipbook->rows);
    if (options.maps.names) how["names"] = options.maps.names->text();
    if (options.events) {
        how["events_xxh3"] = options.events->file->digest;
        how["events_side_m"] = options.events->water.side_m;
        how["events_resolution"] = options.events->water.resolution;
        how["events_at"] = {options.events->middle_x_m, options.events->middle_z_m};
        how["events_step"] = name_of(options.events->water.step);
    }
    const WaterFrame& water = options.water_frame;
    if (water.sea_level_m != 0) how["sea_level_m"] = water.sea_level_m;
    if (water.current_x_mps != 0 || water.current_z_mps != 0)
        how["current_mps"] = {water.current_x_mps, water.current_z_mps};
    if (options.meshes.any()) how["mesh"] = mesh_as_json(options.meshes);
    Json json = {{"version", PELAGIC_VERSION}, {"sea", sea_as_json(options.sea)}};
    if (!options.sea.changes.empty()) json["weather"] = weather_as_json(options.sea);
    json["export"] = how;
    return json;
}

Json frame_as_json(const FrameRecord& record) {
    Json json = statistics_as_json(record);
    json["files"] = files_as_json(record.files);
    json["record_xxh3"] = digest_of(json.dump());
    return json;
}

Json frame_summary_as_json(const FrameRecord& record) {
    Json json = statistics_as_json(record);
    json["files"] = names_as_json(record.files);
    return json;
}

Json waves_as_json(const SeaState& sea, const SeaReport& report,
                   std::optional<double> measured_significant_wave_height_m) {
    const bool is_measured = measured_significant_wave_height_m.has_value();
    const ExpectedWaves& expected = report.expected;
    const auto both = [is_measured](double of_all_seeds, double of_this_one) -> Json {
        return {{"expected", of_all_seeds}, {"measured", is_measured ? Json(of_this_one) : Json()}};
    };
    const auto step = [](const ScaleStep& of) -> Json { return {{"number", of.number}, {"name", of.name}}; };
    const auto slopes = [](const SlopeVariance& of) -> Json {
        return {{"total", of.total()}, {"along_wind", of.upwind}, {"across_wind", of.crosswind}};
    };
    Json height = both(expected.significant_wave_height_m, measured_significant_wave_height_m.value_or(0));
    if (expected.model_significant_wave_height_m) height["model"] = *expected.model_significant_wave_height_m;
    Json cascades = Json::array();
    SlopeVariance all;  // waves of different cascades are independent
    for (const CascadeSlopes& cascade : report.cascades) {
        all.upwind += cascade.slopes.upwind;
        all.crosswind += cascade.slopes.crosswind;
        Json entry = {{"side_m", cascade.side_m}, {"resolution", cascade.resolution}};
        entry.update(slopes(cascade.slopes));
        cascades.push_back(entry);
    }
    Json json = {{"significant_wave_height_m", height},
                 {"peak_period_s", both(expected.peak_period_s, report.realised_peak_period_s)},
                 {"tm01_s", both(report.expected_periods.tm01_s, report.realised_periods.tm01_s)},
                 {"tm02_s", both(report.expected_periods.tm02_s, report.realised_periods.tm02_s)},
                 {"zero_crossing_period_s", both(report.expected_periods.tm02_s, report.realised_periods.tm02_s)},
                 {"peak_wavelength_m", expected.peak_wavelength_m},
                 {"mean_direction_deg", both(in_degrees(report.expected_directions.mean_rad),
                                             in_degrees(report.realised_directions.mean_rad))},
                 {"directional_spread_deg", both(in_degrees(report.expected_directions.spread_rad),
                                                 in_degrees(report.realised_directions.spread_rad))},
                 {"level_m", both(report.expected_level_m, report.realised_level_m)},
                 {"velocities_water_share", report.velocity_share},
                 {"steepness", expected.significant_wave_height_m / expected.peak_wavelength_m},
                 {"beaufort", step(beaufort_of(sea.wind_speed_mps))},
                 {"sea_state", step(sea_state_of(expected.significant_wave_height_m))},
                 {"slope_variance",
                  {{"cascades", cascades},
                   {"all", slopes(all)},
                   {"cox_and_munk", slopes(measured_slopes(sea.wind_speed_mps))}}},
                 {"loop_frequencies", Json()}};
    if (is_measured)
        json["loop_frequencies"] = {{"for_90_percent", report.loop_frequencies.for_90_percent},
                                    {"largest_share", report.loop_frequencies.largest_share}};
    if (report.expected_convergence_variance > 0)
        json["convergence_variance"] =
            both(report.expected_convergence_variance, report.realised_convergence_variance);
    const auto component = [&](const SystemReport& of) -> Json {
        return {
            {"significant_wave_height_m", both(of.significant_wave_height_m, of.realised_significant_wave_height_m)},
            {"peak_period_s", both(of.peak_period_s, of.realised_peak_period_s.value_or(0))},
            {"mean_direction_deg",
             both(in_degrees(of.expected_directions.mean_rad), in_degrees(of.realised_directions.mean_rad))},
            {"directional_spread_deg",
             both(in_degrees(of.expected_directions.spread_rad), in_degrees(of.realised_directions.spread_rad))}};
    };
    if (report.wind_sea) json["wind_sea"] = component(*report.wind_sea);
    if (report.swell) json["swell"] = component(*report.swell);
    for (const SystemReport& system : report.systems) json["systems"].push_back(component(system));
    if (report.effective_fetch_m) json["effective_fetch_m"] = *report.effective_fetch_m;
    return json;
}

double repeats_after_m(const ResolvedSea& sea) { return plan_cascades(forecast_of(sea)).front().grid.side_m; }

Json foam_as_json(const Frame& frame) {
    const FoamReport report = report_on_foam(frame);
    Json cascades = Json::array();
    for (std::size_t i = 0; i < report.cascades.size(); ++i) {
        const CascadeFoam& cascade = report.cascades[i];
        cascades.push_back({{"side_m", frame.cascades[i].grid.side_m},
                            {"makes_whitecaps", cascade.makes_whitecaps},
                            {"columns_per_loop", cascade.columns_per_loop},
                            {"rows_per_loop", cascade.rows_per_loop},
                            {"drift_mps", cascade.drift_mps}});
    }
    return {{"whitecap_cover", report.whitecap_cover},
            {"tick_s", report.tick_s},
            {"ticks_per_loop", report.ticks_per_loop},
            {"warm_up_ticks", report.warm_up_ticks},
            {"level", report.level},
            {"ramp", SnapshotFoam::ramp},
            {"fade_s", report.fade_s},
            {"drift_mps", report.drift_mps},
            {"drift_direction_deg", in_degrees(report.drift_direction_rad)},
            {"cascades", cascades}};
}

std::vector<std::string> warnings_of(const ResolvedSea& sea, const SeaReport& report) {
    std::vector<std::string> warnings = report.warnings;
    if (const std::string warning = warning_about_weather(sea); !warning.empty()) warnings.push_back(warning);
    return warnings;
}

Json sea_json_head(const ExportOptions& options, double mean_significant_wave_height_m,
                   const std::vector<FileRecord>& sequence_files) {
    Json json = options_as_json(options);
    json["channels"] = channels_as_json(options.maps, options.events.has_value());
    json["layout"] = layout_as_json(forecast_of(options.sea), options.maps);
    if (options.events) {
        const auto [first_x, first_z] = options.events->first_texels();
        json["dynamic_waves"] = dynamic_waves_layout_as_json(
            {options.events->water.resolution, options.events->texel_m(), first_x, first_z}, options.maps);
    }
    if (options.maps.foam_patch) json["foam_map"] = foam_patch_layout_as_json(options.maps);
    json["repeats_after_m"] = repeats_after_m(options.sea);
    const SeaReport report = report_on(options.sea.sea);
    json["waves"] = waves_as_json(options.sea.sea, report, mean_significant_wave_height_m);
    if (options.has_foam() || options.maps.has(MapKind::compression)) {
        Ocean ocean(options.sea.sea,
                    {.executor = make_default_executor(options.compute.threads), .isa = options.compute.isa});
        json["foam"] = foam_as_json(ocean.frame_at(0));
    }
    json["warnings"] = warnings_of(options.sea, report);
    if (options.events)
        for (const std::string& warning : warnings_about(*options.events, !options.times.fps))
            json["warnings"].push_back(warning);
    if (!sequence_files.empty()) json["sequence_files"] = names_as_json(sequence_files);
    return json;
}

Json record_head(const ExportOptions& options, const std::vector<FileRecord>& sequence_files) {
    Json json = options_as_json(options);
    if (!sequence_files.empty()) json["sequence_files"] = files_as_json(sequence_files);
    return json;
}

Json shard_head(const ExportOptions& options) {
    Json json = options_as_json(options);
    json["shard"] = {{"index", options.shard->index}, {"count", options.shard->count}};
    return json;
}

}  // namespace pelagic::tools
