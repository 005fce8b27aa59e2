// Queries of a frame at points and along rays. Points have shape (..., 2), results (...) or (...,
// 3).
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/near_names.hpp"
#include "pelagic/python/bindings/docs.hpp"
#include "pelagic/python/bindings/drawn_water.hpp"
#include "pelagic/python/bindings/frame_handle.hpp"
#include "pelagic/python/bindings/option_fields.hpp"
#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/surface_ray.hpp"

namespace py = pybind11;

namespace pelagic::python {
namespace {

Shape shape_of(const py::array& array) { return {array.shape(), array.shape() + array.ndim()}; }

Shape with(Shape shape, py::ssize_t last) {
    shape.push_back(last);
    return shape;
}

std::string shape_text(const Shape& shape) {
    std::string text = "(";
    for (std::size_t i = 0; i < shape.size(); ++i) text += (i == 0 ? "" : ", ") + number_text(shape[i]);
    return text + (shape.size() == 1 ? ",)" : ")");
}

/// Like doubles_of(), with `numbers` numbers in each element.
Doubles rows_of(py::handle given, const char* name, py::ssize_t numbers, const char* meaning) {
    Doubles array = doubles_of(given, name);
    if (array.ndim() == 0 || array.shape(array.ndim() - 1) != numbers)
        throw std::invalid_argument(invalid_value_message(std::string(name) + ".shape", shape_text(shape_of(array)),
                                                          "(..., " + number_text(numbers) + "): " + meaning));
    return array;
}

/// Appends the elements of an array from an axis on, in order, for any strides.
void append_elements(const py::array& array, py::ssize_t axis, const char* at, std::vector<double>& out) {
    if (axis == array.ndim()) return out.push_back(*reinterpret_cast<const double*>(at));
    for (py::ssize_t i = 0; i < array.shape(axis); ++i)
        append_elements(array, axis + 1, at + i * array.strides(axis), out);
}

/// Arrays broadcast to one shape by NumPy's rules.
struct SameShape {
    Shape shape;
    std::vector<std::vector<double>> elements;  ///< of each array, in order

    explicit SameShape(const std::vector<Doubles>& arrays) {
        const py::list same = py::module_::import("numpy").attr("broadcast_arrays")(*py::tuple(py::cast(arrays)));
        for (const py::handle one : same) {
            const auto array = py::reinterpret_borrow<py::array>(one);
            shape = shape_of(array);
            std::vector<double>& all = elements.emplace_back();
            all.reserve(static_cast<std::size_t>(array.size()));
            append_elements(array, 0, static_cast<const char*>(array.data()), all);
        }
    }
};

/// Positions of a query, x and z separately.
struct Places {
    Shape shape;  ///< shape of results with one number a point
    std::vector<double> x, z;

    explicit Places(const Doubles& points) : shape(shape_of(points)) {
        shape.pop_back();
        const auto count = static_cast<std::size_t>(points.size()) / 2;
        x.resize(count);
        z.resize(count);
        const double* from = points.data();
        for (std::size_t i = 0; i < count; ++i, from += 2) {
            x[i] = from[0];
            z[i] = from[1];
        }
    }
    explicit Places(SameShape both)
        : shape(std::move(both.shape)), x(std::move(both.elements[0])), z(std::move(both.elements[1])) {}
};

Places places_of(py::handle points_or_x, py::handle z) {
    if (z.is_none()) return Places(rows_of(points_or_x, "points", 2, "x and z of each point"));
    return Places(SameShape({doubles_of(points_or_x, "x"), doubles_of(z, "z")}));
}

/// Three separate rows of numbers as an array of vectors.
struct Vectors {
    std::vector<float> x, y, z;

    explicit Vectors(std::size_t count) : x(count), y(count), z(count) {}
    void write(float* out) const {
        for (std::size_t i = 0; i < x.size(); ++i) {
            *out++ = x[i];
            *out++ = y[i];
            *out++ = z[i];
        }
    }
};

constexpr double min_tolerance_m = 1e-6, max_tolerance_m = 1000;  // as in the C interface

/// The requested result fields.
class Fields {
   public:
    explicit Fields(py::handle asked) : all_(asked.is_none()) {
        if (all_) return;
        if (py::isinstance<py::str>(asked) || !py::isinstance<py::iterable>(asked))
            throw py::type_error(invalid_value_message("fields", std::string(py::repr(asked)), "a list of names"));
        for (const py::handle name : asked) {
            const std::string text = py::str(name);
            if (std::find(known_.begin(), known_.end(), text) == known_.end())
                throw std::invalid_argument(invalid_value_message("fields", text, list_of(known_)));
            wanted_.insert(text);
        }
    }
    bool has(const char* name, bool by_default = true) const { return all_ ? by_default : wanted_.contains(name); }

