// The vertex shader computes the same as quadtree/patch_vertex.hpp, so instances carry the fields
// of a PatchInstance: the position in steps as the origin of the engine's transform, the weights as
// its colour and custom data.
#include "pelagic/contrib/godot3/sea_drawing.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <optional>

#include "pelagic/quadtree/patch_mesh.hpp"
#include "pelagic/quadtree/skirt.hpp"

namespace pelagic::godot {
namespace {

// Constants of VisualServer, Image and Camera.
constexpr std::int64_t triangles = 4, transform_3d = 1, color_float = 2, custom_float = 2, shadows_off = 0;
constexpr std::int64_t texture_2d = 0, texture_2d_array = 3, mipmaps = 1, repeat = 2, filter = 4;
constexpr int format_rgba8 = 5, format_rgbaf = 11, format_rgbah = 15;
constexpr std::int64_t perspective = 0, orthogonal = 1, keep_width = 0;

constexpr std::size_t floats_per_instance = 12 + 4 + 4;  // transform, colour, custom data

const Method texture_create("VisualServer", "texture_create"), texture_allocate("VisualServer", "texture_allocate"),
    texture_set_data("VisualServer", "texture_set_data"), mesh_create("VisualServer", "mesh_create"),
    mesh_add_surface("VisualServer", "mesh_add_surface_from_arrays"),
    multimesh_create("VisualServer", "multimesh_create"), multimesh_allocate("VisualServer", "multimesh_allocate"),
    multimesh_set_mesh("VisualServer", "multimesh_set_mesh"),
    multimesh_set_bulk("VisualServer", "multimesh_set_as_bulk_array"),
    multimesh_set_visible("VisualServer", "multimesh_set_visible_instances"),
    instance_create("VisualServer", "instance_create2"), instance_set_visible("VisualServer", "instance_set_visible"),
    instance_set_box("VisualServer", "instance_set_custom_aabb"),
    instance_set_material("VisualServer", "instance_geometry_set_material_override"),
    instance_set_shadows("VisualServer", "instance_geometry_set_cast_shadows_setting"),
    material_set_param("VisualServer", "material_set_param"), free_rid("VisualServer", "free_rid");
const Method get_world("Spatial", "get_world"), is_visible_in_tree("Spatial", "is_visible_in_tree"),
    get_scenario("World", "get_scenario");
const Method get_viewport("Node", "get_viewport"), get_camera("Viewport", "get_camera"),
    get_size("Viewport", "get_size");
const Method get_camera_transform("Camera", "get_camera_transform"), get_projection("Camera", "get_projection"),
    get_fov("Camera", "get_fov"), get_camera_size("Camera", "get_size"), get_near("Camera", "get_znear"),
    get_far("Camera", "get_zfar"), get_keep_aspect("Camera", "get_keep_aspect_mode");
const Method create_from_data("Image", "create_from_data");

struct View {
    glm::dvec3 viewer_m;
    /// Unset for oblique frusta, for which nothing is culled.
    std::optional<glm::dmat4> clip_from_world;
};

View view_of(Object* camera, Object* viewport) {
    const auto place = get_camera_transform.on<Transform>(camera);
    glm::dmat4 world_from_camera(1);
    for (int row = 0; row < 3; ++row) {
        const Vector3& v = place.basis.row[row];
        world_from_camera[0][row] = v.x;
        world_from_camera[1][row] = v.y;
        world_from_camera[2][row] = v.z;
    }
    world_from_camera[3] = {place.origin.x, place.origin.y, place.origin.z, 1};
    View view{.viewer_m = glm::dvec3(world_from_camera[3]), .clip_from_world = {}};
    const auto size = get_size.on<Vector2>(viewport);
    const double aspect = size.y > 0 ? static_cast<double>(size.x) / size.y : 1;
    const double near_m = get_near.on<double>(camera), far_m = get_far.on<double>(camera);
    const bool is_of_width = get_keep_aspect.on<std::int64_t>(camera) == keep_width;
    const auto projection = get_projection.on<std::int64_t>(camera);
    glm::dmat4 clip_from_camera;
    if (projection == perspective) {
        const double half = std::tan(glm::radians(get_fov.on<double>(camera)) / 2);
        clip_from_camera = glm::perspective(2 * std::atan(is_of_width ? half / aspect : half), aspect, near_m, far_m);
    } else if (projection == orthogonal) {
        const double extent = get_camera_size.on<double>(camera) / 2;
        const double half_height = is_of_width ? extent / aspect : extent;
        clip_from_camera =
            glm::ortho(-half_height * aspect, half_height * aspect, -half_height, half_height, near_m, far_m);
    } else {
        return view;
    }
    view.clip_from_world = clip_from_camera * glm::inverse(world_from_camera);
    return view;
}

/// Creates a texture array with texels of a cascade. Anisotropic filtering is off: the shading
/// represents filtered slopes as roughness (sim/slope_sum.hpp), and a software driver would be
/// fifty times slower.
Rid texture_array(Object* server, const Frame& frame, int format, std::size_t layers) {
    const Rid texture = texture_create.on<Rid>(server);
    const std::int64_t side = frame.cascades[0].resolution();
    texture_allocate.on(server, texture, side, side, static_cast<std::int64_t>(layers), std::int64_t{format},
                        texture_2d_array, mipmaps | repeat | filter);
    return texture;
}

Rid texture_of(Object* server, int columns, int rows, int format, std::int64_t flags) {
    const Rid texture = texture_create.on<Rid>(server);
    texture_allocate.on(server, texture, std::int64_t{columns}, std::int64_t{rows}, std::int64_t{0},
                        std::int64_t{format}, texture_2d, flags);
    return texture;
}

std::span<const std::uint8_t> bytes_of(const auto& texels) {
    return {reinterpret_cast<const std::uint8_t*>(texels.data()), texels.size_bytes()};
}

/// Fills four floats per texel: height, its slopes along x and z by central differences, and foam.
/// \param height_at  height of texel (i, j), also of the neighbours of the outermost texels
template <class HeightAt>
void fill_water(std::vector<float>& texels, int columns, int rows, double texel_m, const HeightAt& height_at,
                std::span<const std::uint8_t> foam) {
    const auto per_m = static_cast<float>(0.5 / texel_m);
    texels.resize(4 * foam.size());
    float* to = texels.data();
    const std::uint8_t* foam_here = foam.data();
    for (int j = 0; j < rows; ++j)
        for (int i = 0; i < columns; ++i) {
            *to++ = height_at(i, j);
            *to++ = (height_at(i + 1, j) - height_at(i - 1, j)) * per_m;
            *to++ = (height_at(i, j + 1) - height_at(i, j - 1)) * per_m;
            *to++ = static_cast<float>(*foam_here++) * (1.f / 255);
        }
}

double fraction(double value) { return value - std::floor(value); }

Vector4 floats(double x, double y, double z, double w) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
}

}  // namespace

