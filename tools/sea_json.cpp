#include "pelagic/tools/sea_json.hpp"

#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/digest.hpp"
#include "pelagic/tools/pixel_meaning.hpp"

namespace pelagic::tools {

Json sea_as_json(const ResolvedSea& resolved) {
    const SeaState& sea = resolved.sea;
    Json json = {{"spectrum", name_of(sea.spectrum)}, {"spreading", name_of(sea.spreading)}};
    for (const SeaStateField& field : sea_state_fields()) {
        if (const SeaAngle* angle = sea_angle(field.name))
            json[angle->in_file] = resolved.*angle->degrees;  // as it was typed
        else
            std::visit([&](auto member) { json[field.name] = sea.*member; }, field.member);
    }
    return json;
}

Json options_as_json(const ExportOptions& options) {
    Json maps = Json::array();
    if (options.displacement) maps.push_back("displacement");
    if (options.gradient) maps.push_back("gradient");
    Json how = {{"start_s", options.start_s}, {"frames", options.frames}};
    if (options.fps)
        how["fps"] = *options.fps;
    else
        how["loop"] = true;
    how["maps"] = maps;
    how["mips"] = options.mips;
    how["half"] = options.half;
    how["format"] = options.format == ImageFormat::tiff ? "tif" : "exr";
    return {{"version", PELAGIC_VERSION}, {"sea", sea_as_json(options.sea)}, {"export", how}};
}

Json frame_as_json(const FrameRecord& record) {
    Json files = Json::array();
    for (const FileRecord& file : record.files) files.push_back({{"name", file.name}, {"xxh3", file.xxh3}});
    Json json = {{"frame", record.frame},
                 {"time_s", record.time_s},
                 {"hash", record.hash},
                 {"significant_wave_height_m", record.significant_wave_height_m},
                 {"height_min_m", record.height_min_m},
                 {"height_max_m", record.height_max_m},
                 {"files", files}};
    json["record_xxh3"] = digest_of(json.dump());
    return json;
}

Json waves_as_json(const SeaState& sea, double measured_significant_wave_height_m) {
    const ExpectedWaves expected = expected_waves(sea);
    Json height = {{"expected", expected.significant_wave_height_m},
                   {"measured", measured_significant_wave_height_m}};
    if (expected.model_significant_wave_height_m) height["model"] = *expected.model_significant_wave_height_m;
    const LoopFrequencies frequencies = loop_frequencies(sea);
    return {{"significant_wave_height_m", height},
            {"peak_period_s", {{"expected", expected.peak_period_s}, {"measured", measured_peak_period_s(sea)}}},
            {"peak_wavelength_m", expected.peak_wavelength_m},
            {"loop_frequencies",
             {{"for_90_percent", frequencies.for_90_percent}, {"largest_share", frequencies.largest_share}}}};
}

Json sea_json(const ExportOptions& options, const std::vector<FrameRecord>& frames) {
    double height_sum = 0;
    Json list = Json::array();
    for (const FrameRecord& frame : frames) {
        height_sum += frame.significant_wave_height_m;
        list.push_back(frame_as_json(frame));
    }
    Json json = options_as_json(options);
    json["channels"] = channels_as_json(options);
    json["layout"] = layout_as_json(options.sea.sea);
    json["waves"] = waves_as_json(options.sea.sea, height_sum / static_cast<double>(frames.size()));
    json["warnings"] = warnings_about(options.sea.sea);
    json["frames"] = list;
    return json;
}

}  // namespace pelagic::tools
