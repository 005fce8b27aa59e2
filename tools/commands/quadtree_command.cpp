// `pelagic quadtree`: selects the mesh patches for a view and writes statistics, a mesh and a plan.

#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/quadtree/quadtree_options.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/meshes/gltf_file.hpp"
#include "pelagic/tools/meshes/mesh.hpp"
#include "pelagic/tools/meshes/sea_mesh.hpp"
#include "pelagic/tools/options/camera_options.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/options/sea_options.hpp"
#include "pelagic/tools/record/sea_json.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr double view_aspect = 16.0 / 9;
constexpr double latest_s = 1e9;

std::span<const std::byte> as_bytes(const Bytes& bytes) { return std::as_bytes(std::span(bytes)); }

/// Returns one view, or two for eyes side by side.
std::vector<glm::dmat4> views_of(const Camera& camera, double eyes_apart_m) {
    if (eyes_apart_m == 0) return {camera.clip_from_world(view_aspect)};
    return {camera.moved_right(-eyes_apart_m / 2).clip_from_world(view_aspect),
            camera.moved_right(eyes_apart_m / 2).clip_from_world(view_aspect)};
}

/// Returns the median time of a selection in microseconds, over 101 calls.
double microseconds_of(Selection& selection, const SelectionInput& input) {
    std::vector<double> all;
    for (int i = 0; i < 101; ++i) {
        const auto start = std::chrono::steady_clock::now();
        selection.select(input);
        all.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
    }
    std::nth_element(all.begin(), all.begin() + 50, all.end());
    return all[50];
}

Json quadtree_statistics_json(const DrawList& list, const QuadtreeOptions& options, std::size_t views,
                              double microseconds) {
    Json levels = Json::array();
    for (int level = 0; level <= list.grid.deepest_level; ++level)
        levels.push_back({{"level", level},
                          {"patch_size_m", list.grid.patch_size_m(level)},
                          {"patches", list.statistics.patches_by_level[static_cast<std::size_t>(level)]}});
    Json batches = Json::array();
    for (const DrawBatch& batch : list.batches)
        batches.push_back({{"stitches", batch.stitches}, {"instances", batch.count}});
    return {{"size_m", options.size_m},
            {"vertices", options.vertices},
            {"lod_scale", options.lod_scale},
            {"cull_scale", options.cull_scale},
            {"views", views},
            {"instances", list.instances.size()},
            {"triangles", list.statistics.triangles},
            {"nodes_visited", list.statistics.nodes_visited},
            {"microseconds", std::round(microseconds * 100) / 100},
            {"skirt_pieces", list.skirt.size()},
            {"patches_by_level", levels},
            {"batches", batches}};
}

void print_quadtree_table(const Json& json) {
    std::printf("%-18s%g m, %d steps a patch side, lod scale %g\n", "grid", json.at("size_m").get<double>(),
                json.at("vertices").get<int>(), json.at("lod_scale").get<double>());
    for (const char* name : {"views", "instances", "triangles", "nodes_visited", "microseconds"})
        std::printf("%-18s%s\n", name, json.at(name).dump().c_str());
    std::printf("%-18s%zu, and the skirt\n", "batches", json.at("batches").size());
    for (const Json& level : json.at("patches_by_level"))
        std::printf("  level %d, %6g m  %s\n", level.at("level").get<int>(), level.at("patch_size_m").get<double>(),
                    level.at("patches").dump().c_str());
}

class QuadtreeCommand final : public Command {
   public:
    void add_options(CLI::App& app) override;
    /// Prints statistics and writes the files that options name. Throws InputError and FileError.
    void run() override;

   private:
    QuadtreeOptions quadtree() const;  ///< throws InputError

    SeaOptions sea_;
    ComputeFlags compute_;
    CameraFlags camera_;
    std::optional<std::string> size_, quality_, time_, stereo_, obj_, ply_, gltf_, json_, svg_;
    bool all_ = false, foam_ = false;
};

QuadtreeOptions QuadtreeCommand::quadtree() const {
    const std::string name = quality_.value_or("high");
    const QuadtreePreset* preset = quadtree_preset_named(name);
    if (preset == nullptr) {
        std::vector<std::string> names;
        for (const QuadtreePreset& known : quadtree_presets()) names.emplace_back(known.name);
        throw unknown_name("--quality", name, names);
    }
    return preset->options(size_ ? number_in("--size", *size_, 256, 8192, "[256, 8192]") : 2048);
}