SeaDrawing::SeaDrawing(Object* node, Rid material, const QuadtreeOptions& options, const Frame& frame)
    : node_(node),
      server_(call(core::global_get_singleton, "VisualServer")),
      material_(material),
      selection_(options),
      image_(Held::made("Image")) {
    const PatchMesh mesh(options.vertices);
    std::vector<Vector3> vertices;
    for (const PatchMesh::Vertex& vertex : mesh.positions)
        vertices.push_back({static_cast<float>(vertex.i), 0, static_cast<float>(vertex.j)});
    for (std::size_t stitches = 0; stitches < patches_.size(); ++stitches) {
        const PatchMesh::Range& range = mesh.ranges[stitches];
        patches_[stitches] = batch_of(vertices, std::span(mesh.indices).subspan(range.first, range.count));
    }
    // The shader identifies skirt vertices by their height: x is t, y is 1 at the border and 2
    // outside.
    std::vector<Vector3> border;
    for (int t = 0; t <= options.vertices; ++t)
        for (const float outer : {0.f, 1.f}) border.push_back({static_cast<float>(t), 1 + outer, 0});
    skirt_ = batch_of(border, SkirtMesh(options.vertices).indices);

    const std::size_t cascades = frame.cascades.size();
    displacement_ = texture_array(server_, frame, format_rgbah, cascades);
    slopes_ = texture_array(server_, frame, format_rgba8, cascades);
    moments_ = texture_array(server_, frame, format_rgba8, cascades);
    textures_ = {{"displacement", displacement_}, {"slopes", slopes_}, {"moments", moments_}};
    if (frame.has_foam) {
        snapshot_versions_.resize(SnapshotFoam::images * cascades);
        snapshots_ = texture_array(server_, frame, format_rgba8, snapshot_versions_.size());
        textures_.push_back({"snapshots", snapshots_});
    }
    if (const DynamicWavesView& waves = frame.dynamic_waves) {
        dynamic_waves_ =
            texture_of(server_, waves.resolution, waves.resolution, format_rgbaf, mipmaps | repeat | filter);
        textures_.push_back({"dynamic_waves_texels", dynamic_waves_});
    }
    if (const ShoreSurface& shore = frame.shore) {
        shore_weights_ = texture_of(server_, shore.columns, shore.rows, format_rgba8, filter);
        shore_water_ = texture_of(server_, shore.columns, shore.rows, format_rgbaf, mipmaps | filter);
        textures_.insert(textures_.end(), {{"shore_weights", shore_weights_}, {"shore_water", shore_water_}});
        upload_image(shore_weights_, 0, shore.columns, shore.rows, format_rgba8, false,
                     bytes_of(shore.weights_rgba8));
    }
    for (const Texture& texture : textures_) set(texture.uniform, Value(texture.rid));
}

