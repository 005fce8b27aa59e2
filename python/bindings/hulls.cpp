// Hulls, and sets of them that float in an ocean's water.
#include <pybind11/numpy.h>

#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/ocean_parts.hpp"
#include "pelagic/python/bindings/option_fields.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

using HullPointer = std::shared_ptr<Hull>;  // pybind11 holds no pointer to const

glm::dvec3 vector_of(py::handle given, const std::string& name) {
    const Doubles array = doubles_of(given, name);
    if (array.ndim() != 1 || array.size() != 3)
        throw std::invalid_argument(invalid_value_message(name, std::string(py::repr(given)), "x, y and z"));
    return {array.at(0), array.at(1), array.at(2)};
}

py::tuple tuple_of(const glm::dvec3& v) { return py::make_tuple(v.x, v.y, v.z); }

/// Returns the object of a class of this module. Throws TypeError for any other object and None.
template <class Object>
std::shared_ptr<Object> needed(py::handle object, const char* argument, const char* accepted) {
    if (!py::isinstance<Object>(object))
        throw py::type_error(invalid_value_message(argument, std::string(py::repr(object)), accepted));
    return object.cast<std::shared_ptr<Object>>();
}

/// Throws std::invalid_argument unless the shape is (n, 3).
void need_rows_of_three(const py::array& array, const char* name, const char* meaning) {
    if (array.ndim() != 2 || array.shape(1) != 3)
        throw std::invalid_argument(std::string(name) + " has another shape, expected (n, 3): " + meaning);
}

HullMesh mesh_of(py::handle vertices, py::handle triangles) {
    const Doubles positions = doubles_of(vertices, "vertices");
    need_rows_of_three(positions, "vertices", "x, y and z of each vertex");
    const py::array given = py::array::ensure(triangles);
    PyErr_Clear();
    if (!given || (given.dtype().kind() != 'i' && given.dtype().kind() != 'u'))
        throw std::invalid_argument("triangles can't be made an array of whole numbers");
    need_rows_of_three(given, "triangles", "the numbers of the vertices of each triangle");
    require(HullMesh::check_counts(static_cast<std::size_t>(positions.shape(0)),
                                   static_cast<std::size_t>(given.shape(0))));
    const auto numbers = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>::ensure(given);
    std::vector<glm::dvec3> points;
    for (py::ssize_t i = 0; i < positions.shape(0); ++i)
        points.emplace_back(positions.at(i, 0), positions.at(i, 1), positions.at(i, 2));
    std::vector<HullMesh::Triangle> corners;
    for (py::ssize_t i = 0; i < numbers.shape(0); ++i) {
        HullMesh::Triangle& triangle = corners.emplace_back();
        for (py::ssize_t j = 0; j < 3; ++j) {
            const std::int64_t number = numbers.at(i, j);
            if (number < 0 || number >= positions.shape(0))
                throw std::invalid_argument("triangle " + number_text(i) + " of the hull has vertex " +
                                            number_text(number) + ", expected 0 to " +
                                            number_text(positions.shape(0) - 1));
            triangle[static_cast<std::size_t>(j)] = static_cast<std::uint32_t>(number);
        }
    }
    return HullMesh(points, corners);
}

HullMatrix matrix_of(py::handle given) {
    const Doubles array = doubles_of(given, "added_mass");
    if (array.ndim() != 2 || array.shape(0) != 6 || array.shape(1) != 6)
        throw std::invalid_argument("added_mass has another shape, expected (6, 6)");
    HullMatrix matrix;
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) matrix[i][j] = array.at(i, j);
    return matrix;
}

/// \param coefficients  the numeric options except the mass, in the order of hull_fields()
HullPointer make_hull(py::handle vertices, py::handle triangles, py::handle mass_kg, py::handle centre_of_mass_m,
                      py::handle inertia_kgm2, py::handle added_mass, const std::array<py::handle, 11>& coefficients) {
    HullOptions options;
    for (std::size_t i = 0; i < hull_fields().size(); ++i) {
        const NumericField<HullOptions>& field = hull_fields()[i];
        const std::string name(field.name);
        field.set(options, number_of(i == 0 ? mass_kg : coefficients[i - 1], name, false, field.accepted));
    }
    if (!centre_of_mass_m.is_none()) options.centre_of_mass_m = vector_of(centre_of_mass_m, "centre_of_mass_m");
    if (!inertia_kgm2.is_none()) options.inertia_kgm2 = vector_of(inertia_kgm2, "inertia_kgm2");
    if (!added_mass.is_none()) options.added_mass = matrix_of(added_mass);
    return std::make_shared<Hull>(mesh_of(vertices, triangles), options);
}

