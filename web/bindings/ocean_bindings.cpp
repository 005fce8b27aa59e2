// The module of an ocean for JavaScript. The ocean holds two frames, in slots 0 and 1.
// package/ocean.js wraps them in classes, checks whether a frame is still valid and copies results
// of queries. Functions that may fail return {value} or {error} (named_options.hpp).
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/sim/water_query.hpp"
#include "pelagic/web/bindings/named_options.hpp"
#include "pelagic/web/bindings/ocean_options.hpp"
#include "pelagic/web/bindings/water_samples.hpp"

namespace pelagic::web {
namespace {

using emscripten::typed_memory_view;
using emscripten::val;

constexpr std::string_view ocean_option_names[] = {
    // generated from schema/ocean.toml: property-names
    "threads",
    "queries",
    "velocities",
    "depth",
    "gradients",
    "slopes",
    "foam",
    "dynamicWaves",
    "shore",
    "spray",
    "inputs",
    // end of generated
};

bool is_finite(double number) { return std::isfinite(number); }

std::vector<OceanInput> inputs_of(const val& options) {
    const val inputs = options["inputs"];
    std::vector<OceanInput> ours;
    if (inputs.isUndefined()) return ours;
    if (!inputs.isArray()) throw std::invalid_argument(invalid_value_message("inputs", text_of(inputs), "an array"));
    for (int i = 0, count = inputs["length"].as<int>(); i < count; ++i)
        ours.push_back(input_of("inputs[" + number_text(i) + "]", inputs[i]));
    return ours;
}

/// Converts true, false or a name.
Velocities velocities_of(const val& value) {
    if (value.isUndefined()) return Velocities::none;
    if (value.isString())
        if (const auto named = value_named<Velocities>(value.as<std::string>())) return *named;
    if (!value.isTrue() && !value.isFalse())
        throw std::invalid_argument(
            invalid_value_message("velocities", text_of(value), "true, false, none, drawn or water"));
    return value.isTrue() ? Velocities::drawn : Velocities::none;
}

/// \pre `threads` is a number that this module supports (package/module.js)
OceanOptions ocean_options(const val& options, const SeaState& sea, const std::vector<OceanInput>& inputs) {
    const auto is_wanted = [&](const char* name) {
        const val value = options[name];
        return !value.isUndefined() && flag_of(name, value);
    };
    const auto textures = [&](const char* name) {
        const val value = options[name];
        return value.isUndefined() ? std::nullopt : std::optional(flag_of(name, value));
    };
    const int threads = options["threads"].as<int>();
    OceanOptions ours{.executor = threads > 1 ? make_thread_executor(threads) : make_serial_executor(),
                      .queries = is_wanted("queries"),
                      .velocities = velocities_of(options["velocities"]),
                      .depth = is_wanted("depth"),
                      .gradients = textures("gradients"),
                      .slopes = textures("slopes"),
                      .foam = is_wanted("foam")};
    if (const val waves = options["dynamicWaves"]; !waves.isUndefined())
        ours.dynamic_waves = dynamic_waves_options_of(waves);
    if (const val spray = options["spray"]; !spray.isUndefined()) ours.spray = spray_options_of(spray);
    if (const val shore = options["shore"]; !shore.isUndefined()) ours.shore = shore_options_of(shore, sea);
    for (const OceanInput& input : inputs)
        ours.inputs.push_back(input.waves ? std::shared_ptr<WaveInput>(input.waves) : input.ripple);
    return ours;
}

template <class Number>
val view_of(std::span<const Number> numbers) {
    return numbers.empty() ? val::null() : val(typed_memory_view(numbers.size(), numbers.data()));
}

/// Returns a view of the words' bytes, which are little-endian in WebAssembly.
val bytes_of(std::span<const std::uint32_t> words) {
    return view_of(std::span(reinterpret_cast<const std::uint8_t*>(words.data()), 4 * words.size()));
}

/// Returns a view of all blocks of a plane, and their layout.
val plane_of(const PlaneView& plane) {
    if (!plane.data) return val::null();
    const std::ptrdiff_t last = plane.resolution - 1;
    const std::ptrdiff_t floats =
        last / plane.block_columns * plane.block_stride + last * plane.row_stride + last % plane.block_columns + 1;
    val whole = val::object();
    whole.set("data", val(typed_memory_view(static_cast<std::size_t>(floats), plane.data)));
    whole.set("resolution", plane.resolution);
    whole.set("blockColumns", plane.block_columns);
    whole.set("rowStride", static_cast<double>(plane.row_stride));
    whole.set("blockStride", static_cast<double>(plane.block_stride));
    return whole;
}

val bounds_of(const FrameBounds& bounds) {
    val object = val::object();
    object.set("heightMinM", bounds.height_min_m);
    object.set("heightMaxM", bounds.height_max_m);
    object.set("horizontalXMaxM", bounds.horizontal_x_max_m);
    object.set("horizontalZMaxM", bounds.horizontal_z_max_m);
    return object;
}

/// Returns an array of JavaScript. Versions count from 1, so doubles hold them exactly.
template <class Number>
val numbers_of(std::span<const Number> numbers) {
    val array = val::array();
    for (const Number number : numbers) array.call<void>("push", static_cast<double>(number));
    return array;
}

val variance_of(const SlopeVariance& variance) {
    val object = val::object();
    object.set("upwind", variance.upwind);
    object.set("crosswind", variance.crosswind);
    return object;
}

val statistics_of(const SeaStatistics& statistics) {
    val object = val::object();
    object.set("significantWaveHeightM", statistics.significant_wave_height_m);
    object.set("resolvedSlopes", variance_of(statistics.resolved_slopes));
    object.set("unresolvedSlopes", variance_of(statistics.unresolved_slopes));
    object.set("roughness", statistics.roughness);
    object.set("foamDriftXMps", statistics.foam_drift_x_mps);
    object.set("foamDriftZMps", statistics.foam_drift_z_mps);
    object.set("foamLevel", statistics.foam_level);
    return object;
}

val cascade_of(const Cascade& cascade) {
    val object = val::object();
    object.set("sideM", cascade.grid.side_m);
    object.set("cosine", cascade.grid.cosine);
    object.set("sine", cascade.grid.sine);
    object.set("resolution", cascade.resolution());
    object.set("slopeRange", cascade.slope_ranges.slope);
    object.set("varianceRange", cascade.slope_ranges.variance);
    object.set("slopeVariance", cascade.slope_variance);
    object.set("makesWhitecaps", cascade.makes_whitecaps());
    object.set("compressionScale", cascade.compression_scale);
    object.set("compressionFrontX", cascade.compression_front_x);
    object.set("compressionFrontZ", cascade.compression_front_z);
    object.set("driftColumns", cascade.drift_columns);
    object.set("driftRows", cascade.drift_rows);
    object.set("snapshotsVersion", numbers_of<std::uint64_t>(cascade.snapshots_version));
    object.set("bounds", bounds_of(cascade.bounds));
    return object;
}

/// Returns sixteen hexadecimal digits: a JavaScript number holds only 53 bits.
std::string hash_text(std::uint64_t hash) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text(16, '0');
    for (auto digit = text.rbegin(); digit != text.rend(); ++digit, hash >>= 4) *digit = digits[hash & 15];
    return text;
}

SurfaceQueryOptions query_options_of(const val& tolerance_m, const val& interpolation) {
    const double tolerance =
        tolerance_m.isUndefined()
            ? SurfaceQuery::default_tolerance_m
            : number_of(
                  "toleranceM", tolerance_m, [](double m) { return std::isfinite(m) && m > 0; }, "metres above 0");
    const std::optional<Interpolation> named =
        interpolation.isUndefined() ? Interpolation::linear
        : interpolation.isString()  ? value_named<Interpolation>(interpolation.as<std::string>())
                                    : std::nullopt;
    if (!named)
        throw std::invalid_argument(
            invalid_value_message("interpolation", text_of(interpolation), "linear or cubic"));
    return {.tolerance_m = tolerance, .interpolation = *named};
}

/// Arrays for the samples of a batch, of the size of the largest batch.
class SampleBuffers {
   public:
    void resize(std::size_t points) {
        for (std::vector<float>* numbers : {&height_, &normal_x_, &normal_y_, &normal_z_, &jacobian_, &error_,
                                            &velocity_x_, &velocity_y_, &velocity_z_, &foam_})
            numbers->resize(points);
        converged_.resize(points);
    }

