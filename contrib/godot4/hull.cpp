#include "pelagic/contrib/godot4/hull.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "pelagic/contrib/godot3/close_seams.hpp"
#include "pelagic/contrib/godot4/options.g.hpp"

namespace pelagic::godot4 {
namespace {

struct Double3 {
    double x, y, z;
};

std::array<double, 3> doubles(const Vector3& of) {
    return {static_cast<double>(of.x), static_cast<double>(of.y), static_cast<double>(of.z)};
}

/// The rotation matrix of a unit quaternion, by rows.
std::array<Double3, 3> matrix_of(const double (&q)[4]) {
    const auto [x, y, z, w] = q;
    return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
             {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
             {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}
Double3 rotated(const double (&q)[4], const double (&v)[3]) {
    const std::array<Double3, 3> m = matrix_of(q);
    const auto row = [&](std::size_t i) { return m[i].x * v[0] + m[i].y * v[1] + m[i].z * v[2]; };
    return {row(0), row(1), row(2)};
}

/// Throws for a basis that is not a rotation within the rounding of floats.
void need_no_scale(const Transform& pose) {
    const auto dot = [&](auto a, auto b) {
        double sum = 0;
        for (const Vector3& row : pose.row) sum += static_cast<double>(row.*a) * static_cast<double>(row.*b);
        return sum;
    };
    const auto x = &Vector3::x, y = &Vector3::y, z = &Vector3::z;
    constexpr double tolerance = 1e-3;
    const bool is_rotation = std::fabs(dot(x, x) - 1) < tolerance && std::fabs(dot(y, y) - 1) < tolerance &&
                             std::fabs(dot(z, z) - 1) < tolerance && std::fabs(dot(x, y)) < tolerance &&
                             std::fabs(dot(y, z)) < tolerance && std::fabs(dot(z, x)) < tolerance;
    if (!is_rotation)
        throw std::invalid_argument("the node is scaled, expected the scale 1, 1, 1 and no shear: scale the mesh");
}

/// Writes the rotation about y that turns the x axis of a hull above the node's: pelagic_hull_at_rest() takes an angle,
/// which needs a function that differs between machines.
void set_heading(const Transform& pose, double (&orientation)[4]) {
    const double bow_x = static_cast<double>(pose.row[0].x), bow_z = static_cast<double>(pose.row[2].x);
    const double length = std::sqrt(bow_x * bow_x + bow_z * bow_z);
    if (!(length > 1e-6)) return;
    // From +x towards +z is a negative rotation about y.
    const double cosine = bow_x / length, sine = -bow_z / length;
    const double half = cosine >= 0 ? std::sqrt((1 + cosine) / 2) : std::copysign(std::sqrt((1 - cosine) / 2), sine);
    orientation[1] = cosine >= 0 ? sine / (2 * half) : half;
    orientation[3] = cosine >= 0 ? half : sine / (2 * half);
}

}  // namespace

Hull::~Hull() {
    leave();
    pelagic_hull_destroy(hull_);
}

void Hull::exit_tree() { leave(); }

void Hull::leave() {
    if (!bodies_) return;
    swims_in_->remove(*this);
    swims_in_ = nullptr;
    pelagic_bodies_destroy(std::exchange(bodies_, nullptr));
}

void Hull::press(double time_s) {
    if (!makes_wake_) return;
    if (!pressed_at_s_) pressed_at_s_ = time_s;
    if (unpressed_s_ == 0) {
        // Else the pressure would move on without the hull.
        if (std::fabs(time_s - *pressed_at_s_) > longest_pause_s) leave();
        return;
    }
    pressed_at_s_ = time_s;
    if (pelagic_bodies_press(bodies_, std::exchange(unpressed_s_, 0)) != PELAGIC_OK) reject(pelagic_last_error());
}

void Hull::physics_process(double seconds) {
    if (is_playing_) run_in_frame([&] { step(seconds); });
}

pelagic_hull* Hull::make(const pelagic_hull_options& options, const std::optional<Vector>& centre,
                         const std::optional<Vector>& inertia) const {
    pelagic_hull_mesh mesh = pelagic_hull_mesh_make();
    mesh.vertex_count = vertices_m_.size() / 3;
    mesh.vertices_m = vertices_m_.data();
    mesh.triangle_count = triangles_.size() / 3;
    mesh.triangles = triangles_.data();
    pelagic_hull_options all = options;
    all.centre_of_mass_m = centre ? centre->data() : nullptr;
    all.inertia_kgm2 = inertia ? inertia->data() : nullptr;
    pelagic_hull* hull = nullptr;
    require(pelagic_hull_create(&mesh, &all, &hull));
    return hull;
}

void Hull::set_mesh(const Value& mesh) {
    std::vector<Double3> vertices;
    std::vector<std::uint32_t> triangles;
    const std::int64_t surfaces = mesh.is_nil() ? 0 : mesh.call("get_surface_count").whole();
    for (std::int64_t i = 0; i < surfaces; ++i) {
        const Value type = mesh.call("surface_get_primitive_type", i), arrays = mesh.call("surface_get_arrays", i);
        const std::vector<Vector3> positions = arrays.at(vertex_array).elements<Vector3>();
        const Value index = arrays.at(index_array);
        std::vector<std::int32_t> numbers;
        if (index.type() == type_ints)
            numbers = index.elements<std::int32_t>();
        else
            for (std::size_t v = 0; v < positions.size(); ++v) numbers.push_back(static_cast<std::int32_t>(v));
        // Only ArrayMesh has the method.
        if ((!type.is_nil() && type.whole() != primitive_triangles) || numbers.size() % 3 != 0)
            throw std::invalid_argument("surface " + std::to_string(i) +
                                        " of the mesh has other primitives, expected PRIMITIVE_TRIANGLES");
        const auto first = static_cast<std::uint32_t>(vertices.size());
        for (const Vector3& at : positions) {
            const auto [x, y, z] = doubles(at);
            vertices.push_back({x, y, z});
        }
        // The engine's front faces are clockwise, Pelagic's counter-clockwise.
        for (std::size_t v = 0; v < numbers.size(); v += 3)
            for (const std::size_t corner : {v, v + 2, v + 1})
                triangles.push_back(first + static_cast<std::uint32_t>(numbers[corner]));
    }
    godot::close_seams(vertices);
    std::vector<double> flat;
    for (const Double3& v : vertices) flat.insert(flat.end(), {v.x, v.y, v.z});
    std::swap(flat, vertices_m_);
    std::swap(triangles, triangles_);
    pelagic_hull* made = nullptr;
    if (!mesh.is_nil()) {
        try {
            made = make(options_, centre_of_mass_m_, inertia_kgm2_);
        } catch (const std::exception&) {
            std::swap(flat, vertices_m_);
            std::swap(triangles, triangles_);
            throw;
        }
    }
    leave();
    if (!made) state_.reset();
    pelagic_hull_destroy(std::exchange(hull_, made));
    if (hull_) require(pelagic_hull_describe(hull_, &info_));
    mesh_ = mesh;
}

/// Keeps the pose and the motion of the mesh.
void Hull::set_options(const pelagic_hull_options& options, const std::optional<Vector>& centre,
                       const std::optional<Vector>& inertia) {
    if (hull_) {
        pelagic_hull* const made = make(options, centre, inertia);
        leave();
        pelagic_hull_destroy(std::exchange(hull_, made));
        const pelagic_hull_info before = std::exchange(info_, {});
        require(pelagic_hull_describe(hull_, &info_));
        if (state_) {
            double moved[3];
            for (std::size_t i = 0; i < 3; ++i) moved[i] = info_.centre_of_mass_m[i] - before.centre_of_mass_m[i];
            const Double3 arm = rotated(state_->orientation, moved);
            const double* w = state_->angular_velocity_radps;
            const double added[3][2] = {{arm.x, w[1] * arm.z - w[2] * arm.y},
                                        {arm.y, w[2] * arm.x - w[0] * arm.z},
                                        {arm.z, w[0] * arm.y - w[1] * arm.x}};
            for (std::size_t i = 0; i < 3; ++i) {
                state_->position_m[i] += added[i][0];
                state_->velocity_mps[i] += added[i][1];
            }
            state_->has_previous_step = 0;
        }
    }
    options_ = options;
    centre_of_mass_m_ = centre;
    inertia_kgm2_ = inertia;
}

pelagic_hull* Hull::needed_hull() {
    if (!hull_) refuse("mesh", "null", "a closed Mesh");
    return hull_;
}

void Hull::launch() {
    needed_hull();
    const pelagic_water_frame& water = Ocean::at(self(), ocean_).settings().water;
    const Transform pose = self().call("get_global_transform").transform();
    need_no_scale(pose);
    pelagic_hull_state state;
    require(pelagic_hull_at_rest(hull_, 0, 0, 0, &state));
    set_heading(pose, state.orientation);
    // The node is the mesh's origin, and the state the centre of mass.
    const Double3 arm = rotated(state.orientation, info_.centre_of_mass_m);
    state.position_m[0] = static_cast<double>(pose.origin.x) + arm.x;
    state.position_m[1] += water.sea_level_m;
    state.position_m[2] = static_cast<double>(pose.origin.z) + arm.z;
    state.velocity_mps[0] = water.current_x_mps;
    state.velocity_mps[2] = water.current_z_mps;
    leave();
    state_ = state;
    place();
}

/// Adds the hull to the ocean, or to its dynamic waves.
void Hull::need_bodies(Ocean& ocean) {
    needed_hull();
    if (!state_) launch();
    const bool wake = has_wake_ && ocean.has_dynamic_waves();
    if (bodies_ && swims_in_ == &ocean && makes_wake_ == wake) return;
    leave();
    pelagic_executor_options serial = pelagic_executor_options_make();
    serial.kind = PELAGIC_EXECUTOR_SERIAL;
    pelagic_executor* executor = nullptr;
    require(pelagic_executor_create(&serial, &executor));
    pelagic_bodies_options options = pelagic_bodies_options_make();
    options.wakes = wake;
    options.executor = executor;
    pelagic_bodies* bodies = nullptr;
    pelagic_status status = pelagic_bodies_create(ocean.handle(), &options, &bodies);
    pelagic_executor_destroy(executor);
    if (status == PELAGIC_OK) status = pelagic_bodies_add(bodies, hull_, &*state_, &number_);
    if (status == PELAGIC_OK) status = pelagic_bodies_set_inputs(bodies, number_, &inputs_);
    if (status != PELAGIC_OK) {
        const std::string why = pelagic_last_error();
        pelagic_bodies_destroy(bodies);
        throw std::invalid_argument(why);
    }
    bodies_ = bodies;
    swims_in_ = &ocean;
    makes_wake_ = wake;
    unpressed_s_ = 0;
    pressed_at_s_.reset();
    ocean.add(*this);
}

bool Hull::step(double seconds) {
    if (!(seconds >= 0)) refuse("step_s", Value(seconds).text(), "at least 0");
    Ocean& ocean = Ocean::at(self(), ocean_);
    ocean.frame();
    if (!ocean.settings().depth) throw std::invalid_argument("the ocean has no depth: set depth to true");
    need_bodies(ocean);
    std::int32_t is_all = 0;
    require(pelagic_bodies_step(bodies_, seconds, &is_all));
    require(pelagic_bodies_get_state(bodies_, number_, &*state_));
    require(pelagic_bodies_get_loads(bodies_, number_, &loads_));
    unpressed_s_ += std::min(seconds, 1.0);
    place();
    return is_all != 0;
}

void Hull::shift(double x_m, double z_m) {
    if (!state_) return;
    if (bodies_) {
        require(pelagic_bodies_shift(bodies_, x_m, z_m));
        require(pelagic_bodies_get_state(bodies_, number_, &*state_));
    } else {
        state_->position_m[0] += x_m;
        state_->position_m[2] += z_m;
    }
    place();
}

void Hull::place() {
    if (!self().call("is_inside_tree").boolean()) return;
    const std::array<Double3, 3> axes = matrix_of(state_->orientation);
    Transform pose;
    for (std::size_t row = 0; row < 3; ++row) {
        const double values[3] = {axes[row].x, axes[row].y, axes[row].z};
        pose.row[row] = floats(values);
    }
    const Double3 arm = rotated(state_->orientation, info_.centre_of_mass_m);
    const double* at = state_->position_m;
    const double origin[3] = {at[0] - arm.x, at[1] - arm.y, at[2] - arm.z};
    pose.origin = floats(origin);
    self().call("set_global_transform", pose);
}

Value Hull::info() {
    needed_hull();
    Value answers = Value::empty(type_dictionary);
    answers.set("floats", info_.floats != 0).set("mass_kg", info_.mass_kg);
    answers.set("centre_of_mass_m", floats(info_.centre_of_mass_m)).set("volume_m3", info_.volume_m3);
    answers.set("draught_m", info_.draught_m).set("roll_gm_m", info_.roll_gm_m).set("pitch_gm_m", info_.pitch_gm_m);
    return answers;
}

Value Hull::state() {
    needed_hull();
    if (!state_) launch();
    Value answers = Value::empty(type_dictionary);
    answers.set("position_m", floats(state_->position_m)).set("velocity_mps", floats(state_->velocity_mps));
    answers.set("angular_velocity_radps", floats(state_->angular_velocity_radps));
    answers.set("displaced_m3", loads_.displaced_m3).set("water_height_m", loads_.water_height_m);
    answers.set("force_n", floats(loads_.total.force_n)).set("torque_nm", floats(loads_.total.torque_nm));
    return answers;
}

Value Hull::save() {
    Ocean& ocean = Ocean::at(self(), ocean_);
    ocean.frame();
    need_bodies(ocean);
    std::vector<std::uint8_t> bytes = saved(pelagic_bodies_save_state, bodies_);
    if (!makes_wake_) return Value::packed(bytes);
    bytes.resize(bytes.size() + sizeof unpressed_s_);
    std::memcpy(bytes.data() + bytes.size() - sizeof unpressed_s_, &unpressed_s_, sizeof unpressed_s_);
    return Value::packed(bytes);
}

void Hull::restore(const Value& saved) {
    Ocean& ocean = Ocean::at(self(), ocean_);
    ocean.frame();
    need_bodies(ocean);
    std::vector<std::uint8_t> bytes = saved.elements<std::uint8_t>();
    double unpressed_s = 0;
    if (makes_wake_ && bytes.size() > sizeof unpressed_s) {
        std::memcpy(&unpressed_s, bytes.data() + bytes.size() - sizeof unpressed_s, sizeof unpressed_s);
        bytes.resize(bytes.size() - sizeof unpressed_s);
        if (!(unpressed_s >= 0 && unpressed_s <= 1e9))
            throw std::invalid_argument("the saved hull is damaged, expected the bytes that save_state() returned");
    }
    require(pelagic_bodies_restore_state(bodies_, bytes.data(), bytes.size()));
    require(pelagic_bodies_get_state(bodies_, number_, &*state_));
    require(pelagic_bodies_get_loads(bodies_, number_, &loads_));
    unpressed_s_ = unpressed_s;
    pressed_at_s_.reset();
    place();
}

NodeClass& Hull::description() {
    static NodeClass all = [] {
        NodeClass of("PelagicHull", "Node3D", {"_exit_tree", "_physics_process"},
                     [](Object* self) { return std::make_unique<Hull>(self); });
        const auto hull = [](Node& node) -> Hull& { return static_cast<Hull&>(node); };
        of.property(
            {"ocean", type_path, 0, "", ""}, [=](Node& node) { return hull(node).ocean_; },
            [=](Node& node, const Value& value) { hull(node).ocean_ = Value::path(value.text()); });
        of.property(
            {"mesh", type_object, 17, "Mesh", "Mesh"},
            [=](Node& node) { return hull(node).mesh_; },  // 17: a resource
            [=](Node& node, const Value& value) { hull(node).set_mesh(value); });
        for (const Option& option : hull_table)
            of.option(
                "", option, [](const Node& node) -> const void* { return &static_cast<const Hull&>(node).options_; },
                [=](Node& node, const Option& row, double value) {
                    pelagic_hull_options options = hull(node).options_;
                    row.write(&options, value);
                    hull(node).set_options(options, hull(node).centre_of_mass_m_, hull(node).inertia_kgm2_);
                });
        // Vectors that are null for the value that the library derives from the mesh.
        const auto optional = [&](const char* name, std::optional<Vector> Hull::*member) {
            of.property(
                {name, type_any, 0, "", ""},
                [=](Node& node) {
                    const std::optional<Vector>& value = hull(node).*member;
                    return value ? Value(floats(value->data())) : Value();
                },
                [=](Node& node, const Value& value) {
                    if (!value.is_nil() && value.type() != type_vector3)
                        refuse(name, value.text(), "a Vector3 or null");
                    Hull& it = hull(node);
                    std::optional<Vector> centre = it.centre_of_mass_m_, inertia = it.inertia_kgm2_;
                    (member == &Hull::inertia_kgm2_ ? inertia : centre) =
                        value.is_nil() ? std::optional<Vector>() : std::optional(doubles(value.vector()));
                    it.set_options(it.options_, centre, inertia);
                });
        };
        optional("centre_of_mass_m", &Hull::centre_of_mass_m_);
        optional("inertia_kgm2", &Hull::inertia_kgm2_);
        const auto input = [&](const char* name, double* (*at)(pelagic_hull_inputs&), double limit,
                               const char* accepted) {
            of.property(
                {name, type_vector3, 0, "", ""}, [=](Node& node) { return Value(floats(at(hull(node).inputs_))); },
                [=](Node& node, const Value& value) {
                    const Vector wanted = doubles(value.vector());
                    for (const double component : wanted)
                        if (!(std::fabs(component) <= limit)) refuse(name, value.text(), accepted);
                    Hull& it = hull(node);
                    std::copy(wanted.begin(), wanted.end(), at(it.inputs_));
                    if (it.bodies_) require(pelagic_bodies_set_inputs(it.bodies_, it.number_, &it.inputs_));
                });
        };
        input(
            "force_n", [](pelagic_hull_inputs& it) { return it.force.force_n; }, 1e15, "[-1e15, 1e15]");
        input(
            "torque_nm", [](pelagic_hull_inputs& it) { return it.force.torque_nm; }, 1e15, "[-1e15, 1e15]");
        input(
            "wind_mps", [](pelagic_hull_inputs& it) { return it.wind_mps; }, 1e3, "[-1e3, 1e3]");
        const auto flag = [&](const char* name, bool Hull::*member) {
            of.property(
                {name, type_bool, 0, "", ""}, [=](Node& node) { return Value(hull(node).*member); },
                [=](Node& node, const Value& value) { hull(node).*member = value.boolean(); });
        };
        flag("wake", &Hull::has_wake_);
        flag("playing", &Hull::is_playing_);

        using Arguments = std::span<const Value>;
        of.method("launch", {}, type_nil, [=](Node& node, Arguments) { return hull(node).launch(), Value(); });
        of.method("step", {{"step_s", type_float}}, type_bool,
                  [=](Node& node, Arguments of_call) { return Value(hull(node).step(of_call[0].number())); });
        of.method("shift", {{"x_m", type_float}, {"z_m", type_float}}, type_nil, [=](Node& node, Arguments of_call) {
            return hull(node).shift(of_call[0].number(), of_call[1].number()), Value();
        });
        of.method("info", {}, type_dictionary, [=](Node& node, Arguments) { return hull(node).info(); });
        of.method("state", {}, type_dictionary, [=](Node& node, Arguments) { return hull(node).state(); });
        of.method("save_state", {}, type_bytes, [=](Node& node, Arguments) { return hull(node).save(); });
        of.method("restore_state", {{"saved", type_bytes}}, type_nil,
                  [=](Node& node, Arguments of_call) { return hull(node).restore(of_call[0]), Value(); });
        return of;
    }();
    return all;
}

}  // namespace pelagic::godot4
