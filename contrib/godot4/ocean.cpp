#include "pelagic/contrib/godot4/ocean.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <mutex>
#include <utility>

#include "pelagic/contrib/godot3/scene_sea.hpp"
#include "pelagic/contrib/godot4/options.g.hpp"

namespace pelagic::godot4 {
namespace {

// The engine may create nodes on a thread that loads a scene.
std::mutex registry_mutex;
std::map<const Object*, Ocean*> registry;

constexpr int before_scripts = -1000;

constexpr Option threads_option{"threads", Kind::whole, 0, 0, 1024, false, none, 1, "a whole number from 0 to 1024",
                                ""};
constexpr Option footprint_option{"footprint_m", Kind::real, 0, 0, 1000, false, none, 1, "[0, 1000]", ""};
constexpr Option time_option{"time_s", Kind::real, 0, -1e9, 1e9, false, none, 1, "[-1e9, 1e9]", ""};
constexpr Option interpolation_option{"interpolation",       Kind::choice,  0, 0, 1, false, none, 1,
                                      "one of linear,cubic", "linear,cubic"};

bool moves(const pelagic_water_frame& water) {
    return water.sea_level_m != 0 || water.current_x_mps != 0 || water.current_z_mps != 0;
}

pelagic_sea sea_of(const std::string& preset, const pelagic_sea& own) {
    if (preset == "custom") return own;
    pelagic_sea sea = pelagic_sea_make();
    require(pelagic_sea_preset(preset.c_str(), &sea));
    return godot::scene_sea(sea, own, pelagic_sea_make());
}

Value vectors(const std::vector<float> (&of)[3]) {
    std::vector<Vector3> all(of[0].size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = {of[0][i], of[1][i], of[2][i]};
    return Value::packed(all);
}

std::string preset_names() {
    std::string names = "custom";
    const char *name, *summary;
    for (std::int32_t i = 0; pelagic_preset_at(i, &name, &summary) == PELAGIC_OK && name; ++i)
        names.append(",").append(name);
    return names;
}

std::uint32_t source_number(const Value& value) {
    const double number = value.number();
    if (!(number >= 0 && number <= UINT32_MAX && number == std::floor(number)))
        refuse("number", value.text(), "a number that add_source() returned");
    return static_cast<std::uint32_t>(number);
}

/// Depth of still water, bilinear; beyond the rectangle that of its edge.
float depth_at(const pelagic_shore_surface& shore, double x_m, double z_m) {
    const auto texel = [&](double metres, double corner_m, int count) {
        return std::clamp((metres - corner_m) / shore.texel_m, 0.0, count - 1.0);
    };
    const double x = texel(x_m, shore.x_m, shore.columns), z = texel(z_m, shore.z_m, shore.rows);
    const int i = std::min(static_cast<int>(x), shore.columns - 2), j = std::min(static_cast<int>(z), shore.rows - 2);
    const auto at = [&](int column, int row) {
        return static_cast<double>(shore.depth_m[row * shore.columns + column]);
    };
    const double north = at(i, j) + (x - i) * (at(i + 1, j) - at(i, j));
    const double south = at(i, j + 1) + (x - i) * (at(i + 1, j + 1) - at(i, j + 1));
    return static_cast<float>(north + (z - j) * (south - north));
}

pelagic_disturbance disturbance_of(const Value& dictionary) {
    pelagic_disturbance read = pelagic_disturbance_make();
    read_dictionary(disturbance_table, &read, dictionary, "disturbance");
    return read;
}

}  // namespace

Ocean::Ocean(Object* self) : Node(self, "PelagicOcean") {
    const std::lock_guard lock(registry_mutex);
    registry.emplace(self, this);
}

Ocean::~Ocean() {
    destroy();
    const std::lock_guard lock(registry_mutex);
    registry.erase(self_);
}

Ocean* Ocean::of(const Object* object) {
    const std::lock_guard lock(registry_mutex);
    const auto found = registry.find(object);
    return found == registry.end() ? nullptr : found->second;
}

Ocean& Ocean::at(const Value& node, const Value& path) {
    if (!node.call("is_inside_tree").boolean())
        throw std::invalid_argument("the node is outside of the scene tree, expected a node of a scene");
    const std::string text = path.text();
    Ocean* const found = text.empty() ? nullptr : of(node.call("get_node_or_null", path).object());
    if (!found) refuse("ocean", text.empty() ? "empty" : text, "the path of a PelagicOcean");
    return *found;
}

void Ocean::enter_tree() { self().call("set_process_priority", before_scripts); }

void Ocean::destroy() {
    for (Swimmer* const swimmer : std::exchange(swimmers_, {})) swimmer->leave();
    pelagic_ocean_destroy(std::exchange(ocean_, nullptr));
    in_flight_.reset();
    is_awaited_ = true;
}

void Ocean::make() {
    const pelagic_sea sea = sea_of(settings_.preset, settings_.sea);
    require(pelagic_sea_check(&sea));
    const bool has_shore = !settings_.shore_heights_m.empty();
    if (has_shore && moves(settings_.water))
        throw std::invalid_argument("shore_heights_m cannot be combined with sea_level_m and current");
    pelagic_shore_options shore = settings_.shore;
    shore.heights_m = settings_.shore_heights_m.data();
    if (has_shore && settings_.shore_heights_m.size() !=
                         static_cast<std::size_t>(shore.columns) * static_cast<std::size_t>(shore.rows))
        throw std::invalid_argument("shore_heights_m has " + std::to_string(settings_.shore_heights_m.size()) +
                                    " values, expected shore_columns * shore_rows");
    pelagic_executor_options executor_options = pelagic_executor_options_make();
    executor_options.kind = PELAGIC_EXECUTOR_THREADS;
    executor_options.threads = settings_.threads;
    pelagic_executor* executor = nullptr;
    require(pelagic_executor_create(&executor_options, &executor));
    pelagic_ocean_options options = pelagic_ocean_options_make();
    options.queries = 1;
    options.velocities = settings_.velocities ? PELAGIC_VELOCITIES_DRAWN : PELAGIC_VELOCITIES_NONE;
    options.depth = settings_.depth;
    options.slopes = PELAGIC_TEXTURES_ON;
    options.foam = settings_.foam;
    options.executor = executor;
    if (settings_.has_dynamic_waves) options.dynamic_waves = &settings_.dynamic_waves;
    if (settings_.has_spray) options.spray = &settings_.spray;
    if (has_shore) options.shore = &shore;
    pelagic_ocean* ocean = nullptr;
    const pelagic_status status = pelagic_ocean_create(&sea, &options, &ocean);
    pelagic_executor_destroy(executor);  // the ocean keeps it
    require(status);
    destroy();
    ocean_ = ocean;
    has_dynamic_waves_ = settings_.has_dynamic_waves;
    has_spray_ = settings_.has_spray;
    has_shore_ = has_shore;
    if (!has_shore) require(pelagic_ocean_set_water_frame(ocean_, &settings_.water));
    require(pelagic_ocean_set_origin(ocean_, origin_x_m_, origin_z_m_));
    if (has_spray_) require(pelagic_ocean_set_spray_center(ocean_, spray_x_m_, spray_z_m_));
}

void Ocean::start(double time_s) {
    if (in_flight_ == time_s) return;
    const bool has_frame = in_flight_ || !is_awaited_ || frame_.number > 0;
    finish();
    if (!std::exchange(is_restored_, false) && has_frame)
        for (Swimmer* const swimmer : std::vector(swimmers_)) swimmer->press(frame_.time_s);  // which may leave
    require(pelagic_ocean_schedule(ocean_, time_s));
    in_flight_ = time_s;
}

/// Completes a frame in flight.
void Ocean::finish() {
    if (!std::exchange(in_flight_, {})) return;
    require(pelagic_ocean_complete(ocean_, &frame_));
}

const pelagic_frame& Ocean::frame() {
    if (std::exchange(is_stale_, false)) {
        try {
            make();
            frame_ = {};
        } catch (const std::exception& error) {
            if (!ocean_) {
                is_stale_ = true;
                throw;
            }
            reject(error.what());  // the current sea stays
        }
    }
    if (is_awaited_) {
        start(time_s_);
        finish();
        is_awaited_ = false;
    }
    return frame_;
}

void Ocean::process(double seconds) {
    if (is_playing_ && !is_awaited_) {
        time_s_ = in_flight_.value_or(time_s_ + seconds);
        is_awaited_ = true;
    }
    run_in_frame([&] {
        frame();
        if (is_playing_) start(time_s_ + seconds);
    });
}

void Ocean::set_time(double time_s) {
    time_s_ = time_s;
    is_awaited_ = true;
    if (ocean_ && !is_stale_) start(time_s);
}

void Ocean::set_water(const pelagic_water_frame& water) {
    if (!settings_.shore_heights_m.empty() && moves(water))
        throw std::invalid_argument("sea_level_m and current cannot be combined with shore_heights_m");
    settings_.water = water;
    if (ocean_ && !is_stale_) require(pelagic_ocean_set_water_frame(ocean_, &water));
}

void Ocean::set_origin(double x_m, double z_m) {
    for (const auto& [name, value] : {std::pair("x_m", x_m), {"z_m", z_m}})
        if (!(std::fabs(value) <= 1e8)) refuse(name, Value(value).text(), "[-1e8, 1e8]");
    spray_x_m_ += origin_x_m_ - x_m;
    spray_z_m_ += origin_z_m_ - z_m;
    origin_x_m_ = x_m;
    origin_z_m_ = z_m;
    if (!ocean_) return;
    finish();
    require(pelagic_ocean_set_origin(ocean_, x_m, z_m));
    is_awaited_ = true;
}

pelagic_dynamic_waves* Ocean::waves() {
    if (is_stale_) frame();
    if (!has_dynamic_waves_) throw std::invalid_argument("the ocean has no dynamic waves: set dynamic_waves to true");
    pelagic_dynamic_waves* waves = nullptr;
    require(pelagic_ocean_dynamic_waves(ocean_, &waves));
    return waves;
}

void Ocean::need_spray() {
    if (is_stale_) frame();
    if (!has_spray_) throw std::invalid_argument("the ocean has no spray: set spray to true");
}

/// Returns 16 hexadecimal digits, as the command line prints hashes.
Value Ocean::hash(int kind) {
    frame();
    std::uint64_t hash = 0;
    require(pelagic_ocean_frame_hash(ocean_, frame_.number, kind, &hash));
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash));
    return text;
}