HullState at_rest(const Hull& hull, py::handle x_m, py::handle z_m, py::handle heading_rad) {
    const double heading = number_of(heading_rad, "heading_rad", false, "a finite number");
    if (!std::isfinite(heading))
        throw std::invalid_argument(invalid_value_message("heading_rad", heading, "a finite number"));
    const HullState state = hull.at_rest(number_of(x_m, "x_m", false, "[-1e8, 1e8]"),
                                         number_of(z_m, "z_m", false, "[-1e8, 1e8]"), heading);
    require(Hull::check(state));
    return state;
}

void add_hull(py::module_& module) {
    using Of = py::handle;
    py::class_<Hull, HullPointer> hull(module, "Hull", doc_of("Hull"));
    hull.def(py::init([](Of vertices, Of triangles, Of mass_kg, Of centre_of_mass_m, Of inertia_kgm2, Of added_mass,
                         Of heave_damping, Of roll_damping, Of pressure_coefficient, Of suction_coefficient,
                         Of friction_coefficient, Of air_coefficient, Of water_density_kgpm3, Of air_density_kgpm3,
                         Of skeg_m2, Of skeg_x_m, Of skeg_y_m) {
                 return make_hull(vertices, triangles, mass_kg, centre_of_mass_m, inertia_kgm2, added_mass,
                                  {heave_damping, roll_damping, pressure_coefficient, suction_coefficient,
                                   friction_coefficient, air_coefficient, water_density_kgpm3, air_density_kgpm3,
                                   skeg_m2, skeg_x_m, skeg_y_m});
             }),
             py::arg("vertices"), py::arg("triangles"), py::arg("mass_kg"), py::kw_only(),
             py::arg("centre_of_mass_m") = py::none(), py::arg("inertia_kgm2") = py::none(),
             py::arg("added_mass") = py::none(), py::arg("heave_damping") = 0.2, py::arg("roll_damping") = 0.05,
             py::arg("pressure_coefficient") = 0.7, py::arg("suction_coefficient") = 0.35,
             py::arg("friction_coefficient") = 0.004, py::arg("air_coefficient") = 1.0,
             py::arg("water_density_kgpm3") = 1025.0, py::arg("air_density_kgpm3") = 1.225,
             py::arg("skeg_m2") = 0.0, py::arg("skeg_x_m") = 0.0, py::arg("skeg_y_m") = 0.0, doc_of("Hull.__init__"));
    add(hull, "volume_m3", [](const Hull& of) { return of.mesh().volume_m3(); });
    add(hull, "centre_m", [](const Hull& of) { return tuple_of(of.mesh().centre_m()); });
    add(hull, "mass_kg", [](const Hull& of) { return of.mass_kg(); });
    add(hull, "centre_of_mass_m", [](const Hull& of) { return tuple_of(of.centre_of_mass_m()); });
    add(hull, "floats", [](const Hull& of) { return of.afloat().floats; });
    add(hull, "draught_m", [](const Hull& of) { return of.afloat().draught_m; });
    add(hull, "height_m", [](const Hull& of) { return of.afloat().height_m; });
    add(hull, "waterplane_m2", [](const Hull& of) { return of.afloat().waterplane_m2; });
    add(hull, "roll_gm_m", [](const Hull& of) { return of.afloat().roll_gm_m; });
    add(hull, "pitch_gm_m", [](const Hull& of) { return of.afloat().pitch_gm_m; });
    add(hull, "digest", [](const Hull& of) { return of.digest(); });
    hull.def("at_rest", &at_rest, py::arg("x_m"), py::arg("z_m"), py::arg("heading_rad") = 0.0,
             doc_of("Hull.at_rest"));
    module.def("hull_fields", [] { return described(hull_fields()); });
}

/// Adds a property with three numbers, which is checked when it is set.
template <class Class>
void add_vector(Class& to, const char* name, glm::dvec3 HullState::*member) {
    to.def_property(
        name, [member](const HullState& of) { return tuple_of(of.*member); },
        [member, name](HullState& of, py::handle value) {
            HullState changed = of;
            changed.*member = vector_of(value, name);
            require(Hull::check(changed));
            of = changed;
        },
        doc_of((std::string("HullState.") + name).c_str()));
}

void set_orientation(HullState& of, py::handle value) {
    const Doubles q = doubles_of(value, "orientation");
    if (q.ndim() != 1 || q.size() != 4)
        throw std::invalid_argument(
            invalid_value_message("orientation", std::string(py::repr(value)), "x, y, z and w"));
    HullState changed = of;
    changed.orientation = glm::dquat(q.at(3), q.at(0), q.at(1), q.at(2));
    require(Hull::check(changed));
    of = changed;
}