void QuadtreeCommand::add_options(CLI::App& app) {
    app.option_defaults()->group(help_group::view);
    app.add_option("--size", size_, "side of the square of sea; [256, 8192] (default: 2048)")->type_name("METRES");
    app.add_option("--quality", quality_, "level of detail; or the paper's, as paper_high (default: high)")
        ->type_name("low|medium|high|ultra");
    camera_.add_to(app);
    app.add_option("--stereo", stereo_, "distance between two eyes; (0, 1] (default: one view)")->type_name("METRES");
    app.add_option("--time", time_, "time of the frame; [-1e9, 1e9] (default: 0)")->type_name("SECONDS");
    app.add_flag("--all", all_, "select every patch, visible or not");
    app.option_defaults()->group(help_group::output);
    app.add_option("--obj", obj_, "write the displaced mesh as OBJ, with normals and texture coordinates")
        ->type_name("FILE.obj");
    app.add_option("--ply", ply_, "write the displaced mesh as binary PLY")->type_name("FILE.ply");
    app.add_option("--gltf", gltf_, "write the displaced mesh as binary glTF")->type_name("FILE.glb");
    app.add_flag("--foam", foam_, "add foam to the mesh as vertex colour");
    app.add_option("--json", json_, "write the statistics as JSON")->type_name("FILE.json");
    app.add_option("--svg", svg_, "write the plan of the patches, coloured by level")->type_name("FILE.svg");
    sea_.add_to(app, SeaOptions::PresetName::positional_too);
    compute_.add_to(app);
}

void QuadtreeCommand::run() {
    const QuadtreeOptions options = quadtree();
    const Camera camera = camera_.resolve();
    const double apart_m = stereo_ ? number_in("--stereo", *stereo_, 0, 1, "(0, 1]") : 0;
    if (stereo_ && apart_m == 0) throw bad_value("--stereo", *stereo_, "(0, 1]");
    const double time_s = time_ ? number_in("--time", *time_, -latest_s, latest_s, "[-1e9, 1e9]") : 0;
    const ResolvedSea sea = sea_.resolve();
    const ComputeOptions compute = compute_.resolve();
    const std::optional<OutputFile> obj = file_for("--obj", obj_), ply = file_for("--ply", ply_),
                                    gltf = file_for("--gltf", gltf_), json = file_for("--json", json_),
                                    svg = file_for("--svg", svg_);

    Ocean ocean(sea.sea, {.executor = make_default_executor(compute.threads), .isa = compute.isa, .foam = foam_});
    const Frame& frame = ocean.frame_at(time_s);
    const std::vector<glm::dmat4> views = all_ ? std::vector<glm::dmat4>() : views_of(camera, apart_m);
    const SelectionInput input{
        .viewer_m = camera.position_m, .views = views, .bounds = frame.bounds, .depth = ClipDepth::minus_one_to_one};
    Selection selection(options);
    const double microseconds = microseconds_of(selection, input);
    const DrawList& list = selection.list();

    const Json statistics = quadtree_statistics_json(list, options, views.size(), microseconds);
    if (obj || ply || gltf) {
        const Mesh mesh = mesh_of(list, frame);
        if (obj) obj->write(mesh_as_obj(mesh, ObjDigits::all));
        if (ply) ply->write(as_bytes(mesh_as_ply(mesh)));
        if (gltf) gltf->write(as_bytes(GlbFile(mesh).finish(1, false)));
    }
    if (json) json->write(statistics.dump(2) + "\n");
    if (svg) {
        Selection everything(options);
        const DrawList& all = everything.select({.viewer_m = camera.position_m});
        std::vector<Frustum> frusta;
        for (const glm::dmat4& view : views) frusta.emplace_back(view, ClipDepth::minus_one_to_one);
        svg->write(plan_as_svg(list, all, frusta, camera.position_m));
    }
    print_quadtree_table(statistics);
}

}  // namespace

std::unique_ptr<Command> make_quadtree_command() { return std::make_unique<QuadtreeCommand>(); }

}  // namespace pelagic::tools