   private:
    const std::vector<std::string> known_ = {"height", "normal",    "jacobian", "velocity",
                                             "foam",   "converged", "error"};
    bool all_;
    std::set<std::string> wanted_;
};

/// Result arrays of one time or of several.
class SampleArrays {
   public:
    /// \param shape shape of results with one number a point and a time
    /// \param count number of points
    SampleArrays(const Fields& fields, const Shape& shape, std::size_t count, bool has_velocities, bool has_foam)
        : count_(count) {
        const auto add = [&](const char* name, std::span<float> SurfaceSamples::*span) {
            py::array_t<float> array(shape);
            numbers_.push_back({array.mutable_data(), span});
            results[name] = std::move(array);
        };
        const auto add_vectors = [&](const char* name, std::array<std::span<float> SurfaceSamples::*, 3> spans) {
            py::array_t<float> array(with(shape, 3));
            vectors_.push_back({array.mutable_data(), spans, Vectors(count)});
            results[name] = std::move(array);
        };
        if (fields.has("height")) add("height", &SurfaceSamples::height_m);
        if (fields.has("normal"))
            add_vectors("normal", {&SurfaceSamples::normal_x, &SurfaceSamples::normal_y, &SurfaceSamples::normal_z});
        if (fields.has("jacobian")) add("jacobian", &SurfaceSamples::jacobian);
        if (fields.has("velocity", has_velocities))
            add_vectors("velocity", {&SurfaceSamples::velocity_x_mps, &SurfaceSamples::velocity_y_mps,
                                     &SurfaceSamples::velocity_z_mps});
        if (fields.has("foam", has_foam)) add("foam", &SurfaceSamples::foam);
        if (fields.has("converged")) {
            py::array_t<bool> array(shape);
            converged_ = reinterpret_cast<std::uint8_t*>(array.mutable_data());
            results["converged"] = std::move(array);
        }
        if (fields.has("error")) add("error", &SurfaceSamples::error_m);
    }

    /// Returns the destinations of the results of a time; write() must follow.
    SurfaceSamples samples(std::size_t moment) {
        SurfaceSamples samples;
        for (const Numbers& numbers : numbers_) samples.*numbers.span = {numbers.data + moment * count_, count_};
        for (ThreeNumbers& three : vectors_) {
            samples.*three.spans[0] = three.parts.x;
            samples.*three.spans[1] = three.parts.y;
            samples.*three.spans[2] = three.parts.z;
        }
        if (converged_) samples.converged = {converged_ + moment * count_, count_};
        return samples;
    }
    void write(std::size_t moment) const {
        for (const ThreeNumbers& three : vectors_) three.parts.write(three.data + 3 * moment * count_);
    }

    py::dict results;