float Ocean::sample(const Vector3& place, Vector3* normal) {
    const double x = static_cast<double>(place.x), z = static_cast<double>(place.z);
    float height = 0;
    pelagic_points points = pelagic_points_make();
    points.frame = frame().number;
    points.interpolation = settings_.interpolation;
    points.footprint_m = settings_.footprint_m;
    points.count = 1;
    points.x = &x;
    points.z = &z;
    pelagic_samples samples = pelagic_samples_make();
    samples.height_m = &height;
    if (normal) {
        samples.normal_x = &normal->x;
        samples.normal_y = &normal->y;
        samples.normal_z = &normal->z;
    }
    require(pelagic_ocean_query(ocean_, &points, &samples));
    return height;
}

Value Ocean::query(std::span<const Vector3> places) {
    const std::size_t count = places.size();
    std::vector<double> x(count), z(count);
    for (std::size_t i = 0; i < count; ++i) {
        x[i] = static_cast<double>(places[i].x);
        z[i] = static_cast<double>(places[i].z);
    }
    std::vector<float> heights(count), foam(count), n[3], v[3];
    for (auto& component : n) component.resize(count);
    for (auto& component : v) component.resize(settings_.velocities ? count : 0);
    pelagic_points points = pelagic_points_make();
    points.frame = frame().number;
    points.interpolation = settings_.interpolation;
    points.footprint_m = settings_.footprint_m;
    points.count = count;
    points.x = x.data();
    points.z = z.data();
    pelagic_samples samples = pelagic_samples_make();
    samples.height_m = heights.data();
    samples.normal_x = n[0].data();
    samples.normal_y = n[1].data();
    samples.normal_z = n[2].data();
    if (settings_.velocities) {
        samples.velocity_x_mps = v[0].data();
        samples.velocity_y_mps = v[1].data();
        samples.velocity_z_mps = v[2].data();
    }
    require(pelagic_ocean_query(ocean_, &points, &samples));
    Value answers = Value::empty(type_dictionary);
    answers.set("height", Value::packed(heights)).set("normal", vectors(n));
    if (settings_.velocities) answers.set("velocity", vectors(v));
    if (has_shore_) {
        pelagic_shore_surface shore;
        require(pelagic_ocean_shore(ocean_, &shore));
        std::vector<float> depths(count);
        for (std::size_t i = 0; i < count; ++i) depths[i] = depth_at(shore, x[i] + origin_x_m_, z[i] + origin_z_m_);
        answers.set("depth", Value::packed(depths));
    }
    return answers;
}