void add_state(py::module_& module) {
    py::class_<HullState, std::shared_ptr<HullState>> state(module, "HullState", doc_of("HullState"));
    add_vector(state, "position_m", &HullState::position_m);
    add_vector(state, "velocity_mps", &HullState::velocity_mps);
    add_vector(state, "angular_velocity_radps", &HullState::angular_velocity_radps);
    state.def_property(
        "orientation",
        [](const HullState& of) {
            return py::make_tuple(of.orientation.x, of.orientation.y, of.orientation.z, of.orientation.w);
        },
        &set_orientation, doc_of("HullState.orientation"));
}

std::uint32_t number_of_body(py::handle value) {
    constexpr const char* accepted = "a number that add() returned";
    const double number = number_of(value, "number", true, accepted);
    if (!(number >= 0 && number <= UINT32_MAX))
        throw std::invalid_argument(invalid_value_message("number", number, accepted));
    return static_cast<std::uint32_t>(number);
}

/// A set of bodies and its ocean, for any thread.
class BodiesHandle {
   public:
    BodiesHandle(std::shared_ptr<SharedOcean> ocean, bool wakes, int threads)
        : ocean_(std::move(ocean)), wakes_(wakes), bodies_(make_default_executor(threads), waves()) {}
    ~BodiesHandle() {
        if (!wakes_) return;
        const py::gil_scoped_release others_run;
        try {
            ocean_->use([&](Ocean&) { bodies_.clear(); });
        } catch (const std::exception&) {  // the ocean is closed, and its waves are destroyed
        }
    }
    BodiesHandle(const BodiesHandle&) = delete;
    BodiesHandle& operator=(const BodiesHandle&) = delete;

    /// Calls use(bodies).
    template <class Use>
    void use(Use use) const {
        const py::gil_scoped_release others_run;
        const std::lock_guard lock(mutex_);
        ocean_->need_open();
        use(bodies_);
    }
    /// Calls use(bodies), which enqueues commands for the waves.
    template <class Use>
    void command(Use with) const {
        if (!wakes_) return use(with);
        const py::gil_scoped_release others_run;
        const std::lock_guard lock(mutex_);
        ocean_->use([&](Ocean&) { with(bodies_); });
    }
    void press(const FrameHandle& frame, double tick_s) const {
        const auto reader = frame.read();
        const auto press = [&](auto&) { bodies_.press(frame.frame, tick_s); };
        if (!wakes_) return use(press);
        const py::gil_scoped_release others_run;
        const std::lock_guard lock(mutex_);
        ocean_->use_between_frames(press);
    }
    void need_frame(const FrameHandle& frame) const {
        if (frame.ocean != ocean_) throw std::invalid_argument("the frame is one of another ocean than the bodies'");
    }

   private:
    DynamicWaves* waves() const {
        DynamicWaves* waves = nullptr;
        if (wakes_) ocean_->use([&](Ocean& of) { waves = &of.dynamic_waves(); });
        return waves;
    }

    std::shared_ptr<SharedOcean> ocean_;
    bool wakes_;
    mutable std::mutex mutex_;  // locked before the ocean
    mutable FloatingBodies bodies_;
};

std::shared_ptr<BodiesHandle> make_bodies(py::handle ocean, bool wakes, int threads) {
    const auto of = needed<SharedOcean>(ocean, "ocean", "a pelagic.Ocean");
    const py::gil_scoped_release others_run;
    if (!of->facts().has_velocities)
        throw std::invalid_argument("the ocean has no velocities: create it with velocities=True");
    if (wakes && !of->has_dynamic_waves())
        throw std::invalid_argument(
            "the ocean has no dynamic waves: create it with dynamic_waves=pelagic.DynamicWavesOptions()");
    return std::make_shared<BodiesHandle>(of, wakes, threads);
}

std::uint32_t add_body(const BodiesHandle& of, py::handle hull, py::handle state) {
    const auto kind = needed<Hull>(hull, "hull", "a pelagic.Hull");
    const HullState from = *needed<HullState>(state, "state", "a pelagic.HullState");
    std::uint32_t number = 0;
    of.command([&](FloatingBodies& bodies) { number = bodies.add(*kind, from); });
    return number;
}

void set_inputs(const BodiesHandle& of, py::handle number, py::handle force_n, py::handle torque_nm,
                py::handle wind_mps) {
    const std::uint32_t which = number_of_body(number);
    const HullInputs inputs{.force = {vector_of(force_n, "force_n"), vector_of(torque_nm, "torque_nm")},
                            .wind_mps = vector_of(wind_mps, "wind_mps")};
    of.use([&](FloatingBodies& bodies) { bodies.set_inputs(which, inputs); });
}