   private:
    struct Numbers {
        float* data;
        std::span<float> SurfaceSamples::*span;
    };
    struct ThreeNumbers {
        float* data;
        std::array<std::span<float> SurfaceSamples::*, 3> spans;
        Vectors parts;
    };
    std::size_t count_;
    std::vector<Numbers> numbers_;
    std::vector<ThreeNumbers> vectors_;
    std::uint8_t* converged_ = nullptr;
};

SurfaceQueryOptions options_of(double tolerance_m, const std::string& interpolation) {
    if (!(tolerance_m >= min_tolerance_m && tolerance_m <= max_tolerance_m))
        throw std::invalid_argument(invalid_value_message("tolerance_m", tolerance_m, "[1e-6, 1000]"));
    const std::optional<Interpolation> named = value_named<Interpolation>(interpolation);
    if (!named) throw std::invalid_argument(invalid_value_message("interpolation", interpolation, "linear or cubic"));
    return {.tolerance_m = tolerance_m, .interpolation = *named};
}

/// Issues a UserWarning if the points span more than the sea's repeat length. The warning points at
/// the caller of the package's function.
void warn_of_span(const Places& places, double repeat_m) {
    double span_m = 0;
    for (const std::vector<double>* along : {&places.x, &places.z}) {
        double min = std::numeric_limits<double>::infinity(), max = -min;
        for (const double at : *along)
            if (std::isfinite(at)) min = std::min(min, at), max = std::max(max, at);
        span_m = std::max(span_m, max - min);
    }
    if (!(span_m > repeat_m)) return;
    // Without the span: Python shows and stores warnings of equal text once for each line of a
    // program.
    const std::string line =
        "the points span more than the " + number_text(repeat_m) + " m after which the longest waves repeat";
    if (PyErr_WarnEx(PyExc_UserWarning, line.c_str(), 2) != 0) throw py::error_already_set();
}

py::dict query(const FrameHandle& handle, py::handle points, py::handle z, py::handle asked, double tolerance_m,
               const std::string& interpolation) {
    const auto reader = handle.read();
    const SurfaceQuery surface(handle.frame, options_of(tolerance_m, interpolation));
    const Places places = places_of(points, z);
    warn_of_span(places, handle.frame.cascades.front().grid.side_m);
    SampleArrays arrays(Fields(asked), places.shape, places.x.size(), surface.has_velocities(), surface.has_foam());
    const SurfaceSamples samples = arrays.samples(0);
    surface.check(samples);  // before other threads run
    {
        const py::gil_scoped_release others_run;
        handle.ocean->sample(surface, {places.x, places.z}, samples);
        arrays.write(0);
    }
    return arrays.results;
}

/// Throws std::invalid_argument if the times span more than the loop, and names a loop that fits.
void need_no_repetition(const std::vector<double>& times_s, double loop_s) {
    const auto [first, last] = std::minmax_element(times_s.begin(), times_s.end());
    const double span_s = *last - *first;
    if (!(span_s > loop_s)) return;
    constexpr double longest_loop_s = 86400;
    const double fits_s = std::ceil(span_s + span_s / static_cast<double>(times_s.size() - 1));
    throw std::invalid_argument(
        "times span " + number_text(span_s) + " s, but the sea repeats after " + number_text(loop_s) + " s: " +
        (fits_s <= longest_loop_s ? "loop_period_s=" + number_text(fits_s) + " is long enough, and "
                                  : "no loop is longer than 86400 s; ") +
        "repeats=True permits repetition");
}

py::dict series(SharedOcean& ocean, py::handle points, py::handle times, py::handle asked, double tolerance_m,
                const std::string& interpolation, bool repeats) {
    const SurfaceQueryOptions options = options_of(tolerance_m, interpolation);
    const Places places = places_of(points, py::none());
    const Doubles moments = doubles_of(times, "times");
    if (moments.ndim() != 1)
        throw std::invalid_argument(
            invalid_value_message("times.shape", shape_text(shape_of(moments)), "(n,): seconds"));
    const std::vector<double> times_s(moments.data(), moments.data() + moments.size());
    for (const double time_s : times_s)
        if (!std::isfinite(time_s))
            throw std::invalid_argument(invalid_value_message("times", time_s, "finite numbers of seconds"));
    const auto facts = [&] {
        const py::gil_scoped_release others_run;
        return ocean.facts();
    }();
    if (!repeats && !times_s.empty()) need_no_repetition(times_s, facts.sea.loop_period_s);
    warn_of_span(places, facts.repeat_length_m);

    Shape shape{static_cast<py::ssize_t>(times_s.size())};
    shape.insert(shape.end(), places.shape.begin(), places.shape.end());
    SampleArrays arrays(Fields(asked), shape, places.x.size(), facts.has_velocities, facts.has_foam);
    {
        const py::gil_scoped_release others_run;
        ocean.frames_at(times_s, [&](std::size_t moment, const Frame& frame) {
            ocean.sample(SurfaceQuery(frame, options), {places.x, places.z}, arrays.samples(moment));
            arrays.write(moment);
            const py::gil_scoped_acquire interrupted;
            if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        });
    }
    return arrays.results;
}

py::dict rays(const FrameHandle& handle, py::handle origins, py::handle directions, py::handle reach,
              double tolerance_m) {
    const auto reader = handle.read();
    if (!(tolerance_m >= min_tolerance_m && tolerance_m <= max_tolerance_m))
        throw std::invalid_argument(invalid_value_message("tolerance_m", tolerance_m, "[1e-6, 1000]"));
    const SurfaceQuery surface(handle.frame, tolerance_m);
    const py::object extended = doubles_of(reach, "reach")
                                    // a reach for each of x, y and z
                                    .attr("__getitem__")(py::make_tuple(py::ellipsis(), py::none()));
    const SameShape same({rows_of(origins, "origins", 3, "x, y and z of each ray"),
                          rows_of(directions, "directions", 3, "x, y and z of each ray"),
                          doubles_of(extended, "reach")});
    Shape shape = same.shape;
    shape.pop_back();
    const std::size_t count = same.elements[0].size() / 3;
    const double *origin = same.elements[0].data(), *direction = same.elements[1].data(),
                 *reaches = same.elements[2].data();

    py::array_t<bool> hit(shape), from_below(shape);
    py::array_t<double> distance(shape), position(with(shape, 3));
    py::array_t<float> normal(with(shape, 3));
    bool *const hits = hit.mutable_data(), *const belows = from_below.mutable_data();
    double *const distances = distance.mutable_data(), *const positions = position.mutable_data();
    float* const normals = normal.mutable_data();
    {
        const py::gil_scoped_release others_run;
        for (std::size_t i = 0; i < count; ++i) {
            const double *o = origin + 3 * i, *d = direction + 3 * i;
            const SurfaceRay ray{{o[0], o[1], o[2]}, {d[0], d[1], d[2]}, reaches[3 * i]};
            if (const std::string reason = check(ray, handle.frame); !reason.empty())
                throw std::invalid_argument("ray " + number_text(i) + ": " + reason);
            const std::optional<SurfaceHit> found = first_hit(surface, ray);
            hits[i] = found.has_value();
            belows[i] = found && found->from_below;
            distances[i] = found ? found->distance_m : std::numeric_limits<double>::infinity();
            for (std::size_t axis = 0; axis < 3; ++axis) {
                positions[3 * i + axis] = found ? found->position_m[axis] : std::numeric_limits<double>::quiet_NaN();
                normals[3 * i + axis] = found ? found->normal[axis] : std::numeric_limits<float>::quiet_NaN();
            }
        }
    }
    py::dict results;
    results["hit"] = hit;
    results["distance"] = distance;
    results["position"] = position;
    results["normal"] = normal;
    results["from_below"] = from_below;
    return results;
}

/// Returns the reference positions of points.
Places reference_places_of(py::handle points, py::handle z) {
    constexpr double max_m = 1e9;  // as for rays
    Places places = places_of(points, z);
    for (std::size_t i = 0; i < places.x.size(); ++i)
        for (const double at : {places.x[i], places.z[i]})
            if (!(std::fabs(at) <= max_m))
                throw std::invalid_argument("point " + number_text(i) + ": " +
                                            invalid_value_message("a coordinate", at, "[-1e9, 1e9]"));
    return places;
}

py::array_t<float> displaced(const FrameHandle& handle, py::handle points, py::handle z) {
    const auto reader = handle.read();
    need_planes(handle.frame);
    const Places places = reference_places_of(points, z);
    py::array_t<float> array(with(places.shape, 3));
    float* out = array.mutable_data();
    const py::gil_scoped_release others_run;
    for (std::size_t i = 0; i < places.x.size(); ++i) {
        const Displacement d = drawn_water(handle.frame, places.x[i], places.z[i]).displacement;
        *out++ = static_cast<float>(places.x[i] + d.dx);
        *out++ = static_cast<float>(d.height);
        *out++ = static_cast<float>(places.z[i] + d.dz);
    }
    return array;
}

/// Returns the foam of the water that has the reference position (x, z), as a query does.
float foam_at_rest(const Frame& frame, const FoamSampler& foam, double x_m, double z_m) {
    const DrawnWater drawn = drawn_water(frame, x_m, z_m);
    const auto of_place =
        static_cast<float>(foam_of_place(frame, x_m + drawn.displacement.dx, z_m + drawn.displacement.dz));
    return foam.has_foam() ? std::max(of_place, foam.at(x_m, z_m, drawn.weights)) : of_place;
}

py::array_t<float> displaced_foam(const FrameHandle& handle, py::handle points, py::handle z) {
    const auto reader = handle.read();
    if (!has_foam(handle.frame)) need_foam(handle.frame);
    need_planes(handle.frame);
    const Places places = reference_places_of(points, z);
    py::array_t<float> array(places.shape);
    float* const out = array.mutable_data();
    const py::gil_scoped_release others_run;
    const FoamSampler foam(handle.frame);
    for (std::size_t i = 0; i < places.x.size(); ++i)
        out[i] = foam_at_rest(handle.frame, foam, places.x[i], places.z[i]);
    return array;
}

}  // namespace

void add_queries(FrameClass& frame) {
    frame.def("query", &query, py::arg("points"), py::arg("z") = py::none(), py::kw_only(),
              py::arg("fields") = py::none(), py::arg("tolerance_m") = SurfaceQuery::default_tolerance_m,
              py::arg("interpolation") = "linear", doc_of("Frame.query"));
    frame.def("rays", &rays, py::arg("origins"), py::arg("directions"), py::arg("reach"), py::kw_only(),
              py::arg("tolerance_m") = SurfaceQuery::default_tolerance_m, doc_of("Frame.rays"));
    frame.def("displaced", &displaced, py::arg("points"), py::arg("z") = py::none(), doc_of("Frame.displaced"));
    frame.def("displaced_foam", &displaced_foam, py::arg("points"), py::arg("z") = py::none(),
              doc_of("Frame.displaced_foam"));
}

void add_series(OceanClass& ocean) {
    ocean.def("series", &series, py::arg("points"), py::arg("times"), py::kw_only(), py::arg("fields") = py::none(),
              py::arg("tolerance_m") = SurfaceQuery::default_tolerance_m, py::arg("interpolation") = "cubic",
              py::arg("repeats") = false, doc_of("Ocean.series"));
}

}  // namespace pelagic::python