    SurfaceSamples wanted_of(const SurfaceQuery& query) {
        SurfaceSamples samples{.height_m = height_,
                               .normal_x = normal_x_,
                               .normal_y = normal_y_,
                               .normal_z = normal_z_,
                               .jacobian = jacobian_,
                               .error_m = error_,
                               .converged = converged_};
        if (query.has_velocities()) {
            samples.velocity_x_mps = velocity_x_;
            samples.velocity_y_mps = velocity_y_;
            samples.velocity_z_mps = velocity_z_;
        }
        if (query.has_foam()) samples.foam = foam_;
        return samples;
    }

    /// Returns views, valid until the next batch.
    val views(const SurfaceQuery& query) {
        // All arrays are filled before the first view is made: growing memory empties views.
        interleave(normals_, normal_x_, normal_y_, normal_z_);
        if (query.has_velocities()) interleave(velocities_, velocity_x_, velocity_y_, velocity_z_);
        val object = val::object();
        object.set("heightM", view(height_));
        object.set("normal", view(normals_));
        object.set("jacobian", view(jacobian_));
        object.set("errorM", view(error_));
        object.set("converged", val(typed_memory_view(converged_.size(), converged_.data())));
        if (query.has_velocities()) object.set("velocityMps", view(velocities_));
        if (query.has_foam()) object.set("foam", view(foam_));
        return object;
    }