SeaDrawing::~SeaDrawing() {
    const auto free_batch = [&](const Batch& batch) {
        for (const Rid& rid : {batch.instance, batch.multimesh, batch.mesh}) free_rid.on(server_, rid);
    };
    for (const Batch& batch : patches_) free_batch(batch);
    free_batch(skirt_);
    for (const Texture& texture : textures_) {
        set(texture.uniform, Value());
        free_rid.on(server_, texture.rid);
    }
}

SeaDrawing::Batch SeaDrawing::batch_of(std::span<const Vector3> vertices, std::span<const std::uint16_t> indices) {
    // The engine's front faces are clockwise, Pelagic's counter-clockwise.
    Pool<int> clockwise(indices.size());
    clockwise.fill([&](std::span<int> room) {
        for (std::size_t i = 0; i < room.size(); i += 3) {
            room[i] = indices[i];
            room[i + 1] = indices[i + 2];
            room[i + 2] = indices[i + 1];
        }
    });
    constexpr int vertex_array = 0, index_array = 8, arrays_count = 9;
    Array arrays, no_blend_shapes;
    call(core::array_new, &arrays);
    call(core::array_new, &no_blend_shapes);
    for (int i = 0; i < arrays_count; ++i) {
        const Value value = i == vertex_array  ? Pool<Vector3>(vertices).value()
                            : i == index_array ? clockwise.value()
                                               : Value();
        call(core::array_append, &arrays, &value.variant());
    }
    Batch batch;
    batch.mesh = mesh_create.on<Rid>(server_);
    batch.multimesh = multimesh_create.on<Rid>(server_);
    const std::int64_t uncompressed = 0;
    mesh_add_surface.on(server_, batch.mesh, triangles, arrays, no_blend_shapes, uncompressed);
    call(core::array_destroy, &arrays);
    call(core::array_destroy, &no_blend_shapes);

    multimesh_set_mesh.on(server_, batch.multimesh, batch.mesh);
    const Held world(get_world.on<Object*>(node_));
    batch.instance = instance_create.on<Rid>(server_, batch.multimesh, get_scenario.on<Rid>(world.object()));
    // The quadtree culls patches, so the engine must not.
    constexpr float far_m = 1e6f;
    instance_set_box.on(server_, batch.instance, Box{{-far_m, -far_m, -far_m}, {2 * far_m, 2 * far_m, 2 * far_m}});
    instance_set_material.on(server_, batch.instance, material_);
    instance_set_shadows.on(server_, batch.instance, shadows_off);
    return batch;
}