Value Ocean::sample_water(std::span<const Vector3> places) {
    if (!settings_.depth) throw std::invalid_argument("the ocean has no depth: set depth to true");
    const std::size_t count = places.size();
    std::vector<double> at[3];
    for (const Vector3& place : places) {
        at[0].push_back(static_cast<double>(place.x));
        at[1].push_back(static_cast<double>(place.y));
        at[2].push_back(static_cast<double>(place.z));
    }
    std::vector<float> depths(count), pressures(count), v[3], a[3];
    for (auto& component : v) component.resize(count);
    for (auto& component : a) component.resize(count);
    pelagic_water_points points = pelagic_water_points_make();
    points.frame = frame().number;
    points.interpolation = settings_.interpolation;
    points.footprint_m = settings_.footprint_m;
    points.count = count;
    points.x = at[0].data();
    points.y = at[1].data();
    points.z = at[2].data();
    pelagic_water_samples samples = pelagic_water_samples_make();
    samples.depth_m = depths.data();
    samples.pressure_pa = pressures.data();
    samples.velocity_x_mps = v[0].data();
    samples.velocity_y_mps = v[1].data();
    samples.velocity_z_mps = v[2].data();
    samples.acceleration_x_mps2 = a[0].data();
    samples.acceleration_y_mps2 = a[1].data();
    samples.acceleration_z_mps2 = a[2].data();
    require(pelagic_ocean_sample_water(ocean_, &points, &samples));
    Value answers = Value::empty(type_dictionary);
    answers.set("depth", Value::packed(depths)).set("pressure", Value::packed(pressures));
    answers.set("velocity", vectors(v)).set("acceleration", vectors(a));
    return answers;
}