   private:
    static val view(const std::vector<float>& numbers) {
        return val(typed_memory_view(numbers.size(), numbers.data()));
    }

    /// Writes x, y, z of each point.
    static void interleave(std::vector<float>& vectors, const std::vector<float>& x, const std::vector<float>& y,
                           const std::vector<float>& z) {
        vectors.resize(3 * x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            vectors[3 * i] = x[i];
            vectors[3 * i + 1] = y[i];
            vectors[3 * i + 2] = z[i];
        }
    }

    std::vector<float> height_, normal_x_, normal_y_, normal_z_, jacobian_, error_, velocity_x_, velocity_y_,
        velocity_z_, foam_;
    std::vector<float> normals_, velocities_;
    std::vector<std::uint8_t> converged_;
};

std::array<double, 3> vector_of(const std::string& name, const val& value) {
    std::array<double, 3> vector{};
    constexpr const char* accepted = "three numbers, [x, y, z]";
    const val length = value.isUndefined() || value.isNull() ? val::undefined() : value["length"];
    if (!length.isNumber() || length.as<double>() != 3)
        throw std::invalid_argument(invalid_value_message(name, text_of(value), accepted));
    for (int i = 0; i < 3; ++i)
        vector[static_cast<std::size_t>(i)] =
            number_of(name + "[" + number_text(i) + "]", value[i], is_finite, "a finite number");
    return vector;
}

std::uint32_t source_number_of(const val& number) {
    const auto accepts = [](double n) { return n >= 0 && n <= double{UINT32_MAX} && std::trunc(n) == n; };
    return static_cast<std::uint32_t>(number_of("number", number, accepts, "a number that addSource() returned"));
}

class OceanBinding {
   public:
    explicit OceanBinding(const val& options)
        : OceanBinding(sea_with({}, options, ocean_option_names), options, inputs_of(options)) {}

    val schedule(const val& time_s) {
        return answer_of([&] {
            ocean_.schedule(number_of("timeS", time_s, is_finite, "a finite number"));
            return val::undefined();
        });
    }

    bool is_ready() const { return ocean_.is_ready(); }

    /// Returns the slot of the frame.
    val complete() {
        return answer_of([&] {
            const Frame& frame = ocean_.complete();
            slot_ = 1 - slot_;
            frames_[slot_] = frame;
            return slot_;
        });
    }

    val describe(int slot) const {
        const Frame& frame = frames_[slot];
        val object = val::object();
        object.set("timeS", frame.time_s);
        object.set("sea", options_of(frame.sea));
        object.set("statistics", statistics_of(frame.statistics));
        object.set("isa", std::string(name_of(frame.isa)));
        object.set("bounds", bounds_of(frame.bounds));
        object.set("snapshotAges", numbers_of<float>(frame.foam.age));
        val cascades = val::array();
        for (const Cascade& cascade : frame.cascades) cascades.call<void>("push", cascade_of(cascade));
        object.set("cascades", cascades);
        return object;
    }

