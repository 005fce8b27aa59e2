#include "pelagic/contrib/godot3/ocean_node.hpp"

#include <cmath>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/quadtree/quadtree_options.hpp"
#include "pelagic/sim/shore.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/sim/water_query.hpp"

namespace pelagic::godot {
namespace {

// Runs after the scripts of a scene, which move cameras.
constexpr std::int64_t after_scripts = 1000;

/// Returns true for the engine's server build, which cannot draw and would report an error for each
/// texture.
bool is_server() {
    // The class of the singleton OS is named _OS.
    static const bool is =
        Method("_OS", "has_feature").on<bool>(call(core::global_get_singleton, "OS"), Text("Server").string());
    return is;
}

bool moves(const WaterFrame& water) {
    return water.sea_level_m != 0 || water.current_x_mps != 0 || water.current_z_mps != 0;
}

Value vectors_of(const std::vector<float>(&components)[3]) {
    Pool<Vector3> pool(components[0].size());
    pool.fill([&](std::span<Vector3> room) {
        for (std::size_t i = 0; i < room.size(); ++i)
            room[i] = {components[0][i], components[1][i], components[2][i]};
    });
    return pool.value();
}

/// The nodes by their objects. The engine may create nodes on a thread that loads a scene.
std::mutex registry_mutex;
std::map<const Object*, OceanNode*> registry;

}  // namespace

OceanNode::OceanNode(Object* self) : self_(self) {
    const std::lock_guard lock(registry_mutex);
    if (self) registry.emplace(self, this);
}

OceanNode::~OceanNode() {
    end_wakes();
    const std::lock_guard lock(registry_mutex);
    registry.erase(self_);
}

OceanNode* OceanNode::of(const Object* object) {
    const std::lock_guard lock(registry_mutex);
    const auto found = registry.find(object);
    return found == registry.end() ? nullptr : found->second;
}

void OceanNode::enter_tree() {
    static const Method set_process_priority("Node", "set_process_priority");
    set_process_priority.on(self_, after_scripts);
}

void OceanNode::exit_tree() { drawing_.reset(); }

void OceanNode::reject(std::string_view line) const { report_invalid(self_, class_name, line); }

void OceanNode::change(const std::function<void(OceanSettings&)>& change) {
    change(settings_);
    is_stale_ = true;
}

void OceanNode::set_time(double time_s) {
    if (!(std::abs(time_s) <= 1e9)) return reject(invalid_value_message("time_s", time_s, "[-1e9, 1e9]"));
    time_s_ = time_s;
    is_awaited_ = true;
    if (ocean_ && !is_stale_) start(time_s);
}

void OceanNode::set_water_frame(const WaterFrame& water) {
    if (water == water_frame_) return;
    if (!settings_.shore.heights_m.empty() && moves(water))
        return reject("sea_level_m and current cannot be combined with shore_heights_m");
    water_frame_ = water;
    if (ocean_ && !is_stale_) ocean_->set_water_frame(water);
}

void OceanNode::set_origin(double x_m, double z_m) {
    WaterFrame water = water_frame_;
    water.origin_x_m = x_m;
    water.origin_z_m = z_m;
    require(check(water));
    spray_center_.x += static_cast<float>(water_frame_.origin_x_m - x_m);
    spray_center_.z += static_cast<float>(water_frame_.origin_z_m - z_m);
    water_frame_ = water;
    if (ocean_) ocean_->set_origin(x_m, z_m);
    if (frame_) place(*frame_);
}

/// Gives a frame the node's origin, of which only its droplets depend.
void OceanNode::place(Frame& frame) const {
    frame.water_frame.origin_x_m = water_frame_.origin_x_m;
    frame.water_frame.origin_z_m = water_frame_.origin_z_m;
}

void OceanNode::set_material(const Variant& material) {
    drawing_.reset();  // uses the current material
    material_ = std::make_unique<Value>(material);
}

std::string OceanNode::invalid_options(const SeaState& sea) const {
    if (std::string reason = check(sea); !reason.empty()) return reason;
    if (settings_.dynamic_waves)
        if (const std::string reason = check(settings_.dynamic_waves_options); !reason.empty())
            return "dynamic_waves_" + reason;
    if (settings_.shore.heights_m.empty()) return {};
    if (moves(water_frame_)) return "shore_heights_m cannot be combined with sea_level_m and current";
    if (const std::string reason = check(settings_.shore); !reason.empty()) return "shore_" + reason;
    return check(settings_.shore, sea);
}

bool OceanNode::make_ocean() {
    is_stale_ = false;
    const SeaState sea = sea_of(settings_);
    if (const std::string reason = invalid_options(sea); !reason.empty()) {
        reject(reason);  // invalid combination of fields; the current sea stays
        return ocean_ != nullptr;
    }
    OceanOptions options{.executor = make_thread_executor(settings_.threads),
                         .queries = true,
                         .velocities = settings_.velocities ? Velocities::drawn : Velocities::none,
                         .depth = settings_.depth,
                         .slopes = true,
                         .foam = settings_.foam};
    if (settings_.dynamic_waves) options.dynamic_waves = settings_.dynamic_waves_options;
    if (settings_.spray) options.spray = settings_.spray_options;
    if (!settings_.shore.heights_m.empty()) {
        options.shore = settings_.shore;
        if (const std::string warning = warning_about(*options.shore, sea); !warning.empty())
            print_line("PelagicOcean: " + warning);
    }
    drawing_.reset();
    frame_.reset();
    in_flight_.reset();
    is_awaited_ = true;
    end_wakes();
    ocean_.reset();
    ocean_ = std::make_unique<Ocean>(sea, std::move(options));
    ocean_->set_water_frame(water_frame_);
    ocean_->set_origin(water_frame_.origin_x_m, water_frame_.origin_z_m);
    has_dynamic_waves_ = settings_.dynamic_waves;
    has_spray_ = settings_.spray;
    if (has_spray_) set_spray_center(spray_center_);
    return true;
}

void OceanNode::start(double time_s) {
    if (in_flight_ == time_s) return;
    move_wakes();
    ocean_->schedule(time_s);
    in_flight_ = time_s;
}

/// Completes a frame in flight, which no call has used. Hulls have stepped in the frame before it.
void OceanNode::move_wakes() {
    std::optional<Frame> last = frame_;
    if (in_flight_) {
        last = ocean_->complete();
        place(*last);
    }
    if (!std::exchange(is_restored_, false) && last)
        for (WakeMaker* const wake : std::vector(wakes_)) wake->press(*last);  // which may leave
}

void OceanNode::end_wakes() {
    for (WakeMaker* const wake : std::exchange(wakes_, {})) wake->leave_waves();
}

const Frame* OceanNode::frame() {
    if (is_stale_ && !make_ocean()) return nullptr;
    if (!ocean_) return nullptr;
    if (is_awaited_) {
        start(time_s_);
        in_flight_.reset();
        frame_ = ocean_->complete();
        scheduled_ = frame_->water_frame;
        place(*frame_);
        is_awaited_ = false;
    }
    return &*frame_;
}

void OceanNode::process(double seconds) {
    if (is_playing_ && !is_awaited_) {
        time_s_ = in_flight_.value_or(time_s_ + seconds);
        is_awaited_ = true;
    }
    const Frame* shown = frame();
    if (!shown) return;
    draw(*shown);
    if (is_playing_) start(time_s_ + seconds);
}

void OceanNode::draw(const Frame& frame) {
    static const Method get_rid("Resource", "get_rid");
    Object* material = call(core::variant_as_object, &material_->variant());
    if (!material || is_server()) return;
    if (!drawing_) {
        const QuadtreePreset* preset = quadtree_preset_named(settings_.quality);
        drawing_ =
            std::make_unique<SeaDrawing>(self_, get_rid.on<Rid>(material), preset->options(settings_.size_m), frame);
    }
    drawing_->draw(frame);
}

std::optional<std::uint64_t> OceanNode::hash() {
    const Frame* asked = frame();
    if (!asked) return {};
    return hash_of(*asked);
}

DynamicWaves* OceanNode::dynamic_waves() {
    if (is_stale_ && !make_ocean()) return nullptr;
    if (!ocean_) return nullptr;
    if (!has_dynamic_waves_) throw std::invalid_argument("the ocean has no dynamic waves: set dynamic_waves to true");
    return &ocean_->dynamic_waves();
}

DynamicWaves* OceanNode::dynamic_waves_between_frames() {
    DynamicWaves* const waves = dynamic_waves();
    // frame() completes the frame a second time, which returns it again.
    if (waves && in_flight_) ocean_->complete();
    return waves;
}

DynamicWaves* OceanNode::dynamic_waves_or_null() {
    if (is_stale_ && !make_ocean()) return nullptr;
    return ocean_ && has_dynamic_waves_ ? &ocean_->dynamic_waves() : nullptr;
}

void OceanNode::restore_dynamic_waves(std::span<const std::uint8_t> saved) {
    DynamicWaves* const waves = dynamic_waves_between_frames();
    if (!waves) return;
    waves->restore_state(saved);
    is_restored_ = true;
}

std::optional<std::uint64_t> OceanNode::dynamic_waves_hash() {
    if (!dynamic_waves()) return {};
    return hash_of(frame()->dynamic_waves);
}

Ocean* OceanNode::ocean_with_spray() {
    if (is_stale_ && !make_ocean()) return nullptr;
    if (!ocean_) return nullptr;
    if (!has_spray_) throw std::invalid_argument("the ocean has no spray: set spray to true");
    return ocean_.get();
}

Ocean* OceanNode::ocean_with_spray_between_frames() {
    Ocean* const ocean = ocean_with_spray();
    if (ocean && in_flight_) ocean->complete();  // as in dynamic_waves_between_frames()
    return ocean;
}

void OceanNode::set_spray_center(const Vector3& place) {
    Ocean* const ocean = ocean_with_spray();
    if (ocean) ocean->set_spray_center(static_cast<double>(place.x), static_cast<double>(place.z));
    spray_center_ = place;
}

std::unique_ptr<Table> OceanNode::droplets() {
    if (!ocean_with_spray()) return {};
    const std::span<const SprayDroplet> all = frame()->droplets;
    const double moved_x = scheduled_.origin_x_m - water_frame_.origin_x_m;
    const double moved_z = scheduled_.origin_z_m - water_frame_.origin_z_m;
    const auto vectors = [&](auto x, auto y, auto z, double to_x, double to_z) {
        Pool<Vector3> pool(all.size());
        pool.fill([&](std::span<Vector3> room) {
            for (std::size_t i = 0; i < all.size(); ++i)
                room[i] = {static_cast<float>(static_cast<double>(all[i].*x) + to_x), static_cast<float>(all[i].*y),
                           static_cast<float>(static_cast<double>(all[i].*z) + to_z)};
        });
        return pool.value();
    };
    const auto numbers = [&](float SprayDroplet::*member) {
        Pool<float> pool(all.size());
        pool.fill([&](std::span<float> room) {
            for (std::size_t i = 0; i < all.size(); ++i) room[i] = all[i].*member;
        });
        return pool.value();
    };
    auto answers = std::make_unique<Table>();
    answers->set("position", vectors(&SprayDroplet::x_m, &SprayDroplet::y_m, &SprayDroplet::z_m, moved_x, moved_z));
    answers->set("velocity", vectors(&SprayDroplet::velocity_x_mps, &SprayDroplet::velocity_y_mps,
                                     &SprayDroplet::velocity_z_mps, 0, 0));
    answers->set("radius", numbers(&SprayDroplet::radius_m));
    answers->set("opacity", numbers(&SprayDroplet::opacity));
    answers->set("age", numbers(&SprayDroplet::age_s));
    return answers;
}

std::optional<std::uint64_t> OceanNode::spray_hash() {
    if (!ocean_with_spray()) return {};
    return spray_hash_of(*frame());
}

std::optional<double> OceanNode::significant_wave_height_m() {
    const Frame* asked = frame();
    if (!asked) return {};
    return asked->statistics.significant_wave_height_m;
}

SurfaceQueryOptions OceanNode::query_options() const {
    return {.interpolation = *value_named<Interpolation>(settings_.interpolation)};
}

std::optional<float> OceanNode::height_at(const Vector3& place) {
    const Frame* asked = frame();
    if (!asked) return {};
    const double x = place.x, z = place.z;
    float height = 0;
    SurfaceQuery(*asked, query_options()).sample({{&x, 1}, {&z, 1}, settings_.footprint_m}, {.height_m = {&height, 1}});
    return height;
}

std::unique_ptr<Table> OceanNode::query(std::span<const Vector3> places) {
    const Frame* asked = frame();
    if (!asked) return {};
    const std::size_t count = places.size();
    x_.resize(count);
    z_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        x_[i] = places[i].x;
        z_[i] = places[i].z;
    }
    Pool<float> heights(count);
    std::vector<float> n[3], v[3];
    for (auto& component : n) component.resize(count);
    for (auto& component : v) component.resize(settings_.velocities ? count : 0);
    heights.fill([&](std::span<float> room) {
        SurfaceQuery(*asked, query_options()).sample({x_, z_, settings_.footprint_m}, {.height_m = room,
                                           .normal_x = n[0],
                                           .normal_y = n[1],
                                           .normal_z = n[2],
                                           .velocity_x_mps = v[0],
                                           .velocity_y_mps = v[1],
                                           .velocity_z_mps = v[2]});
    });
    auto answers = std::make_unique<Table>();
    answers->set("height", heights.value());
    answers->set("normal", vectors_of(n));
    if (settings_.velocities) answers->set("velocity", vectors_of(v));
    if (asked->shore) {
        Pool<float> depths(count);
        const WaterFrame& water = asked->water_frame;
        depths.fill([&](std::span<float> room) {
            for (std::size_t i = 0; i < count; ++i)
                room[i] = static_cast<float>(
                    sample(asked->shore, x_[i] + water.origin_x_m, z_[i] + water.origin_z_m).depth_m);
        });
        answers->set("depth", depths.value());
    }
    return answers;
}

