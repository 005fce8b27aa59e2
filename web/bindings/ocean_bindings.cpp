// The sea for JavaScript: an ocean whose frames are named by the slot that holds them, 0 or 1. package/ocean.js makes objects of it,
// says when a slot is over and copies what it hands to others; all here answers {value} or {error} (named_options.hpp).
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
#include "pelagic/web/bindings/named_options.hpp"

namespace pelagic::web {
namespace {

using emscripten::typed_memory_view;
using emscripten::val;

constexpr std::array<std::string_view, 6> ocean_option_names = {"threads",   "queries", "velocities",
                                                                "gradients", "slopes",  "foam"};

bool is_finite(double number) { return std::isfinite(number); }

/// package/module.js has seen to it that `threads` is a number that this module can have.
OceanOptions ocean_options(const val& options) {
    const auto is_wanted = [&](const char* name) {
        const val value = options[name];
        return !value.isUndefined() && flag_of(name, value);
    };
    const int threads = options["threads"].as<int>();
    return {.executor = threads > 1 ? make_thread_executor(threads) : make_serial_executor(),
            .queries = is_wanted("queries"),
            .velocities = is_wanted("velocities"),
            .gradients = is_wanted("gradients"),
            .slopes = is_wanted("slopes"),
            .foam = is_wanted("foam")};
}

template <class Number>
val view_of(std::span<const Number> numbers) {
    return numbers.empty() ? val::null() : val(typed_memory_view(numbers.size(), numbers.data()));
}

/// Texels of words, by the byte: the lowest first, as WebAssembly has it.
val bytes_of(std::span<const std::uint32_t> words) {
    return view_of(std::span(reinterpret_cast<const std::uint8_t*>(words.data()), 4 * words.size()));
}

/// All blocks of a plane; package/ocean.js knows where texels are in them.
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
    object.set("whitecapJacobian", cascade.whitecap_jacobian);
    object.set("whitecapRamp", cascade.whitecap_ramp);
    object.set("bounds", bounds_of(cascade.bounds));
    return object;
}

/// Sixteen hexadecimal digits, for JavaScript's numbers have 53 bits.
std::string hash_text(std::uint64_t hash) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text(16, '0');
    for (auto digit = text.rbegin(); digit != text.rend(); ++digit, hash >>= 4) *digit = digits[hash & 15];
    return text;
}

/// Room for the answers of a batch, as large as the largest so far.
class Answers {
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

    /// Views that hold until the next batch.
    val views(const SurfaceQuery& query) {
        val object = val::object();
        object.set("heightM", view(height_));
        object.set("normal", view(together(normals_, normal_x_, normal_y_, normal_z_)));
        object.set("jacobian", view(jacobian_));
        object.set("errorM", view(error_));
        object.set("converged", val(typed_memory_view(converged_.size(), converged_.data())));
        if (query.has_velocities())
            object.set("velocityMps", view(together(velocities_, velocity_x_, velocity_y_, velocity_z_)));
        if (query.has_foam()) object.set("foam", view(foam_));
        return object;
    }

   private:
    static val view(const std::vector<float>& numbers) {
        return val(typed_memory_view(numbers.size(), numbers.data()));
    }