Value Ocean::first_hit(const Vector3& origin, const Vector3& direction, double reach_m) {
    pelagic_ray ray = pelagic_ray_make();
    const float from[3] = {origin.x, origin.y, origin.z}, along[3] = {direction.x, direction.y, direction.z};
    std::copy(from, from + 3, ray.origin_m);
    std::copy(along, along + 3, ray.direction);
    ray.frame = frame().number;
    ray.reach_m = reach_m;
    pelagic_hit hit;
    require(pelagic_ocean_first_hit(ocean_, &ray, &hit));
    Value answers = Value::empty(type_dictionary);
    answers.set("hit", hit.is_hit != 0);
    if (!hit.is_hit) return answers;
    answers.set("distance", hit.distance_m).set("position", floats(hit.position_m));
    answers.set("normal", Vector3{hit.normal[0], hit.normal[1], hit.normal[2]})
        .set("from_below", hit.from_below != 0);
    return answers;
}

Value Ocean::droplets() {
    need_spray();
    const pelagic_frame& shown = frame();
    std::vector<Vector3> positions, velocities;
    std::vector<float> radii, opacities, ages;
    for (const pelagic_droplet& droplet : std::span(shown.droplets, shown.droplet_count)) {
        positions.push_back(floats(droplet.position_m));
        velocities.push_back({droplet.velocity_mps[0], droplet.velocity_mps[1], droplet.velocity_mps[2]});
        radii.push_back(droplet.radius_m);
        opacities.push_back(droplet.opacity);
        ages.push_back(droplet.age_s);
    }
    Value answers = Value::empty(type_dictionary);
    answers.set("position", Value::packed(positions)).set("velocity", Value::packed(velocities));
    answers.set("radius", Value::packed(radii))
        .set("opacity", Value::packed(opacities))
        .set("age", Value::packed(ages));
    return answers;
}