std::unique_ptr<Table> OceanNode::sample_water(std::span<const Vector3> places) {
    if (!settings_.depth) throw std::invalid_argument("the ocean has no depth: set depth to true");
    const Frame* asked = frame();
    if (!asked) return {};
    const std::size_t count = places.size();
    std::vector<double> at[3];
    std::vector<float> velocity[3], acceleration[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        velocity[axis].resize(count);
        acceleration[axis].resize(count);
    }
    for (const Vector3& place : places) {
        at[0].push_back(place.x);
        at[1].push_back(place.y);
        at[2].push_back(place.z);
    }
    std::vector<float> depths(count), pressures(count);
    WaterQuery(*asked, {.surface = query_options()})
        .sample({at[0], at[1], at[2], settings_.footprint_m}, {depths, pressures, velocity[0], velocity[1], velocity[2],
                                                               acceleration[0], acceleration[1], acceleration[2]});
    auto answers = std::make_unique<Table>();
    answers->set("depth", Pool<float>(std::span<const float>(depths)).value());
    answers->set("pressure", Pool<float>(std::span<const float>(pressures)).value());
    answers->set("velocity", vectors_of(velocity));
    answers->set("acceleration", vectors_of(acceleration));
    return answers;
}

std::unique_ptr<Table> OceanNode::first_hit(const Vector3& origin, const Vector3& direction, double reach_m) {
    const Frame* asked = frame();
    if (!asked) return {};
    const SurfaceRay ray{{origin.x, origin.y, origin.z}, {direction.x, direction.y, direction.z}, reach_m};
    auto answers = std::make_unique<Table>();
    if (const std::string reason = check(ray, *asked); !reason.empty()) {
        reject(reason);
        return {};
    }
    const auto hit = pelagic::first_hit(SurfaceQuery(*asked), ray);
    answers->set("hit", Value(hit.has_value()));
    if (!hit) return answers;
    const auto vector = [](const auto& of) {
        return Value(Vector3{static_cast<float>(of[0]), static_cast<float>(of[1]), static_cast<float>(of[2])});
    };
    answers->set("distance", Value(hit->distance_m));
    answers->set("position", vector(hit->position_m));
    answers->set("normal", vector(hit->normal));
    answers->set("from_below", Value(hit->from_below));
    return answers;
}

}  // namespace pelagic::godot