void SeaDrawing::add_instance(Batch& batch, float x, float y, float z, std::array<float, 4> colour,
                              std::array<float, 4> custom) {
    const float rows[12] = {1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, z};
    batch.floats.insert(batch.floats.end(), std::begin(rows), std::end(rows));
    batch.floats.insert(batch.floats.end(), colour.begin(), colour.end());
    batch.floats.insert(batch.floats.end(), custom.begin(), custom.end());
}

void SeaDrawing::show(Batch& batch, bool is_visible) {
    const std::size_t count = batch.floats.size() / floats_per_instance;
    instance_set_visible.on(server_, batch.instance, is_visible && count > 0);
    if (count == 0) return;
    if (count > batch.room) {
        batch.room = std::max<std::size_t>(2 * count, 8);
        multimesh_allocate.on(server_, batch.multimesh, static_cast<std::int64_t>(batch.room), transform_3d,
                              color_float, custom_float);
    }
    batch.floats.resize(batch.room * floats_per_instance);  // the engine requires all instances
    const Pool<float> floats(batch.floats);
    multimesh_set_bulk.on(server_, batch.multimesh, floats.array());
    multimesh_set_visible.on(server_, batch.multimesh, static_cast<std::int64_t>(count));
}

void SeaDrawing::set(const char* parameter, const Value& value) {
    material_set_param.on(server_, material_, Text(parameter).string(), value.variant());
}

void SeaDrawing::upload_image(const Rid& texture, int layer, int columns, int rows, int format, bool has_mips,
                              std::span<const std::uint8_t> bytes) {
    create_from_data.on(image_.object(), std::int64_t{columns}, std::int64_t{rows}, has_mips, std::int64_t{format},
                        Pool<std::uint8_t>(bytes).array());
    texture_set_data.on(server_, texture, image_.object(), std::int64_t{layer});
}

void SeaDrawing::upload(const Frame& frame) {
    for (std::size_t i = 0; i < frame.cascades.size(); ++i) {
        const Cascade& cascade = frame.cascades[i];
        const int side = cascade.resolution(), layer = static_cast<int>(i);
        upload_image(displacement_, layer, side, side, format_rgbah, false, bytes_of(cascade.displacement_rgba16f));
        upload_image(slopes_, layer, side, side, format_rgba8, true, bytes_of(cascade.slopes_rgba8));
        upload_image(moments_, layer, side, side, format_rgba8, true, bytes_of(cascade.moments_rgba8));
    }
    if (frame.has_foam) upload_snapshots(frame);
    if (frame.dynamic_waves) upload_dynamic_waves(frame.dynamic_waves);
    if (frame.shore) upload_shore(frame.shore);
}

/// Uploads the images that have changed. About five times a second one image of each cascade does.
void SeaDrawing::upload_snapshots(const Frame& frame) {
    const std::size_t cascades = frame.cascades.size();
    for (std::size_t i = 0; i < cascades; ++i) {
        const Cascade& cascade = frame.cascades[i];
        for (std::size_t image = 0; image < SnapshotFoam::images; ++image) {
            const std::size_t layer = image * cascades + i;
            const std::span<const std::uint32_t> texels = cascade.snapshots_rgba8[image];
            if (texels.empty() || snapshot_versions_[layer] == cascade.snapshots_version[image]) continue;
            snapshot_versions_[layer] = cascade.snapshots_version[image];
            upload_image(snapshots_, static_cast<int>(layer), cascade.resolution(), cascade.resolution(),
                         format_rgba8, true, bytes_of(texels));
        }
    }
}

void SeaDrawing::upload_dynamic_waves(const DynamicWavesView& waves) {
    const int n = waves.resolution;
    // The grid's storage is toroidal.
    const auto height_at = [&](int i, int j) {
        return waves.height_m[static_cast<std::size_t>((j & (n - 1)) * n + (i & (n - 1)))];
    };
    fill_water(texels_, n, n, waves.texel_m, height_at, waves.foam);
    upload_image(dynamic_waves_, 0, n, n, format_rgbaf, false, bytes_of(std::span(texels_)));
}

