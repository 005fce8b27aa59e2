#include "pelagic/contrib/godot4/sea_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace pelagic::godot4 {
namespace {

// Constants of Image.
constexpr int format_rgba8 = 5, format_rgbah = 15;
constexpr int after_scripts = 1000;

constexpr Option size_option{"size_m", Kind::real, 0, 256, 8192, false, none, 1, "[256, 8192]", ""};
constexpr Option quality_option{
    "quality", Kind::choice, 0, 0, 3, false, none, 1, "one of low,medium,high,ultra", "low,medium,high,ultra"};

double fraction(double value) { return value - std::floor(value); }

Vector4 floats(double x, double y, double z, double w) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z), static_cast<float>(w)};
}

template <class T>
std::span<const std::uint8_t> bytes_of(const T* first, std::size_t count) {
    return {reinterpret_cast<const std::uint8_t*>(first), count * sizeof(T)};
}

/// Vertices by their positions, in units of half the finest cell.
struct Grid {
    std::map<std::pair<int, int>, std::int32_t> numbers;
    std::vector<Vector3> vertices;
    std::vector<std::int32_t> triangles;
    double unit_m;

    std::int32_t vertex(int x, int z) {
        const auto [found, is_new] = numbers.try_emplace({x, z}, static_cast<std::int32_t>(vertices.size()));
        if (is_new) vertices.push_back({static_cast<float>(x * unit_m), 0, static_cast<float>(z * unit_m)});
        return found->second;
    }
    /// Clockwise as seen from above, which is the engine's front. Leaves out triangles without an area.
    void triangle(std::int32_t a, std::int32_t b, std::int32_t c) {
        if (a != b && b != c && c != a) triangles.insert(triangles.end(), {a, b, c});
    }
};

}  // namespace

void SeaMesh::enter_tree() {
    self().call("set_process_priority", after_scripts);
    self().call("set_as_top_level", true);
}

int SeaMesh::cells() const { return 32 << static_cast<int>(value_of(quality_option, "quality", Value(quality_))); }

Value SeaMesh::surface_arrays() const {
    const int half = cells() / 2;
    Grid grid{{}, {}, {}, finest_m()};
    for (int ring = 0; ring < rings; ++ring) {
        const int step = 1 << ring;
        // Odd vertices of the outer border join their even neighbours, which the next ring has.
        const auto corner = [&](int i, int j) {
            if (ring + 1 < rings) {
                if (std::abs(j) == half && i % 2 != 0) --i;
                if (std::abs(i) == half && j % 2 != 0) --j;
            }
            return grid.vertex(i * step, j * step);
        };
        for (int j = -half; j < half; ++j)
            for (int i = -half; i < half; ++i) {
                const bool is_hole = ring > 0 && i >= -half / 2 && i < half / 2 && j >= -half / 2 && j < half / 2;
                if (is_hole) continue;
                const std::int32_t a = corner(i, j), b = corner(i + 1, j), c = corner(i, j + 1),
                                   d = corner(i + 1, j + 1);
                // Diagonals that alternate, as the waves have no preferred one.
                if ((i + j) % 2 == 0) {
                    grid.triangle(a, b, d);
                    grid.triangle(a, d, c);
                } else {
                    grid.triangle(a, b, c);
                    grid.triangle(b, d, c);
                }
            }
    }
    // The skirt: flat water to the horizon.
    const int border = half << (rings - 1), step = 1 << (rings - 1), far = 20;
    for (int i = -border; i < border; i += step)
        for (const auto& [x0, z0, x1, z1] :
             {std::array{i, -border, i + step, -border}, std::array{border, i, border, i + step},
              std::array{-i, border, -i - step, border}, std::array{-border, -i, -border, -i - step}}) {
            const std::int32_t a = grid.vertex(far * x0, far * z0), b = grid.vertex(far * x1, far * z1);
            const std::int32_t c = grid.vertex(x0, z0), d = grid.vertex(x1, z1);
            grid.triangle(a, b, d);
            grid.triangle(a, d, c);
        }
    Value arrays = Value::empty(type_array);
    arrays.call("resize", arrays_count);
    arrays.set(vertex_array, Value::packed(grid.vertices));
    arrays.set(index_array, Value::packed(grid.triangles));
    return arrays;
}

void SeaMesh::process(double) {
    run_in_frame([&] { draw(); });
}

