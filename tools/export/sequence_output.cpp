#include "pelagic/tools/export/sequence_output.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/image_files.hpp"
#include "pelagic/tools/export/mesh_files.hpp"
#include "pelagic/tools/maps/map_image.hpp"
#include "pelagic/tools/maps/pixel_meaning.hpp"
#include "pelagic/tools/meshes/gltf_file.hpp"
#include "pelagic/tools/meshes/mesh.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

class MeshSequences : public SequenceOutput {
   public:
    explicit MeshSequences(const ExportOptions& options) : options_(options) {
        if (!options.meshes.has(MeshFormat::mdd)) return;
        const FrameTimes& times = options.times;
        std::vector<float> times_s;
        for (std::size_t i = 0; i < times.count(); ++i)
            times_s.push_back(static_cast<float>(times.time_of(times.number(i)) - times.time_of(times.number(0))));
        const auto row = static_cast<std::size_t>(options.meshes.patch.steps) + 1;
        mdd_.reserve(mdd_bytes(row * row, times.count()));
        append_mdd_header(mdd_, times_s, row * row);
    }

    void add(std::size_t, const Frame& frame) override {
        const Mesh mesh = exported_mesh(frame, options_);
        if (glb_)
            glb_->add(mesh);
        else if (options_.meshes.has(MeshFormat::gltf_animation))
            glb_.emplace(mesh, options_.times.count());
        if (!mdd_.empty()) append_mdd_frame(mdd_, mesh);
    }
    std::vector<File> finish() override {
        const FrameTimes& times = options_.times;
        const double fps = times.fps.value_or(static_cast<double>(times.count()) / times.loop_period_s);
        std::vector<File> files;  // an initializer list would copy the bytes
        if (glb_) files.push_back({mesh_animation_name, glb_->finish(fps, !times.fps)});
        glb_.reset();
        if (!mdd_.empty()) files.push_back({point_cache_name, std::move(mdd_)});
        return files;
    }

   private:
    const ExportOptions& options_;
    std::optional<GlbFile> glb_;
    Bytes mdd_;
};

/// Returns the mip levels of a flipbook. The smallest has one texel for each frame; smaller levels
/// would mix frames.
int flipbook_levels(const ExportOptions& options) {
    return is_texture(options.maps.format) && options.maps.mips ? mip_levels(resolution_of(options.sea.sea)) : 1;
}

/// The frames of one map and cascade.
struct Atlas {
    MapKind map;
    int cascade;
    std::vector<TextureImage> levels = {};
};

class Flipbook : public SequenceOutput {
   public:
    explicit Flipbook(const ExportOptions& options) : options_(options), grid_(*options.flipbook) {
        for (int cascade = 0; cascade < cascades_of(options.sea.sea); ++cascade)
            for (const MapKind map : options.maps.maps) atlases_.push_back({map, cascade});
    }

    void add(std::size_t index, const Frame& frame) override {
        for (Atlas& atlas : atlases_) {
            const std::vector<MapImage> levels =
                map_levels(frame, atlas.cascade, atlas.map, 0, flipbook_levels(options_), options_.maps);
            if (atlas.levels.empty())
                for (const MapImage& level : levels) atlas.levels.push_back(empty_level(level));
            for (std::size_t level = 0; level < levels.size(); ++level)
                put(levels[level], static_cast<int>(index), atlas.levels[level]);
        }
    }

    std::vector<File> finish() override {
        std::vector<File> files;
        for (const Atlas& atlas : atlases_)
            files.push_back({flipbook_name(options_.maps, atlas.map, atlas.cascade),
                             encode_pixels(atlas.map, atlas.levels, options_.maps)});
        const std::string json = as_json().dump(2) + "\n";
        files.push_back({flipbook_json_name, {json.begin(), json.end()}});
        return files;
    }

   private:
    TextureImage empty_level(const MapImage& cell) const {
        TextureImage image{grid_.columns * cell.side, grid_.rows * cell.side, cell.channels, cell.sample, {}};
        image.pixels.resize(cell.pixels.size() * static_cast<std::size_t>(grid_.columns * grid_.rows));
        return image;
    }

