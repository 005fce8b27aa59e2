#include "pelagic/tools/export/mesh_options.hpp"

#include <algorithm>

#include "pelagic/sim/forecast.hpp"
#include "pelagic/tools/meshes/gltf_file.hpp"
#include "pelagic/tools/meshes/mesh.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

/// Size limits of a file with all frames, which is built in memory; glTF needs twice its size.
constexpr std::size_t max_animation_bytes = std::size_t{512} << 20, max_point_cache_bytes = std::size_t{1} << 30;

std::vector<MeshFormat> formats_in(const std::string& text) {
    std::vector<MeshFormat> formats;
    for (const std::string& part : split_at_commas(text)) {
        const auto known = value_named<MeshFormat>(part);
        if (!known || std::find(formats.begin(), formats.end(), *known) != formats.end())
            throw bad_value("--mesh", text,
                            "obj, ply, gltf, gltf-animation, mdd or some of them with commas, each once");
        formats.push_back(*known);
    }
    std::sort(formats.begin(), formats.end());
    return formats;
}

void check_size(const char* format, std::size_t bytes, std::size_t max_bytes, std::size_t frames) {
    if (bytes > max_bytes)
        throw InputError("--mesh " + std::string(format) + " of " + number_text(frames) + " frames has " +
                         number_text(bytes >> 20) + " MiB, expected at most " + number_text(max_bytes >> 20) +
                         " MiB: fewer frames or --mesh-steps");
}

void check_sequences(const MeshOptions& options, const FrameTimes& times) {
    const auto steps = static_cast<std::size_t>(options.patch.steps), vertices = (steps + 1) * (steps + 1);
    const std::size_t frames = times.count();
    if (options.has(MeshFormat::gltf_animation)) {
        if (frames > GlbFile::max_frames)
            throw InputError("--mesh gltf-animation of " + number_text(frames) + " frames needs at most " +
                             number_text(GlbFile::max_frames) + ": each is a morph target");
        if (times.ranges.size() > 1)
            throw InputError("--mesh gltf-animation of frames " + text_of(times.ranges) +
                             " needs frames without a gap");
        check_size("gltf-animation", GlbFile::buffer_bytes(vertices, 2 * steps * steps, frames), max_animation_bytes,
                   frames);
    }
    if (options.has(MeshFormat::mdd)) check_size("mdd", mdd_bytes(vertices, frames), max_point_cache_bytes, frames);
}

}  // namespace

bool MeshOptions::has(MeshFormat format) const {
    return std::find(formats.begin(), formats.end(), format) != formats.end();
}

void MeshFlags::add_to(CLI::App& app) {
    app.option_defaults()->group(help_group::meshes);
    app.add_option("--mesh", formats_,
                   "write a square of the sea as meshes: obj, ply or gltf for each frame; gltf-animation or mdd for "
                   "all frames; separated by commas")
        ->type_name("FORMATS");
    app.add_option("--mesh-size", size_, "side of the square; [0.001, 1e6] (default: side of the coarsest cascade)")
        ->type_name("METRES");
    app.add_option("--mesh-steps", steps_, "cells along the side; 1 to 2048 (default: --resolution)")
        ->type_name("NUMBER");
}

MeshOptions MeshFlags::resolve(const ResolvedSea& sea, const FrameTimes& times) const {
    if (!formats_) {
        for (const auto& [option, text] : {std::pair("--mesh-size", &size_), {"--mesh-steps", &steps_}})
            if (*text) throw InputError(std::string(option) + " is " + **text + "; it requires --mesh");
        return {};
    }
    const std::vector<CascadePlan> plans = plan_cascades(forecast_of(sea));
    MeshOptions options{.formats = formats_in(*formats_), .patch = {}};
    SeaPatch& patch = options.patch;
    patch.side_m =
        size_ ? number_in("--mesh-size", *size_, 0.001, 1e6, "metres in [0.001, 1e6]") : plans.front().grid.side_m;
    patch.steps = steps_ ? whole_number_in("--mesh-steps", *steps_, 1, 2048) : plans.front().resolution;
    patch.cascades = cascades_shown_by(patch.side_m / patch.steps, plans);
    check_sequences(options, times);
    return options;
}

}  // namespace pelagic::tools