py::dict loads_of(const BodiesHandle& of, py::handle number) {
    const std::uint32_t which = number_of_body(number);
    HullLoads loads;
    of.use([&](FloatingBodies& bodies) { loads = bodies.loads(which); });
    py::dict result;
    const auto put = [&](const std::string& name, const HullForce& force) {
        result[py::str(name + "_force_n")] = tuple_of(force.force_n);
        result[py::str(name + "_torque_nm")] = tuple_of(force.torque_nm);
    };
    put("total", loads.total());
    put("pressure", loads.pressure);
    put("added_mass", loads.added_mass);
    put("drag", loads.drag);
    put("slamming", loads.slamming);
    result["displaced_m3"] = loads.displaced_m3;
    result["submersion"] = loads.submersion;
    result["water_height_m"] = loads.water_height_m;
    result["water_slope"] = py::make_tuple(loads.water_slope_x, loads.water_slope_z);
    result["water_velocity_mps"] = tuple_of(loads.water_velocity_mps);
    return result;
}

void press(const BodiesHandle& of, py::handle frame, py::handle tick_s) {
    const auto with = needed<FrameHandle>(frame, "frame", "a pelagic.Frame");
    of.need_frame(*with);
    of.press(*with, number_of(tick_s, "tick_s", false, "[0, inf) s"));
}

bool step(const BodiesHandle& of, py::handle frame, py::handle step_s) {
    const auto in = needed<FrameHandle>(frame, "frame", "a pelagic.Frame");
    of.need_frame(*in);
    const double seconds = number_of(step_s, "step_s", false, "[0, inf) s");
    const auto reader = in->read();
    bool are_all = true;
    of.use([&](FloatingBodies& bodies) { are_all = bodies.step(in->frame, seconds); });
    return are_all;
}

py::bytes save_bodies(const BodiesHandle& of) {
    std::vector<std::uint8_t> saved;
    of.use([&](FloatingBodies& bodies) { saved = bodies.save_state(); });
    return {reinterpret_cast<const char*>(saved.data()), saved.size()};
}

void restore_bodies(const BodiesHandle& of, py::handle saved) {
    if (!py::isinstance<py::bytes>(saved))
        throw py::type_error(invalid_value_message("saved", std::string(py::str(saved.get_type().attr("__name__"))),
                                                   "bytes that save_state() returned"));
    const auto bytes = py::reinterpret_borrow<py::bytes>(saved).cast<std::string_view>();
    of.use([&](FloatingBodies& bodies) {
        bodies.restore_state({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    });
}

void add_bodies(py::module_& module) {
    const py::tuple zero = py::make_tuple(0.0, 0.0, 0.0);
    py::class_<BodiesHandle, std::shared_ptr<BodiesHandle>> type(module, "Bodies", doc_of("Bodies"));
    type.def(py::init(&make_bodies), py::arg("ocean"), py::arg("wakes") = false, py::arg("threads") = 0,
             doc_of("Bodies.__init__"));
    type.def("add", &add_body, py::arg("hull"), py::arg("state"), doc_of("Bodies.add"));
    type.def(
        "remove",
        [](const BodiesHandle& of, py::handle number) {
            const std::uint32_t which = number_of_body(number);
            of.command([&](FloatingBodies& bodies) { bodies.remove(which); });
        },
        py::arg("number"), doc_of("Bodies.remove"));
    type.def("set_inputs", &set_inputs, py::arg("number"), py::arg("force_n") = zero, py::arg("torque_nm") = zero,
             py::arg("wind_mps") = zero, doc_of("Bodies.set_inputs"));
    type.def(
        "state",
        [](const BodiesHandle& of, py::handle number) {
            const std::uint32_t which = number_of_body(number);
            HullState state;
            of.use([&](FloatingBodies& bodies) { state = bodies.state(which); });
            return state;
        },
        py::arg("number"), doc_of("Bodies.state"));
    type.def(
        "set_state",
        [](const BodiesHandle& of, py::handle number, py::handle state) {
            const std::uint32_t which = number_of_body(number);
            const HullState to = *needed<HullState>(state, "state", "a pelagic.HullState");
            of.use([&](FloatingBodies& bodies) { bodies.set_state(which, to); });
        },
        py::arg("number"), py::arg("state"), doc_of("Bodies.set_state"));
    type.def("loads", &loads_of, py::arg("number"), doc_of("Bodies.loads"));
    type.def("press", &press, py::arg("frame"), py::arg("tick_s"), doc_of("Bodies.press"));
    type.def("step", &step, py::arg("frame"), py::arg("step_s"), doc_of("Bodies.step"));
    type.def("save_state", &save_bodies, doc_of("Bodies.save_state"));
    type.def("restore_state", &restore_bodies, py::arg("saved"), doc_of("Bodies.restore_state"));
}

}  // namespace

void add_hulls(py::module_& module) {
    add_hull(module);
    add_state(module);
    add_bodies(module);
}

}  // namespace pelagic::python