    /// Returns views of a cascade, by name; null for those that its frame does not have.
    val maps(int slot, int number) const {
        const Cascade& cascade = frames_[slot].cascades[static_cast<std::size_t>(number)];
        val object = val::object();
        object.set("displacement", view_of(cascade.displacement_rgba16f));
        object.set("gradients", bytes_of(cascade.gradient_rgba8));
        object.set("slopes", bytes_of(cascade.slopes_rgba8));
        object.set("moments", bytes_of(cascade.moments_rgba8));
        object.set("compression", view_of(cascade.compression_r8));
        val snapshots = val::null();
        if (!cascade.snapshots_rgba8[0].empty()) {
            snapshots = val::array();
            for (const auto image : cascade.snapshots_rgba8) snapshots.call<void>("push", bytes_of(image));
        }
        object.set("snapshots", snapshots);
        object.set("dx", plane_of(cascade.dx));
        object.set("height", plane_of(cascade.height));
        object.set("dz", plane_of(cascade.dz));
        object.set("velocityX", plane_of(cascade.velocity_x));
        object.set("velocityY", plane_of(cascade.velocity_y));
        object.set("velocityZ", plane_of(cascade.velocity_z));
        return object;
    }

    std::string hash(int slot) const { return hash_text(hash_of(frames_[slot])); }
    std::string foam_hash(int slot) const { return hash_text(foam_hash_of(frames_[slot])); }

    /// \param points   a Float64Array of x, y, z, x, y, z, ...
    /// \param options  an object with toleranceM, interpolation, footprintM and waterDensityKgpm3, each
    ///                 of which may be undefined
    val sample_water(int slot, const val& points, const val& options) {
        return answer_of([&] {
            WaterQueryOptions ours{.surface = query_options_of(options["toleranceM"], options["interpolation"])};
            if (const val density = options["waterDensityKgpm3"]; !density.isUndefined())
                ours.water_density_kgpm3 = number_of(
                    "waterDensityKgpm3", density, [](double it) { return it >= 500 && it <= 2000; }, "[500, 2000]");
            return water_samples(water_jobs_, WaterQuery(frames_[slot], ours), points, options["footprintM"]);
        });
    }

    /// \param points         a Float64Array of x, z, x, z, ...
    /// \param tolerance_m    a number, or undefined
    /// \param interpolation  "linear", "cubic" or undefined
    /// \param footprint      a number of metres, or undefined
    val query(int slot, const val& points, const val& tolerance_m, const val& interpolation, const val& footprint) {
        return answer_of([&] {
            const SurfaceQuery query(frames_[slot], query_options_of(tolerance_m, interpolation));
            const auto pairs = emscripten::convertJSArrayToNumberVector<double>(points);
            const std::size_t count = pairs.size() / 2;
            xs_.resize(count);
            zs_.resize(count);
            for (std::size_t i = 0; i < count; ++i) {
                xs_[i] = pairs[2 * i];
                zs_[i] = pairs[2 * i + 1];
            }
            samples_.resize(count);
            jobs_.sample(query, {xs_, zs_, footprint_of(footprint)}, samples_.wanted_of(query));
            return samples_.views(query);
        });
    }

    val first_hit(int slot, const val& ray) const {
        return answer_of([&] {
            const SurfaceQuery query(frames_[slot]);
            const SurfaceRay asked{.origin_m = vector_of("originM", ray["originM"]),
                                   .direction = vector_of("direction", ray["direction"]),
                                   .reach_m = number_of("reachM", ray["reachM"], is_finite, "metres")};
            if (const std::string reason = check(asked, frames_[slot]); !reason.empty())
                throw std::invalid_argument(camel_case(reason));
            const std::optional<SurfaceHit> hit = pelagic::first_hit(query, asked);
            if (!hit) return val::null();
            val object = val::object();
            object.set("distanceM", hit->distance_m);
            object.set("fromBelow", hit->from_below);
            val position = val::array(), normal = val::array();
            for (std::size_t i = 0; i < 3; ++i) {
                position.call<void>("push", hit->position_m[i]);
                normal.call<void>("push", hit->normal[i]);
            }
            object.set("positionM", position);
            object.set("normal", normal);
            return object;
        });
    }