void SeaMesh::draw() {
    if (!self().call("is_visible_in_tree").boolean()) return;
    Ocean& ocean = Ocean::at(self(), ocean_);
    const pelagic_frame& frame = ocean.frame();
    if (!has_mesh_) {
        const Value mesh = Value::made("ArrayMesh");
        mesh.call("add_surface_from_arrays", primitive_triangles, surface_arrays());
        self().call("set_mesh", mesh);
        self().call("set_cast_shadows_setting", 0);  // of undisplaced water
        const float far_m = static_cast<float>(20 * size_m_);
        self().call("set_custom_aabb", Box{{-far_m, -100, -far_m}, {2 * far_m, 200, 2 * far_m}});
        has_mesh_ = true;
    }
    const Value viewport = self().call("get_viewport");
    const Value camera = viewport.is_nil() ? Value() : viewport.call("get_camera_3d");
    const double grain_m = 8 * finest_m();
    Transform pose{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, static_cast<float>(ocean.settings().water.sea_level_m), 0}};
    if (camera.object()) {
        const Vector3 eye = camera.call("get_global_transform").transform().origin;
        pose.origin.x = static_cast<float>(std::round(static_cast<double>(eye.x) / grain_m) * grain_m);
        pose.origin.z = static_cast<float>(std::round(static_cast<double>(eye.z) / grain_m) * grain_m);
    }
    self().call("set_global_transform", pose);
    const Value material = self().call("get_material_override");
    if (!material.object()) return;
    upload(ocean.handle(), frame, material);
    const auto set = [&](const std::string& name, const Value& value) {
        material.call("set_shader_parameter", name, value);
    };
    // The water's frame: what a current and the origin move.
    const pelagic_water_frame& water = ocean.settings().water;
    const double x = static_cast<double>(pose.origin.x) + ocean.origin_x_m() - water.current_x_mps * frame.time_s;
    const double z = static_cast<double>(pose.origin.z) + ocean.origin_z_m() - water.current_z_mps * frame.time_s;
    set("cascades", frame.cascade_count);
    set("fade", floats(0.35 * size_m_, 0.5 * size_m_, 0, 0));
    set("spacing", floats(4.0 / cells(), finest_m(), std::log2(frame.resolution), 0));
    set("roughness_between_texels", static_cast<double>(frame.roughness));
    set("foam_level", static_cast<double>(frame.foam_level));
    for (int image = 0; image < 4; ++image) {
        const float* age = frame.foam_age + 4 * image;
        set("snapshot_ages_" + std::to_string(image), Vector4{age[0], age[1], age[2], age[3]});
    }
    for (std::int32_t i = 0; i < frame.cascade_count; ++i) {
        pelagic_cascade cascade;
        require(pelagic_ocean_cascade(ocean.handle(), i, &cascade));
        const double side = cascade.side_m, n = cascade.resolution;
        const std::string number = std::to_string(i);
        // The centre of a texture's texel is half a texel from its reference position.
        set("cascade_place_" + number, floats(fraction((cascade.cosine * x + cascade.sine * z) / side + 0.5 / n),
                                              fraction((cascade.cosine * z - cascade.sine * x) / side + 0.5 / n),
                                              cascade.cosine / side, cascade.sine / side));
        const bool makes_foam = cascade.snapshots_rgba8[0] != nullptr;
        set("cascade_scale_" + number,
            floats(n / side, static_cast<double>(cascade.slope_range), static_cast<double>(cascade.variance_range),
                   makes_foam ? static_cast<double>(cascade.compression_scale) : 0));
        set("cascade_drift_" + number, floats(cascade.drift_columns / n, cascade.drift_rows / n,
                                              static_cast<double>(cascade.compression_front_x),
                                              static_cast<double>(cascade.compression_front_z)));
    }
}

void SeaMesh::upload_layer(Value& texture, std::vector<Value>& images, std::size_t layer, int side, bool has_mips,
                           int format, std::span<const std::uint8_t> bytes) {
    const Value image = Value::made("Image");
    image.call("set_data", side, side, has_mips, format, Value::packed(bytes));
    if (!has_mips) image.call("generate_mipmaps");
    if (texture.is_nil())
        images.push_back(image);
    else
        texture.call("update_layer", image, static_cast<std::int64_t>(layer));
}

