// Processor time and memory of a frame by the options of its ocean, for `pelagic bench --cost`.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/simd/isa.hpp"
#include "pelagic/tools/benchmark/frame_timing.hpp"

namespace pelagic::tools {

struct CostPlan {
    SeaState sea = {};
    Isa isa;
    double seconds = 30;  ///< total time; longer where one round of all rows takes longer
};

/// A row of the table: an ocean with some options, and what is timed.
struct OptionCost {
    std::string name;
    Quartiles warm_ms;         ///< frames one after another
    Quartiles rhythm_ms;       ///< a frame each headset_period_ms, and sleep in between
    std::size_t memory_bytes;  ///< of the ocean: two frames and the spectrum
};

/// Time from frame to frame of a display of 72 Hz.
inline constexpr double headset_period_ms = 1000.0 / 72;

/// Names of the rows: "bare", options of an ocean one by one, "hull" and "1,000 heights", which time
/// the step of a boat and a query alone, and "boat", which times all that a boat needs.
std::vector<std::string> cost_rows();

/// Measures processor time on one thread, so that other load has little effect. Times are medians and
/// quartiles over turns, which the rows take one after another. A turn has up to 72 frames: one
/// second of the sea with 60 ticks of dynamic waves and 5 of foam.
/// \param progress  called after each turn with the row and the completed fraction, 0 to 1
std::vector<OptionCost> measure_option_costs(const CostPlan& plan,
                                             const std::function<void(const std::string&, double)>& progress);

}  // namespace pelagic::tools