void SeaDrawing::upload_shore(const ShoreSurface& shore) {
    // The height is 0 beyond the rectangle.
    const auto height_at = [&](int i, int j) {
        if (i < 0 || j < 0 || i >= shore.columns || j >= shore.rows) return 0.f;
        return shore.height_m[static_cast<std::size_t>(j * shore.columns + i)];
    };
    fill_water(texels_, shore.columns, shore.rows, shore.texel_m, height_at, shore.foam);
    upload_image(shore_water_, 0, shore.columns, shore.rows, format_rgbaf, false, bytes_of(std::span(texels_)));
}

// The outermost texels are excluded: their outer neighbours are on the opposite side of the torus.
void SeaDrawing::place_dynamic_waves(const DynamicWavesView& waves, glm::dvec2 viewer) {
    if (!waves) return set("dynamic_waves_extent", Value(floats(0, 0, 0, 0)));
    const double n = waves.resolution;
    const glm::dvec2 first(static_cast<double>(waves.first_x), static_cast<double>(waves.first_z));
    // The centre of a texture's texel is half a texel from its position.
    const auto coordinate = [&](double metres) { return fraction((metres / waves.texel_m + 0.5) / n); };
    const glm::dvec2 centre = (first + 0.5 * (n - 1)) * waves.texel_m - viewer;
    set("dynamic_waves_place",
        Value(floats(coordinate(viewer.x), coordinate(viewer.y), 1 / (n * waves.texel_m), 1 / waves.texel_m)));
    set("dynamic_waves_extent", Value(floats(centre.x, centre.y, 0.5 * (n - 3) * waves.texel_m, 0)));
}

void SeaDrawing::place_shore(const ShoreSurface& shore, glm::dvec2 viewer) {
    if (!shore) return set("shore_size", Value(floats(0, 0, 0, 0)));
    const glm::dvec2 texels(shore.columns, shore.rows);
    const glm::dvec2 place = ((viewer - glm::dvec2(shore.x_m, shore.z_m)) / shore.texel_m + 0.5) / texels;
    const glm::dvec2 per_m = 1.0 / (texels * shore.texel_m);
    const int last_mip = std::bit_width(static_cast<unsigned>(std::max(shore.columns, shore.rows))) - 1;
    set("shore_place", Value(floats(place.x, place.y, per_m.x, per_m.y)));
    set("shore_size", Value(floats(texels.x, texels.y, 1 / shore.texel_m, last_mip)));
}