void SeaMesh::upload(const pelagic_ocean* ocean, const pelagic_frame& frame, const Value& material) {
    if (drawn_ == frame.number && drawn_ocean_ == ocean) return;
    if (drawn_ocean_ != ocean) {
        displacement_ = slopes_ = moments_ = snapshots_ = Value();
        versions_.assign(static_cast<std::size_t>(4 * frame.cascade_count), 0);
    }
    std::vector<Value> images[4];
    const auto cascades = static_cast<std::size_t>(frame.cascade_count);
    for (std::size_t i = 0; i < cascades; ++i) {
        pelagic_cascade cascade;
        require(pelagic_ocean_cascade(ocean, static_cast<std::int32_t>(i), &cascade));
        const int n = cascade.resolution;
        const std::size_t texels = static_cast<std::size_t>(n) * static_cast<std::size_t>(n),
                          chain = (4 * texels - 1) / 3;
        upload_layer(displacement_, images[0], i, n, false, format_rgbah,
                     bytes_of(cascade.displacement_rgba16f, 4 * texels));
        upload_layer(slopes_, images[1], i, n, true, format_rgba8, bytes_of(cascade.slopes_rgba8, chain));
        upload_layer(moments_, images[2], i, n, true, format_rgba8, bytes_of(cascade.moments_rgba8, chain));
    }
    for (std::size_t image = 0; image < 4; ++image)
        for (std::size_t i = 0; i < cascades; ++i) {
            pelagic_cascade cascade;
            require(pelagic_ocean_cascade(ocean, static_cast<std::int32_t>(i), &cascade));
            const int n = cascade.resolution;
            const std::size_t chain = (4 * static_cast<std::size_t>(n) * static_cast<std::size_t>(n) - 1) / 3;
            const std::size_t layer = image * cascades + i;
            const std::uint32_t* const texels_of = cascade.snapshots_rgba8[image];
            const bool is_new = snapshots_.is_nil();
            if (!is_new && (!texels_of || versions_[layer] == cascade.snapshots_version[image])) continue;
            versions_[layer] = cascade.snapshots_version[image];
            const std::vector<std::uint32_t> no_foam(texels_of ? 0 : chain);
            upload_layer(snapshots_, images[3], layer, n, true, format_rgba8,
                         bytes_of(texels_of ? texels_of : no_foam.data(), chain));
        }
    const std::pair<const char*, Value*> textures[] = {
        {"displacement", &displacement_}, {"slopes", &slopes_}, {"moments", &moments_}, {"snapshots", &snapshots_}};
    for (std::size_t t = 0; t < 4; ++t) {
        if (images[t].empty()) continue;
        Value list = Value::empty(type_array);
        for (const Value& image : images[t]) list.call("append", image);
        *textures[t].second = Value::made("Texture2DArray");
        textures[t].second->call("create_from_images", list);
        material.call("set_shader_parameter", textures[t].first, *textures[t].second);
    }
    drawn_ = frame.number;
    drawn_ocean_ = ocean;
}

NodeClass& SeaMesh::description() {
    static NodeClass all = [] {
        NodeClass of("PelagicMesh", "MeshInstance3D", {"_enter_tree", "_process"},
                     [](Object* self) { return std::make_unique<SeaMesh>(self); });
        const auto mesh = [](Node& node) -> SeaMesh& { return static_cast<SeaMesh&>(node); };
        of.property(
            {"ocean", type_path, 0, "", ""}, [=](Node& node) { return mesh(node).ocean_; },
            [=](Node& node, const Value& value) { mesh(node).ocean_ = Value::path(value.text()); });
        of.property(
            {"quality", type_string, 2, quality_option.names, ""},
            [=](Node& node) { return Value(mesh(node).quality_); },
            [=](Node& node, const Value& value) {
                value_of(quality_option, "quality", value);
                mesh(node).quality_ = value.text();
                mesh(node).has_mesh_ = false;
            });
        of.property(
            {"size_m", type_float, 0, "", ""}, [=](Node& node) { return Value(mesh(node).size_m_); },
            [=](Node& node, const Value& value) {
                mesh(node).size_m_ = value_of(size_option, "size_m", value);
                mesh(node).has_mesh_ = false;
            });
        of.method("surface_arrays", {}, type_array,
                  [=](Node& node, std::span<const Value>) { return mesh(node).surface_arrays(); });
        return of;
    }();
    return all;
}

}  // namespace pelagic::godot4
