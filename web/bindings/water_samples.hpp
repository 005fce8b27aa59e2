// Water at points as an object of arrays, which are copies.
#pragma once

#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "pelagic/sim/water_jobs.hpp"
#include "pelagic/web/bindings/named_options.hpp"

namespace pelagic::web {

inline emscripten::val array_of(const std::vector<float>& numbers) {
    const emscripten::val view(emscripten::typed_memory_view(numbers.size(), numbers.data()));
    return view.call<emscripten::val>("slice");
}

/// Returns x, y, z of each point.
inline emscripten::val vectors_of(const std::vector<float>& x, const std::vector<float>& y,
                                  const std::vector<float>& z) {
    std::vector<float> vectors;
    vectors.reserve(3 * x.size());
    for (std::size_t i = 0; i < x.size(); ++i) vectors.insert(vectors.end(), {x[i], y[i], z[i]});
    return array_of(vectors);
}

/// Returns each `step`th number from `first` on.
inline std::vector<double> every(const std::vector<double>& numbers, std::size_t first, std::size_t step) {
    std::vector<double> some;
    for (std::size_t i = first; i < numbers.size(); i += step) some.push_back(numbers[i]);
    return some;
}

/// \param footprint  a number of metres, or undefined
inline double footprint_of(const emscripten::val& footprint) {
    return footprint.isUndefined() ? 0
                                   : number_of(
                                         "footprintM", footprint, [](double m) { return std::isfinite(m) && m >= 0; },
                                         "0 or more");
}

/// \param points     a Float64Array of x, y, z, x, y, z, ...
/// \param footprint  a number of metres, or undefined
inline emscripten::val water_samples(WaterJobs& jobs, const WaterKinematics& water, const emscripten::val& points,
                                     const emscripten::val& footprint) {
    const auto all = emscripten::convertJSArrayToNumberVector<double>(points);
    const std::vector<double> x = every(all, 0, 3), y = every(all, 1, 3), z = every(all, 2, 3);
    std::vector<std::vector<float>> of(8, std::vector<float>(x.size()));
    jobs.sample(water, {x, y, z, footprint_of(footprint)}, {of[0], of[1], of[2], of[3], of[4], of[5], of[6], of[7]});
    emscripten::val object = emscripten::val::object();
    object.set("depthM", array_of(of[0]));
    object.set("pressurePa", array_of(of[1]));
    object.set("velocityMps", vectors_of(of[2], of[3], of[4]));
    object.set("accelerationMps2", vectors_of(of[5], of[6], of[7]));
    return object;
}

}  // namespace pelagic::web