    val set_water_frame(const val& water) {
        return answer_of([&] {
            ocean_.set_water_frame(water_frame_of(water));
            return val::undefined();
        });
    }

    val set_origin(const val& x_m, const val& z_m) {
        return answer_of([&] {
            const auto is_origin = [](double number) { return std::fabs(number) <= 1e8; };
            ocean_.set_origin(number_of("xM", x_m, is_origin, "a number in [-1e8, 1e8]"),
                              number_of("zM", z_m, is_origin, "a number in [-1e8, 1e8]"));
            return val::undefined();
        });
    }

    val schedule_sea(const val& options) {
        return answer_of([&] {
            ocean_.schedule_sea(sea_with(ocean_.sea(), options));
            return val::undefined();
        });
    }
    bool sea_is_ready() const { return ocean_.sea_is_ready(); }
    val complete_sea() {
        return answer_of([&] {
            ocean_.complete_sea();
            return val::undefined();
        });
    }

    /// \param when  {fromS, overS}
    val turn_into(const val& options, const val& when) {
        return answer_of([&] {
            const double from_s = number_of("fromS", when["fromS"], is_finite, "seconds");
            const double over_s = number_of(
                "overS", when["overS"], [](double s) { return s > 0 && s <= 1e9; }, "seconds in (0, 1e9]");
            ocean_.schedule_sea(sea_with(ocean_.sea(), options), from_s, over_s);
            return val::undefined();
        });
    }

    /// Returns views of the frame's dynamic waves, or null if it has none.
    val dynamic_waves_view(int slot) const {
        const DynamicWavesView& view = frames_[slot].dynamic_waves;
        if (!view) return val::null();
        val object = val::object();
        object.set("resolution", view.resolution);
        object.set("texelM", view.texel_m);
        object.set("firstX", static_cast<double>(view.first_x));
        object.set("firstZ", static_cast<double>(view.first_z));
        object.set("heightM", view_of(view.height_m));
        object.set("verticalVelocityMps", view_of(view.vertical_velocity_mps));
        object.set("foam", view_of(view.foam));
        object.set("heightMinM", view.bounds.height_min_m);
        object.set("heightMaxM", view.bounds.height_max_m);
        return object;
    }
    std::string dynamic_waves_hash(int slot) const { return hash_text(hash_of(frames_[slot].dynamic_waves)); }

    /// Returns views of the frame's shore, or null if it has none.
    val shore(int slot) const {
        const ShoreSurface& surface = frames_[slot].shore;
        if (!surface) return val::null();
        val object = val::object();
        object.set("columns", surface.columns);
        object.set("rows", surface.rows);
        object.set("texelM", surface.texel_m);
        object.set("xM", surface.x_m);
        object.set("zM", surface.z_m);
        object.set("depthM", view_of(surface.depth_m));
        object.set("weightsRgba8", bytes_of(surface.weights_rgba8));
        object.set("heightM", view_of(surface.height_m));
        object.set("verticalVelocityMps", view_of(surface.vertical_velocity_mps));
        object.set("potentialM2ps", view_of(surface.potential_m2ps));
        object.set("reachM", view_of(surface.reach_m));
        object.set("foam", view_of(surface.foam));
        object.set("heightMinM", surface.bounds.height_min_m);
        object.set("heightMaxM", surface.bounds.height_max_m);
        object.set("weightsChangePerM", surface.weights_change_per_m);
        return object;
    }
    std::string shore_hash(int slot) const { return hash_text(shore_hash_of(frames_[slot])); }