NodeClass& Ocean::description() {
    static NodeClass all = [] {
        NodeClass of("PelagicOcean", "Node3D", {"_enter_tree", "_process"},
                     [](Object* self) { return std::make_unique<Ocean>(self); });
        const auto ocean = [](Node& node) -> Ocean& { return static_cast<Ocean&>(node); };
        const auto fields = [&](const std::string& prefix, std::span<const Option> table, auto member) {
            for (const Option& option : table)
                of.option(
                    prefix, option,
                    [member](const Node& node) -> const void* {
                        return &(static_cast<const Ocean&>(node).settings_.*member);
                    },
                    [member](Node& node, const Option& row, double value) {
                        static_cast<Ocean&>(node).change(
                            [&](OceanSettings& set) { row.write(&(set.*member), value); });
                    });
        };
        const auto own = [&](const Option& option, auto get, auto set) {
            const bool is_choice = option.kind == Kind::choice;
            of.property(
                {option.name,
                 is_choice          ? type_string
                 : option.is_real() ? type_float
                                    : type_int,
                 is_choice ? 2u : 0u, option.names, ""},
                [=](Node& node) { return Value(get(ocean(node))); },
                [=, &option](Node& node, const Value& value) {
                    set(ocean(node), value_of(option, option.name, value));
                });
        };
        const auto flag = [&](const char* name, bool OceanSettings::*member) {
            of.property(
                {name, type_bool, 0, "", ""}, [=](Node& node) { return Value(ocean(node).settings_.*member); },
                [=](Node& node, const Value& value) {
                    if (value.boolean() == ocean(node).settings_.*member) return;
                    ocean(node).change([&](OceanSettings& set) { set.*member = value.boolean(); });
                });
        };
        of.property(
            {"preset", type_string, 2, preset_names(), ""},
            [=](Node& node) { return Value(ocean(node).settings_.preset); },
            [=](Node& node, const Value& value) {
                const std::string name = value.text();
                sea_of(name, pelagic_sea_make());
                ocean(node).change([&](OceanSettings& set) { set.preset = name; });
            });
        fields("", sea_table, &OceanSettings::sea);
        for (const Option& option : water_frame_table)
            of.option(
                "", option,
                [](const Node& node) -> const void* { return &static_cast<const Ocean&>(node).settings_.water; },
                [=](Node& node, const Option& row, double value) {
                    pelagic_water_frame water = ocean(node).settings_.water;
                    row.write(&water, value);
                    ocean(node).set_water(water);
                });
        flag("foam", &OceanSettings::foam);
        flag("velocities", &OceanSettings::velocities);
        flag("depth", &OceanSettings::depth);
        own(
            interpolation_option, [](Ocean& it) { return it.settings_.interpolation ? "cubic" : "linear"; },
            [](Ocean& it, double value) { it.settings_.interpolation = static_cast<int>(value); });
        own(
            footprint_option, [](Ocean& it) { return it.settings_.footprint_m; },
            [](Ocean& it, double value) { it.settings_.footprint_m = value; });
        own(
            threads_option, [](Ocean& it) { return it.settings_.threads; },
            [](Ocean& it, double value) {
                it.change([&](OceanSettings& set) { set.threads = static_cast<int>(value); });
            });
        own(
            time_option, [](Ocean& it) { return it.time_s_; }, [](Ocean& it, double value) { it.set_time(value); });
        of.property(
            {"playing", type_bool, 0, "", ""}, [=](Node& node) { return Value(ocean(node).is_playing_); },
            [=](Node& node, const Value& value) { ocean(node).is_playing_ = value.boolean(); });
        flag("dynamic_waves", &OceanSettings::has_dynamic_waves);
        fields("dynamic_waves_", dynamic_waves_table, &OceanSettings::dynamic_waves);
        flag("spray", &OceanSettings::has_spray);
        fields("spray_", spray_table, &OceanSettings::spray);
        of.property(
            {"shore_heights_m", type_floats, 0, "", ""},
            [=](Node& node) { return Value::packed(ocean(node).settings_.shore_heights_m); },
            [=](Node& node, const Value& value) {
                ocean(node).change([&](OceanSettings& set) { set.shore_heights_m = value.elements<float>(); });
            });
        fields("shore_", shore_table, &OceanSettings::shore);

        using Arguments = std::span<const Value>;
        of.method("hash", {}, type_string,
                  [=](Node& node, Arguments) { return ocean(node).hash(PELAGIC_HASH_FRAME); });
        of.method("significant_wave_height", {}, type_float,
                  [=](Node& node, Arguments) { return Value(ocean(node).frame().wave_height_m); });
        of.method("height_at", {{"place", type_vector3}}, type_float, [=](Node& node, Arguments of_call) {
            return Value(static_cast<double>(ocean(node).sample(of_call[0].vector())));
        });
        of.method("query", {{"places", type_vectors}}, type_dictionary,
                  [=](Node& node, Arguments of_call) { return ocean(node).query(of_call[0].elements<Vector3>()); });
        of.method("sample_water", {{"places", type_vectors}}, type_dictionary, [=](Node& node, Arguments of_call) {
            return ocean(node).sample_water(of_call[0].elements<Vector3>());
        });
        of.method("first_hit", {{"origin", type_vector3}, {"direction", type_vector3}, {"reach_m", type_float}},
                  type_dictionary, [=](Node& node, Arguments of_call) {
                      return ocean(node).first_hit(of_call[0].vector(), of_call[1].vector(), of_call[2].number());
                  });
        of.method("set_origin", {{"x_m", type_float}, {"z_m", type_float}}, type_nil,
                  [=](Node& node, Arguments of_call) {
                      return ocean(node).set_origin(of_call[0].number(), of_call[1].number()), Value();
                  });
        of.method("add_impulse", {{"disturbance", type_dictionary}}, type_nil, [=](Node& node, Arguments of_call) {
            const pelagic_disturbance disturbance = disturbance_of(of_call[0]);
            return require(pelagic_dynamic_waves_add_impulse(ocean(node).waves(), &disturbance)), Value();
        });
        of.method("add_source", {{"source", type_dictionary}}, type_int, [=](Node& node, Arguments of_call) {
            const pelagic_disturbance source = disturbance_of(of_call[0]);
            std::uint32_t number = 0;
            require(pelagic_dynamic_waves_add_source(ocean(node).waves(), &source, &number));
            return Value(static_cast<std::int64_t>(number));
        });
        of.method("set_source", {{"number", type_int}, {"source", type_dictionary}}, type_nil,
                  [=](Node& node, Arguments of_call) {
                      const pelagic_disturbance source = disturbance_of(of_call[1]);
                      return require(pelagic_dynamic_waves_set_source(ocean(node).waves(), source_number(of_call[0]),
                                                                      &source)),
                             Value();
                  });
        of.method("remove_source", {{"number", type_int}}, type_nil, [=](Node& node, Arguments of_call) {
            return require(pelagic_dynamic_waves_remove_source(ocean(node).waves(), source_number(of_call[0]))),
                   Value();
        });
        of.method("set_center", {{"place", type_vector3}}, type_nil, [=](Node& node, Arguments of_call) {
            const Vector3 place = of_call[0].vector();
            return require(pelagic_dynamic_waves_set_center(ocean(node).waves(), static_cast<double>(place.x),
                                                            static_cast<double>(place.z))),
                   Value();
        });
        of.method("set_rain", {{"rain", type_dictionary}}, type_nil, [=](Node& node, Arguments of_call) {
            pelagic_rain rain = pelagic_rain_make();
            read_dictionary(rain_table, &rain, of_call[0], "rain");
            return require(pelagic_dynamic_waves_set_rain(ocean(node).waves(), &rain)), Value();
        });
        of.method("save_state", {}, type_bytes, [=](Node& node, Arguments) {
            ocean(node).finish();
            return Value::packed(saved(pelagic_dynamic_waves_save_state, ocean(node).waves()));
        });
        of.method("restore_state", {{"saved", type_bytes}}, type_nil, [=](Node& node, Arguments of_call) {
            const std::vector<std::uint8_t> bytes = of_call[0].elements<std::uint8_t>();
            ocean(node).finish();
            require(pelagic_dynamic_waves_restore_state(ocean(node).waves(), bytes.data(), bytes.size()));
            ocean(node).is_restored_ = true;
            return Value();
        });
        of.method("dynamic_waves_hash", {}, type_string, [=](Node& node, Arguments) {
            return ocean(node).waves(), ocean(node).hash(PELAGIC_HASH_DYNAMIC_WAVES);
        });
        of.method("set_spray_center", {{"place", type_vector3}}, type_nil, [=](Node& node, Arguments of_call) {
            Ocean& it = ocean(node);
            it.need_spray();
            const Vector3 place = of_call[0].vector();
            const double x_m = static_cast<double>(place.x), z_m = static_cast<double>(place.z);
            require(pelagic_ocean_set_spray_center(it.ocean_, x_m, z_m));
            it.spray_x_m_ = x_m;
            it.spray_z_m_ = z_m;
            return Value();
        });
        of.method("emit_spray", {{"emitter", type_dictionary}}, type_nil, [=](Node& node, Arguments of_call) {
            pelagic_spray_emitter emitter = pelagic_spray_emitter_make();
            read_dictionary(spray_emitter_table, &emitter, of_call[0], "spray emitter");
            ocean(node).need_spray();
            return require(pelagic_ocean_emit(ocean(node).ocean_, &emitter, 1)), Value();
        });
        of.method("droplets", {}, type_dictionary, [=](Node& node, Arguments) { return ocean(node).droplets(); });
        of.method("spray_hash", {}, type_string, [=](Node& node, Arguments) {
            return ocean(node).need_spray(), ocean(node).hash(PELAGIC_HASH_SPRAY);
        });
        of.method("save_spray", {}, type_bytes, [=](Node& node, Arguments) {
            ocean(node).need_spray();
            ocean(node).finish();
            return Value::packed(saved(pelagic_ocean_save_spray, ocean(node).ocean_));
        });
        of.method("restore_spray", {{"saved", type_bytes}}, type_nil, [=](Node& node, Arguments of_call) {
            const std::vector<std::uint8_t> bytes = of_call[0].elements<std::uint8_t>();
            ocean(node).need_spray();
            ocean(node).finish();
            return require(pelagic_ocean_restore_spray(ocean(node).ocean_, bytes.data(), bytes.size())), Value();
        });
        return of;
    }();
    return all;
}

}  // namespace pelagic::godot4