    /// Three numbers a point, as pages have vectors.
    static const std::vector<float>& together(std::vector<float>& vectors, const std::vector<float>& x,
                                              const std::vector<float>& y, const std::vector<float>& z) {
        vectors.resize(3 * x.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            vectors[3 * i] = x[i];
            vectors[3 * i + 1] = y[i];
            vectors[3 * i + 2] = z[i];
        }
        return vectors;
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

class OceanOfPage {
   public:
    explicit OceanOfPage(const val& options)
        : OceanOfPage(sea_with({}, options, ocean_option_names), ocean_options(options)) {}

    val schedule(const val& time_s) {
        return answer_of([&] {
            ocean_.schedule(number_of("timeS", time_s, is_finite, "a finite number"));
            return val::undefined();
        });
    }

    bool is_ready() const { return ocean_.is_ready(); }

    /// The slot of the frame.
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
        val cascades = val::array();
        for (const Cascade& cascade : frame.cascades) cascades.call<void>("push", cascade_of(cascade));
        object.set("cascades", cascades);
        return object;
    }

    /// Views of a cascade, by name; null for what its frame doesn't have.
    val maps(int slot, int number) const {
        const Cascade& cascade = frames_[slot].cascades[static_cast<std::size_t>(number)];
        val object = val::object();
        object.set("displacement", view_of(cascade.displacement_rgba16f));
        object.set("gradients", bytes_of(cascade.gradient_rgba8));
        object.set("slopes", bytes_of(cascade.slopes_rgba8));
        object.set("moments", bytes_of(cascade.moments_rgba8));
        object.set("foam", view_of(cascade.foam_r8));
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

    /// \param points       a Float64Array of x, z, x, z, ...
    /// \param tolerance_m    a number, or undefined
    /// \param interpolation  "linear", "cubic" or undefined
    val query(int slot, const val& points, const val& tolerance_m, const val& interpolation) {
        return answer_of([&] {
            const double tolerance = tolerance_m.isUndefined()
                                         ? SurfaceQuery::default_tolerance_m
                                         : number_of(
                                               "toleranceM", tolerance_m,
                                               [](double m) { return std::isfinite(m) && m > 0; }, "metres above 0");
            const std::optional<Interpolation> named = interpolation.isUndefined() ? Interpolation::linear
                                                       : interpolation.isString()
                                                           ? interpolation_named(interpolation.as<std::string>())
                                                           : std::nullopt;
            if (!named)
                throw std::invalid_argument(
                    invalid_value_message("interpolation", text_of(interpolation), "linear or cubic"));
            const SurfaceQuery query(frames_[slot], {.tolerance_m = tolerance, .interpolation = *named});
            const auto pairs = emscripten::convertJSArrayToNumberVector<double>(points);
            const std::size_t count = pairs.size() / 2;
            xs_.resize(count);
            zs_.resize(count);
            for (std::size_t i = 0; i < count; ++i) {
                xs_[i] = pairs[2 * i];
                zs_[i] = pairs[2 * i + 1];
            }
            answers_.resize(count);
            jobs_.sample(query, {xs_, zs_}, answers_.wanted_of(query));
            return answers_.views(query);
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

    val sea() const { return options_of(ocean_.sea()); }
    double memory_bytes() const { return static_cast<double>(ocean_.memory_bytes()); }
    int threads() const { return executor_->thread_limit(); }

   private:
    OceanOfPage(const SeaState& sea, const OceanOptions& options)
        : executor_(options.executor), ocean_(sea, options), jobs_(options.executor) {}

    std::shared_ptr<Executor> executor_;
    Ocean ocean_;
    SurfaceQueryJobs jobs_;
    Frame frames_[2];
    int slot_ = 1;  ///< of the frame completed last
    std::vector<double> xs_, zs_;
    Answers answers_;
};

val create_ocean(const val& options) {
    return answer_of([&] { return std::make_shared<OceanOfPage>(options); });
}

}  // namespace

EMSCRIPTEN_BINDINGS(ocean) {
    emscripten::class_<OceanOfPage>("OceanOfPage")
        .smart_ptr<std::shared_ptr<OceanOfPage>>("OceanOfPagePointer")
        .function("schedule", &OceanOfPage::schedule)
        .function("isReady", &OceanOfPage::is_ready)
        .function("complete", &OceanOfPage::complete)
        .function("describe", &OceanOfPage::describe)
        .function("maps", &OceanOfPage::maps)
        .function("hash", &OceanOfPage::hash)
        .function("foamHash", &OceanOfPage::foam_hash)
        .function("query", &OceanOfPage::query)
        .function("firstHit", &OceanOfPage::first_hit)
        .function("scheduleSea", &OceanOfPage::schedule_sea)
        .function("seaIsReady", &OceanOfPage::sea_is_ready)
        .function("completeSea", &OceanOfPage::complete_sea)
        .function("turnInto", &OceanOfPage::turn_into)
        .function("sea", &OceanOfPage::sea)
        .function("memoryBytes", &OceanOfPage::memory_bytes)
        .function("threads", &OceanOfPage::threads);
    emscripten::function("createOcean", &create_ocean);
    emscripten::function("seaOptions", &sea_option_table);
    emscripten::function("presets", &preset_table);
}

}  // namespace pelagic::web