    val dynamic_waves_options() {
        return with_waves([](DynamicWaves& waves) { return options_of(waves.options()); });
    }
    val add_impulse(const val& disturbance) {
        return with_waves([&](DynamicWaves& waves) {
            waves.add_impulse(disturbance_of(disturbance));
            return val::undefined();
        });
    }
    val add_source(const val& source) {
        return with_waves([&](DynamicWaves& waves) { return waves.add_source(disturbance_of(source)); });
    }
    val set_source(const val& number, const val& source) {
        return with_waves([&](DynamicWaves& waves) {
            waves.set_source(source_number_of(number), disturbance_of(source));
            return val::undefined();
        });
    }
    val remove_source(const val& number) {
        return with_waves([&](DynamicWaves& waves) {
            waves.remove_source(source_number_of(number));
            return val::undefined();
        });
    }
    val set_center(const val& x_m, const val& z_m) {
        return with_waves([&](DynamicWaves& waves) {
            waves.set_center(number_of("xM", x_m, is_finite, "a finite number"),
                             number_of("zM", z_m, is_finite, "a finite number"));
            return val::undefined();
        });
    }
    val set_rain(const val& rain) {
        return with_waves([&](DynamicWaves& waves) {
            waves.set_rain(rain_of(rain, waves.options()));
            return val::undefined();
        });
    }
    /// Returns a copy in memory of JavaScript.
    val save_state() {
        return with_waves([](DynamicWaves& waves) {
            const std::vector<std::uint8_t> saved = waves.save_state();
            return val(typed_memory_view(saved.size(), saved.data())).call<val>("slice");
        });
    }
    val restore_state(const val& saved) {
        return with_waves([&](DynamicWaves& waves) {
            if (!saved.instanceof (val::global("Uint8Array")))
                throw std::invalid_argument(
                    invalid_value_message("saved", text_of(saved), "a Uint8Array that saveState() returned"));
            waves.restore_state(emscripten::convertJSArrayToNumberVector<std::uint8_t>(saved));
            return val::undefined();
        });
    }

    /// Returns the bytes of the frame's droplets, SprayDroplet each.
    val droplets(int slot) {
        return with_spray([&](Ocean&) {
            const auto bytes = std::as_bytes(frames_[slot].droplets);
            return val(typed_memory_view(bytes.size(), reinterpret_cast<const std::uint8_t*>(bytes.data())));
        });
    }
    val spray_hash(int slot) {
        return with_spray([&](Ocean&) { return val(hash_text(spray_hash_of(frames_[slot]))); });
    }
    val set_spray_center(const val& x_m, const val& z_m) {
        return with_spray([&](Ocean& ocean) {
            ocean.set_spray_center(number_of("xM", x_m, is_finite, "a finite number"),
                                   number_of("zM", z_m, is_finite, "a finite number"));
            return val::undefined();
        });
    }
    val emit(const val& emitters) {
        return with_spray([&](Ocean& ocean) {
            if (!emitters.isArray())
                throw std::invalid_argument(invalid_value_message("emitters", text_of(emitters), "an array"));
            std::vector<SprayEmitter> ours;
            for (int i = 0, count = emitters["length"].as<int>(); i < count; ++i)
                ours.push_back(emitter_of("emitters[" + number_text(i) + "]", emitters[i]));
            ocean.emit(ours);
            return val::undefined();
        });
    }
    val save_spray() {
        return with_spray([](Ocean& ocean) {
            const std::vector<std::uint8_t> saved = ocean.save_spray();
            return val(typed_memory_view(saved.size(), saved.data())).call<val>("slice");
        });
    }
    val restore_spray(const val& saved) {
        return with_spray([&](Ocean& ocean) {
            if (!saved.instanceof (val::global("Uint8Array")))
                throw std::invalid_argument(
                    invalid_value_message("saved", text_of(saved), "a Uint8Array that saveSpray() returned"));
            ocean.restore_spray(emscripten::convertJSArrayToNumberVector<std::uint8_t>(saved));
            return val::undefined();
        });
    }

    val set_input(const val& index, const val& input) {
        return answer_of([&] {
            if (inputs_.empty())
                throw std::invalid_argument("the ocean has no wave inputs: give it the option inputs");
            const auto any = [](double) { return true; };
            const std::string accepted = "a whole number from 0 to " + number_text(inputs_.size() - 1);
            const double i = number_of("index", index, any, accepted);
            if (!(i >= 0 && i < static_cast<double>(inputs_.size()) && std::trunc(i) == i))
                throw std::invalid_argument(invalid_value_message("index", i, accepted));
            web::set_input(inputs_[static_cast<std::size_t>(i)], "input", input);
            return val::undefined();
        });
    }

    val sea() const { return options_of(ocean_.sea()); }
    double memory_bytes() const { return static_cast<double>(ocean_.memory_bytes()); }
    int threads() const { return executor_->thread_limit(); }

