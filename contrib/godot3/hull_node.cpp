#include "pelagic/contrib/godot3/hull_node.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "pelagic/contrib/godot3/mesh_reader.hpp"
#include "pelagic/jobs/executor.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/message/one_line.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::godot {
namespace {

const Method is_inside_tree("Node", "is_inside_tree"), get_node("Node", "get_node_or_null");
const Method get_global_transform("Spatial", "get_global_transform"),
    set_global_transform("Spatial", "set_global_transform");

Vector3 floats(const glm::dvec3& of) {
    return {static_cast<float>(of.x), static_cast<float>(of.y), static_cast<float>(of.z)};
}

glm::dvec3 axis(const Transform& transform, float Vector3::*column) {
    const auto& row = transform.basis.row;
    return {row[0].*column, row[1].*column, row[2].*column};
}

/// Throws for a basis that is not a rotation within the rounding of floats.
void need_no_scale(const Transform& transform) {
    const glm::dvec3 x = axis(transform, &Vector3::x), y = axis(transform, &Vector3::y),
                     z = axis(transform, &Vector3::z);
    constexpr double tolerance = 1e-3;
    const bool is_rotation = std::fabs(glm::length(x) - 1) < tolerance && std::fabs(glm::length(y) - 1) < tolerance &&
                             glm::length(glm::cross(x, y) - z) < tolerance;
    if (is_rotation) return;
    throw std::invalid_argument(invalid_value_message(
        "the node's scale",
        number_text(glm::length(x)) + ", " + number_text(glm::length(y)) + ", " + number_text(glm::length(z)),
        "1, 1, 1 and no shear: scale the mesh"));
}

/// Returns the rotation about y that turns the x axis of a hull above the node's. Hull::at_rest()
/// takes an angle, which needs a function that differs between machines.
glm::dquat heading_of(const Transform& transform) {
    const glm::dvec3 bow = axis(transform, &Vector3::x);
    const double length = std::sqrt(bow.x * bow.x + bow.z * bow.z);
    if (!(length > 1e-6)) return {1, 0, 0, 0};
    // From +x towards +z is a negative rotation about y.
    const double cosine = bow.x / length, sine = -bow.z / length;
    // of the half angle
    if (cosine >= 0) {
        const double half = std::sqrt((1 + cosine) / 2);
        return {half, 0, sine / (2 * half), 0};
    }
    const double half = std::copysign(std::sqrt((1 - cosine) / 2), sine);
    return {sine / (2 * half), 0, half, 0};
}

/// Returns the state of another hull whose mesh has the pose and motion of this one's.
HullState state_of(const Hull& changed, const Hull& hull, HullState state) {
    const glm::dvec3 arm = glm::mat3_cast(state.orientation) * (changed.centre_of_mass_m() - hull.centre_of_mass_m());
    state.position_m += arm;
    state.velocity_mps += glm::cross(state.angular_velocity_radps, arm);
    state.has_previous_step = false;
    return state;
}

/// Throws for options that no mesh accepts.
void require_usable(HullOptions options) {
    static const HullMesh some_mesh = [] {
        const glm::dvec3 vertices[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        const HullMesh::Triangle triangles[] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
        return HullMesh(vertices, triangles);
    }();
    if (options.centre_of_mass_m)
        for (int axis = 0; axis < 3; ++axis)
            if (const double at = (*options.centre_of_mass_m)[axis]; !(std::fabs(at) <= 1000))
                throw std::invalid_argument(
                    invalid_value_message(std::string("centre_of_mass_m.") + "xyz"[axis], at, "[-1000, 1000]"));
    options.centre_of_mass_m.reset();
    require(Hull::check(some_mesh, options));
}

}  // namespace

HullNode::~HullNode() {
    if (!waves_of_) return;
    waves_of_->remove(*this);
    try {
        afloat_->clear();
    } catch (const std::exception&) {  // no memory for the command: the pressure stays
    }
}

void HullNode::reject(std::string_view line) const { report_invalid(self_, class_name, line); }

void HullNode::physics_process(double seconds) {
    if (!is_playing_) return;
    try {
        step(seconds);
        reported_.clear();
    } catch (const std::exception& error) {
        report_once(error);
    }
}

void HullNode::report_once(const std::exception& error) {
    const std::string line = one_line(error.what());
    if (line == reported_) return;
    reported_ = line;
    reject(line);
}

void HullNode::press(const Frame& frame) {
    if (!pressed_at_s_) pressed_at_s_ = frame.time_s;
    if (unpressed_s_ == 0) {
        // Else the pressure would move on without the hull.
        if (std::fabs(frame.time_s - *pressed_at_s_) > longest_pause_s) leave_waves();
        return;
    }
    try {
        afloat_->press(frame, unpressed_s_);
        unpressed_s_ = 0;
        pressed_at_s_ = frame.time_s;
    } catch (const std::exception& error) {
        report_once(error);
        leave_waves();
    }
}

void HullNode::leave_waves() {
    if (!waves_of_) return;
    std::exchange(waves_of_, nullptr)->remove(*this);
    const Afloat left = std::move(afloat_);
    try {
        const Hull& hull = left->hull(number);
        const HullState state = left->state(number);
        left->clear();
        afloat_ = afloat(hull, state);
    } catch (const std::exception& error) {  // the next step launches the hull
        report_once(error);
    }
}

OceanNode* HullNode::ocean_of_wake(OceanNode* ocean) const {
    return has_wake_ && ocean && ocean->dynamic_waves_or_null() ? ocean : nullptr;
}

/// \param afloat  with a wake in the ocean's waves
void HullNode::use_waves_of(OceanNode* ocean, Afloat afloat) {
    leave_waves();
    afloat_ = std::move(afloat);
    ocean->add(*this);
    waves_of_ = ocean;
    unpressed_s_ = 0;
    pressed_at_s_.reset();
}

void HullNode::set_ocean(std::string_view path) { ocean_ = std::make_unique<Value>(Path(path).value()); }

void HullNode::set_mesh(const Variant& mesh) {
    if (call(core::variant_get_type, &mesh) == type_nil) {
        hull_mesh_.reset();
        afloat_.reset();
    } else {
        HullMesh read = hull_mesh_of(mesh);
        require(Hull::check(read, options_));
        hull_mesh_ = std::move(read);
    }
    mesh_ = std::make_unique<Value>(mesh);
    is_stale_ = true;
}

void HullNode::set_options(const HullOptions& options) {
    require_usable(options);
    if (hull_mesh_) require(Hull::check(*hull_mesh_, options));
    options_ = options;
    is_stale_ = true;
}

void HullNode::set_inputs(const HullInputs& inputs) {
    require(Hull::check(inputs));
    if (afloat_) afloat_->set_inputs(number, inputs);
    inputs_ = inputs;
}

OceanNode* HullNode::ocean_or_null() const {
    if (!is_inside_tree.on<bool>(self_)) return nullptr;
    const Path path(ocean_->variant());
    if (Text(ocean_->variant()).utf8().empty()) return nullptr;
    return OceanNode::of(get_node.on<Object*>(self_, path.path()));
}

OceanNode& HullNode::needed_ocean() const {
    if (!is_inside_tree.on<bool>(self_))
        throw std::invalid_argument("the node is outside of the scene tree, expected a node of a scene");
    if (OceanNode* const ocean = ocean_or_null()) return *ocean;
    const std::string text = Text(ocean_->variant()).utf8();
    throw std::invalid_argument(
        invalid_value_message("ocean", text.empty() ? "empty" : text, "the path of a PelagicOcean"));
}

Hull HullNode::needed_hull() const {
    if (!hull_mesh_) throw std::invalid_argument(invalid_value_message("mesh", "null", "a closed Mesh"));
    return Hull(*hull_mesh_, options_);
}

HullNode::Afloat HullNode::afloat(const Hull& hull, const HullState& state, DynamicWaves* waves) const {
    Afloat made = std::make_unique<FloatingBodies>(make_serial_executor(), waves);
    made->add(hull, state);
    made->set_inputs(number, inputs_);
    return made;
}

HullState HullNode::launched(const Hull& hull) const {
    const WaterFrame& water = needed_ocean().water_frame();
    const auto pose = get_global_transform.on<Transform>(self_);
    need_no_scale(pose);
    HullState state = hull.at_rest(0, 0);
    state.orientation = heading_of(pose);
    // The node is the mesh's origin, and the state the centre of mass.
    const glm::dvec3 arm = glm::mat3_cast(state.orientation) * hull.centre_of_mass_m();
    state.position_m.x = pose.origin.x + arm.x;
    state.position_m.y += water.sea_level_m;
    state.position_m.z = pose.origin.z + arm.z;
    state.velocity_mps = {water.current_x_mps, 0, water.current_z_mps};
    return state;
}

void HullNode::launch() {
    const Hull hull = needed_hull();
    const HullState state = launched(hull);
    leave_waves();
    afloat_ = afloat(hull, state);
    is_stale_ = false;
    place();
}

FloatingBodies& HullNode::needed_afloat() {
    if (!afloat_) launch();
    if (!is_stale_) return *afloat_;
    const Hull hull = needed_hull();
    const HullState state = state_of(hull, afloat_->hull(number), afloat_->state(number));
    leave_waves();
    afloat_ = afloat(hull, state);
    is_stale_ = false;
    return *afloat_;
}

bool HullNode::step(double seconds) {
    OceanNode& ocean = needed_ocean();
    const Frame* const frame = ocean.frame();
    if (!frame) throw std::invalid_argument("the ocean has invalid options, which it reported");
    if (!ocean.settings().depth)
        throw std::invalid_argument("the ocean has no depth: set depth to true");
    Hull::check_step(WaterQuery(*frame), {}, seconds);  // before a launch
    needed_afloat();
    OceanNode* const makes_wake_in = ocean_of_wake(&ocean);
    if (makes_wake_in != waves_of_) {
        leave_waves();
        const FloatingBodies& now = needed_afloat();
        if (makes_wake_in)
            use_waves_of(makes_wake_in, afloat(now.hull(number), now.state(number), ocean.dynamic_waves_or_null()));
    }
    const bool is_all = needed_afloat().step(*frame, seconds);
    if (waves_of_) unpressed_s_ += std::min(seconds, longest_step_s);
    place();
    return is_all;
}

void HullNode::shift(double x_m, double z_m) {
    if (!afloat_) return;
    afloat_->shift(x_m, z_m);
    place();
}

void HullNode::place() {
    const HullState& state = afloat_->state(number);
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    Transform pose;
    for (int row = 0; row < 3; ++row) pose.basis.row[row] = floats({axes[0][row], axes[1][row], axes[2][row]});
    pose.origin = floats(afloat_->hull(number).mesh_origin_m(state));
    if (is_inside_tree.on<bool>(self_)) set_global_transform.on(self_, pose);
}

std::unique_ptr<Table> HullNode::info() {
    const Hull hull = needed_hull();
    const HullAfloat& afloat = hull.afloat();
    auto answers = std::make_unique<Table>();
    answers->set("floats", Value(afloat.floats));
    answers->set("mass_kg", Value(hull.mass_kg()));
    answers->set("centre_of_mass_m", Value(floats(hull.centre_of_mass_m())));
    answers->set("volume_m3", Value(hull.mesh().volume_m3()));
    answers->set("draught_m", Value(afloat.draught_m));
    answers->set("roll_gm_m", Value(afloat.roll_gm_m));
    answers->set("pitch_gm_m", Value(afloat.pitch_gm_m));
    return answers;
}

std::unique_ptr<Table> HullNode::state() {
    const FloatingBodies& bodies = needed_afloat();
    const HullState& state = bodies.state(number);
    const HullLoads& loads = bodies.loads(number);
    auto answers = std::make_unique<Table>();
    answers->set("position_m", Value(floats(state.position_m)));
    answers->set("velocity_mps", Value(floats(state.velocity_mps)));
    answers->set("angular_velocity_radps", Value(floats(state.angular_velocity_radps)));
    answers->set("displaced_m3", Value(loads.displaced_m3));
    answers->set("water_height_m", Value(loads.water_height_m));
    answers->set("force_n", Value(floats(loads.total().force_n)));
    answers->set("torque_nm", Value(floats(loads.total().torque_nm)));
    return answers;
}

std::vector<std::uint8_t> HullNode::save_state() {
    std::vector<std::uint8_t> saved = needed_afloat().save_state();
    if (!waves_of_) return saved;
    const std::size_t size = saved.size();
    saved.resize(size + sizeof unpressed_s_);
    std::memcpy(saved.data() + size, &unpressed_s_, sizeof unpressed_s_);
    return saved;
}

double HullNode::unpressed_in(std::span<const std::uint8_t>& saved) {
    double unpressed_s = 0;
    const std::size_t size = saved.size() < sizeof unpressed_s ? 0 : saved.size() - sizeof unpressed_s;
    if (size == 0) return unpressed_s;  // which FloatingBodies rejects
    std::memcpy(&unpressed_s, saved.data() + size, sizeof unpressed_s);
    saved = saved.first(size);
    if (!(unpressed_s >= 0 && unpressed_s <= 1e9))
        throw std::invalid_argument("the saved hull is damaged, expected the bytes that save_state() returned");
    return unpressed_s;
}

void HullNode::read(FloatingBodies& bodies, std::span<const std::uint8_t> saved) {
    bodies.restore_state(saved);
    if (bodies.size() != 1)
        throw std::invalid_argument(invalid_value_message("the number of saved bodies", bodies.size(), "1"));
    try {
        bodies.state(number);
    } catch (const std::invalid_argument&) {
        throw std::invalid_argument("the saved body is not the first of its set, as that of a PelagicHull is");
    }
}

void HullNode::restore_state(std::span<const std::uint8_t> saved) {
    needed_afloat();
    OceanNode* const ocean = ocean_of_wake(ocean_or_null());
    const double unpressed_s = ocean ? unpressed_in(saved) : 0;
    if (ocean && ocean == waves_of_) {  // the restored waves have its pressure
        FloatingBodies& bodies = *afloat_;
        const std::vector<std::uint8_t> before = bodies.save_state();
        try {
            read(bodies, saved);
        } catch (const std::exception&) {
            bodies.restore_state(before);
            throw;
        }
        pressed_at_s_.reset();
    } else {
        Afloat restored =
            afloat(afloat_->hull(number), afloat_->state(number), ocean ? ocean->dynamic_waves_or_null() : nullptr);
        restored->clear();  // the pressure that was added now
        read(*restored, saved);
        leave_waves();
        if (ocean)
            use_waves_of(ocean, std::move(restored));
        else
            afloat_ = std::move(restored);
    }
    unpressed_s_ = unpressed_s;
    inputs_ = afloat_->inputs(number);
    inputs_.wake = nullptr;
    place();
}

}  // namespace pelagic::godot