    void put(const MapImage& cell, int index, TextureImage& atlas) const {
        const auto column = static_cast<std::size_t>(index % grid_.columns),
                   row = static_cast<std::size_t>(index / grid_.columns);
        const auto side = static_cast<std::size_t>(cell.side);
        const std::size_t line = cell.pixels.size() / side;
        for (std::size_t j = 0; j < side; ++j)
            std::memcpy(&atlas.pixels[((row * side + j) * static_cast<std::size_t>(grid_.columns) + column) * line],
                        &cell.pixels[j * line], line);
    }

    nlohmann::ordered_json as_json() const {
        const FrameTimes& times = options_.times;
        const auto count = static_cast<double>(times.count());
        nlohmann::ordered_json json = {{"columns", grid_.columns},
                                       {"rows", grid_.rows},
                                       {"frames", times.count()},
                                       {"order", "from the upper left frame to the right, then row by row downwards"},
                                       {"fps", times.fps.value_or(count / times.loop_period_s)},
                                       {"loop", !times.fps},
                                       {"side", resolution_of(options_.sea.sea)},
                                       {"levels", flipbook_levels(options_)},
                                       {"channels", channels_as_json(options_.maps, false)}};
        for (const Atlas& atlas : atlases_)
            json["files"].push_back({{"name", flipbook_name(options_.maps, atlas.map, atlas.cascade)},
                                     {"map", name_of(atlas.map)},
                                     {"cascade", atlas.cascade}});
        return json;
    }

    ExportOptions options_;
    FlipbookGrid grid_;
    std::vector<Atlas> atlases_;
};

}  // namespace

std::vector<std::unique_ptr<SequenceOutput>> mesh_sequences(const ExportOptions& options) {
    std::vector<std::unique_ptr<SequenceOutput>> outputs;
    if (options.meshes.has(MeshFormat::gltf_animation) || options.meshes.has(MeshFormat::mdd))
        outputs.push_back(std::make_unique<MeshSequences>(options));
    return outputs;
}

std::vector<std::unique_ptr<SequenceOutput>> sequence_outputs(const ExportOptions& options) {
    std::vector<std::unique_ptr<SequenceOutput>> outputs = mesh_sequences(options);
    if (options.flipbook) outputs.push_back(std::make_unique<Flipbook>(options));
    return outputs;
}

void check_flipbook(const ExportOptions& options, const std::string& typed) {
    if (options.maps.maps.empty()) throw bad_value("--flipbook", typed, "some --maps");
    if (options.maps.foam_patch)
        throw bad_value("--flipbook", typed, "maps of cascades, and the foam of several cascades is none");
    if (options.maps.pack != Pack::files) throw bad_value("--flipbook", typed, "--pack files: it has an image a map");
    const FlipbookGrid& grid = *options.flipbook;
    const auto cells = static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows);
    if (cells < options.times.count())
        throw bad_value("--flipbook", typed, "room for " + number_text(options.times.count()) + " frames");
    const int side = resolution_of(options.sea.sea);
    if (std::max(grid.columns, grid.rows) * side > largest_flipbook_side)
        throw bad_value("--flipbook", typed,
                        "at most " + number_text(largest_flipbook_side / side) + " frames of " + number_text(side) +
                            " texels along a side, for a texture of " + number_text(largest_flipbook_side));
    constexpr double max_bytes = 2e9;
    double texel_bytes = 0;
    for (const MapKind map : options.maps.maps)
        texel_bytes +=
            static_cast<double>(channels_of(map)) * static_cast<double>(bytes_of(options.maps.sample_of(map)));
    const double bytes = texel_bytes * cascades_of(options.sea.sea) * side * side * static_cast<double>(cells);
    if (bytes > max_bytes)
        throw bad_value("--flipbook", typed,
                        "images of at most 2 GB together, and these have " + rounded_text(bytes / 1e9, 2) +
                            ": fewer frames, maps, cascades or texels");
}

}  // namespace pelagic::tools