   private:
    OceanBinding(const SeaState& sea, const val& options, const std::vector<OceanInput>& inputs)
        : OceanBinding(sea, ocean_options(options, sea, inputs), inputs) {}
    OceanBinding(const SeaState& sea, const OceanOptions& options, const std::vector<OceanInput>& inputs)
        : executor_(options.executor),
          has_dynamic_waves_(options.dynamic_waves),
          has_spray_(options.spray),
          inputs_(inputs),
          ocean_(sea, options),
          jobs_(options.executor),
          water_jobs_(options.executor) {}

    template <class Work>
    val with_waves(Work work) {
        return answer_of([&] {
            if (!has_dynamic_waves_)
                throw std::invalid_argument("the ocean has no dynamic waves: give it the option dynamicWaves");
            return work(ocean_.dynamic_waves());
        });
    }

    template <class Work>
    val with_spray(Work work) {
        return answer_of([&] {
            if (!has_spray_) throw std::invalid_argument("the ocean has no spray: give it the option spray");
            return work(ocean_);
        });
    }

    std::shared_ptr<Executor> executor_;
    bool has_dynamic_waves_, has_spray_;
    std::vector<OceanInput> inputs_;
    Ocean ocean_;
    SurfaceQueryJobs jobs_;
    WaterJobs water_jobs_;
    Frame frames_[2];
    int slot_ = 1;  ///< of the frame completed last
    std::vector<double> xs_, zs_;
    SampleBuffers samples_;
};

val create_ocean(const val& options) {
    return answer_of([&] { return std::make_shared<OceanBinding>(options); });
}

}  // namespace

EMSCRIPTEN_BINDINGS(ocean) {
    emscripten::class_<OceanBinding>("OceanBinding")
        .smart_ptr<std::shared_ptr<OceanBinding>>("OceanBindingPointer")
        .function("schedule", &OceanBinding::schedule)
        .function("isReady", &OceanBinding::is_ready)
        .function("complete", &OceanBinding::complete)
        .function("describe", &OceanBinding::describe)
        .function("maps", &OceanBinding::maps)
        .function("hash", &OceanBinding::hash)
        .function("foamHash", &OceanBinding::foam_hash)
        .function("query", &OceanBinding::query)
        .function("sampleWater", &OceanBinding::sample_water)
        .function("firstHit", &OceanBinding::first_hit)
        .function("setWaterFrame", &OceanBinding::set_water_frame)
        .function("setOrigin", &OceanBinding::set_origin)
        .function("scheduleSea", &OceanBinding::schedule_sea)
        .function("seaIsReady", &OceanBinding::sea_is_ready)
        .function("completeSea", &OceanBinding::complete_sea)
        .function("turnInto", &OceanBinding::turn_into)
        .function("dynamicWaves", &OceanBinding::dynamic_waves_view)
        .function("dynamicWavesHash", &OceanBinding::dynamic_waves_hash)
        .function("shore", &OceanBinding::shore)
        .function("shoreHash", &OceanBinding::shore_hash)
        .function("dynamicWavesOptions", &OceanBinding::dynamic_waves_options)
        .function("addImpulse", &OceanBinding::add_impulse)
        .function("addSource", &OceanBinding::add_source)
        .function("setSource", &OceanBinding::set_source)
        .function("removeSource", &OceanBinding::remove_source)
        .function("setCenter", &OceanBinding::set_center)
        .function("setRain", &OceanBinding::set_rain)
        .function("saveState", &OceanBinding::save_state)
        .function("restoreState", &OceanBinding::restore_state)
        .function("droplets", &OceanBinding::droplets)
        .function("sprayHash", &OceanBinding::spray_hash)
        .function("setSprayCenter", &OceanBinding::set_spray_center)
        .function("emit", &OceanBinding::emit)
        .function("saveSpray", &OceanBinding::save_spray)
        .function("restoreSpray", &OceanBinding::restore_spray)
        .function("setInput", &OceanBinding::set_input)
        .function("sea", &OceanBinding::sea)
        .function("memoryBytes", &OceanBinding::memory_bytes)
        .function("threads", &OceanBinding::threads);
    emscripten::function("createOcean", &create_ocean);
    emscripten::function("seaOptions", &sea_option_table);
    emscripten::function("optionTables", &ocean_option_tables);
    emscripten::function("presets", &preset_table);
}

}  // namespace pelagic::web
