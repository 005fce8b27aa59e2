// The exact sum over the waves of a sea, for web/package/exact_water.js.
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cmath>
#include <memory>
#include <string_view>
#include <vector>

#include "pelagic/sim/exact_water.hpp"
#include "pelagic/sim/water_jobs.hpp"
#include "pelagic/web/bindings/named_options.hpp"
#include "pelagic/web/bindings/ocean_options.hpp"
#include "pelagic/web/bindings/water_samples.hpp"

namespace pelagic::web {
namespace {

using emscripten::val;

constexpr std::string_view exact_water_option_names[] = {"threads", "waterDensityKgpm3", "waterFrame"};

/// \pre `threads` is a number that this module supports (package/module.js)
ExactWaterOptions exact_water_options_of(const val& options) {
    ExactWaterOptions ours{.executor = make_thread_executor(options["threads"].as<int>())};
    for (const NumericField<ExactWaterOptions>& field : exact_water_fields()) {
        const std::string name = camel_case(field.name);
        if (const val value = options[name]; !value.isUndefined()) set_field(ours, field, name, value);
    }
    if (const val frame = options["waterFrame"]; !frame.isUndefined()) ours.water_frame = water_frame_of(frame);
    return ours;
}

class ExactWaterBinding {
   public:
    explicit ExactWaterBinding(const val& options)
        : ExactWaterBinding(sea_with({}, options, exact_water_option_names), exact_water_options_of(options)) {}

    val set_time(const val& time_s) {
        return answer_of([&] {
            water_.set_time(number_of(
                "timeS", time_s, [](double number) { return std::isfinite(number); }, "a finite number"));
            return val::undefined();
        });
    }

    val set_origin(const val& x_m, const val& z_m) {
        return answer_of([&] {
            const auto is_origin = [](double number) { return std::fabs(number) <= 1e8; };
            water_.set_origin(number_of("xM", x_m, is_origin, "a number in [-1e8, 1e8]"),
                              number_of("zM", z_m, is_origin, "a number in [-1e8, 1e8]"));
            return val::undefined();
        });
    }

    /// \param points     a Float64Array of x, y, z, x, y, z, ...
    /// \param footprint  a number of metres, or undefined
    val sample(const val& points, const val& footprint) {
        return answer_of([&] { return water_samples(jobs_, water_, points, footprint); });
    }

    /// \param points     a Float64Array of x, z, x, z, ...
    /// \param footprint  as above
    val sample_surface(const val& points, const val& footprint) {
        return answer_of([&] {
            const auto all = emscripten::convertJSArrayToNumberVector<double>(points);
            const std::vector<double> x = every(all, 0, 2), z = every(all, 1, 2);
            std::vector<std::vector<float>> of(7, std::vector<float>(x.size()));
            jobs_.sample_surface(water_, {x, z, footprint_of(footprint)},
                                 {.height_m = of[0],
                                  .normal_x = of[1],
                                  .normal_y = of[2],
                                  .normal_z = of[3],
                                  .velocity_x_mps = of[4],
                                  .velocity_y_mps = of[5],
                                  .velocity_z_mps = of[6]});
            val object = val::object();
            object.set("heightM", array_of(of[0]));
            object.set("normal", vectors_of(of[1], of[2], of[3]));
            object.set("velocityMps", vectors_of(of[4], of[5], of[6]));
            return object;
        });
    }

   private:
    ExactWaterBinding(const SeaState& sea, const ExactWaterOptions& options)
        : water_(sea, options), jobs_(options.executor) {}

    ExactWater water_;
    WaterJobs jobs_;
};

val create_exact_water(const val& options) {
    return answer_of([&] { return std::make_shared<ExactWaterBinding>(options); });
}

}  // namespace

EMSCRIPTEN_BINDINGS(exact_water) {
    emscripten::class_<ExactWaterBinding>("ExactWaterBinding")
        .smart_ptr<std::shared_ptr<ExactWaterBinding>>("ExactWaterBindingPointer")
        .function("setTime", &ExactWaterBinding::set_time)
        .function("setOrigin", &ExactWaterBinding::set_origin)
        .function("sample", &ExactWaterBinding::sample)
        .function("sampleSurface", &ExactWaterBinding::sample_surface);
    emscripten::function("createExactWater", &create_exact_water);
}

}  // namespace pelagic::web