void SeaDrawing::set_uniforms(const Frame& frame, const QuadtreeGrid& grid, glm::dvec3 viewer_m) {
    const glm::dvec2 viewer(viewer_m.x, viewer_m.z);
    const glm::dvec2 corner = glm::dvec2(grid.corner) * grid.step_m - viewer;
    const glm::dvec2 middle = (glm::dvec2(grid.corner) + 0.5 * grid.side) * grid.step_m - viewer;
    const glm::dvec2 fade = grid.fade_centre - viewer;
    const WaterFrame::Origin origin = frame.water_frame.origin_at(frame.time_s);
    const glm::dvec2 in_water = viewer - glm::dvec2(origin.x_m, origin.z_m);
    const QuadtreeOptions& options = selection_.options();
    set("sea_level_m", Value(origin.y_m));
    set("viewer", Value(Vector3{static_cast<float>(viewer_m.x), static_cast<float>(viewer_m.y),
                                static_cast<float>(viewer_m.z)}));
    set("grid", Value(floats(corner.x, corner.y, grid.step_m, grid.vertices)));
    set("grid_shape", Value(floats(middle.x, middle.y, grid.side, grid.deepest_level)));
    set("fade", Value(floats(fade.x, fade.y, grid.fade_end_m, 1 / (grid.fade_end_m - grid.fade_start_m))));
    const double resolution = frame.cascades[0].resolution();
    set("spacing", Value(floats(1 / (options.lod_scale * options.vertices), grid.step_m, std::log2(resolution), 0)));
    set("roughness_between_texels", Value(frame.statistics.roughness));
    place_dynamic_waves(frame.dynamic_waves, in_water);
    place_shore(frame.shore, viewer + glm::dvec2(frame.water_frame.origin_x_m, frame.water_frame.origin_z_m));
    set("cascades", Value(static_cast<std::int64_t>(frame.cascades.size())));
    set("foam_front", Value(floats(frame.statistics.foam_front_x, frame.statistics.foam_front_z, 0, 0)));
    set("foam_level", Value(frame.has_foam ? double{frame.foam.level} : SeaStatistics::no_foam_level));
    for (std::size_t image = 0; image < SnapshotFoam::images; ++image) {
        const auto age = [&](std::size_t byte) { return frame.foam.age[4 * image + byte]; };
        set(("snapshot_ages_" + std::to_string(image)).c_str(), Value(floats(age(0), age(1), age(2), age(3))));
    }
    for (std::size_t i = 0; i < frame.cascades.size(); ++i) {
        const Cascade& cascade = frame.cascades[i];
        const double side = cascade.grid.side_m;
        const CascadeGrid::Vector at = cascade.grid.in_cascade(in_water.x, in_water.y);
        const std::string number = std::to_string(i);
        // The centre of a texture's texel is half a texel from its reference position.
        set(("cascade_place_" + number).c_str(),
            Value(floats(fraction(at.along / side + 0.5 / resolution), fraction(at.across / side + 0.5 / resolution),
                         cascade.grid.cosine / side, cascade.grid.sine / side)));
        set(("cascade_scale_" + number).c_str(),
            Value(floats(1 / cascade.texel_m(), cascade.slope_ranges.slope, cascade.slope_ranges.variance,
                         cascade.slope_variance)));
        const bool makes_foam = frame.has_foam && !cascade.snapshots_rgba8[0].empty();
        set(("cascade_foam_" + number).c_str(),
            Value(floats(cascade.drift_columns / resolution, cascade.drift_rows / resolution,
                         makes_foam ? double{cascade.compression_scale} : 0, 0)));
    }
}

void SeaDrawing::draw(const Frame& frame) {
    Object* viewport = get_viewport.on<Object*>(node_);
    Object* camera = viewport ? get_camera.on<Object*>(viewport) : nullptr;
    if (!camera) return;
    const View view = view_of(camera, viewport);
    const DrawList& list = selection_.select(
        {.viewer_m = view.viewer_m,
         .views = view.clip_from_world ? std::span(&*view.clip_from_world, 1) : std::span<const glm::dmat4>(),
         .bounds = frame.bounds,
         .sea_level_m = frame.water_frame.sea_level_m,
         .depth = ClipDepth::minus_one_to_one});
    for (Batch& batch : patches_) batch.floats.clear();
    for (const DrawBatch& batch : list.batches)
        for (std::uint32_t i = batch.first; i < batch.first + batch.count; ++i) {
            const PatchInstance& patch = list.instances[i];
            const auto weight = [](std::uint16_t part) { return static_cast<float>(part) / full_weight; };
            add_instance(patches_[batch.stitches], patch.corner_x, patch.level, patch.corner_z,
                         {weight(patch.inner_weight), static_cast<float>(patch.diagonals), 0, 0},
                         {weight(patch.edge_weights[east]), weight(patch.edge_weights[north]),
                          weight(patch.edge_weights[west]), weight(patch.edge_weights[south])});
        }
    skirt_.floats.clear();
    for (const SkirtInstance& piece : list.skirt) add_instance(skirt_, piece.start, piece.level, piece.side, {}, {});
    const bool is_visible = is_visible_in_tree.on<bool>(node_);
    for (Batch& batch : patches_) show(batch, is_visible);
    show(skirt_, is_visible);
    if (!is_visible) return;
    upload(frame);
    set_uniforms(frame, list.grid, view.viewer_m);
}

}  // namespace pelagic::godot
