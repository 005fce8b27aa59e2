// The modules of the page bench/: rows of `pelagic bench --headset` and `--cost`. Calls block, so a
// worker makes them; Module.progress receives what is measured, and the completed fraction.
//
//   frameRows(sea, threads, seconds)  times frames of a sea on 1 to `threads` threads; returns a row
//                                     for each, or null if there are fewer seas
//   costRows(seconds)                 times the default sea by option, on one thread
//   version()                         returns "1.0.0" and so on
//   frameHash(timeS)                  returns the hash of a frame of the default sea
//
// Rows have the keys of `--json`. Workers of threads return to their pool between calls, when the
// calling worker has no other task.
#include <emscripten.h>
#include <emscripten/bind.h>
#include <emscripten/val.h>

#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/benchmark/frame_timing.hpp"
#include "pelagic/tools/benchmark/option_cost.hpp"

using emscripten::val;

// clang-format off
EM_JS(void, pelagic_show_progress, (const char* row, double fraction), {
    if (Module['progress']) Module['progress'](UTF8ToString(row), fraction);
});
// clang-format on

namespace pelagic::web {
namespace {

using namespace tools;

void show_progress(const std::string& row, double fraction) { pelagic_show_progress(row.c_str(), fraction); }

val quartiles_as_array(const Quartiles& ms) {
    val array = val::array();
    array.call<void>("push", ms.low);
    array.call<void>("push", ms.high);
    return array;
}

val frame_row(const FrameTiming& frame) {
    val row = val::object();
    row.set("cascades", frame.cascades);
    row.set("n", frame.resolution);
    row.set("threads", frame.threads);
    row.set("ours_ms", frame.ms.median);
    row.set("ours_ms_quartiles", quartiles_as_array(frame.ms));
    row.set("memory_bytes", static_cast<double>(frame.memory_bytes));
    row.set("upload_bytes", static_cast<double>(frame.upload_bytes));
    return row;
}

val cost_row(const OptionCost& cost, const OptionCost& bare) {
    val row = val::object();
    row.set("option", cost.name);
    row.set("warm_ms", cost.warm_ms.median);
    row.set("warm_ms_quartiles", quartiles_as_array(cost.warm_ms));
    row.set("rhythm_ms", cost.rhythm_ms.median);
    row.set("rhythm_ms_quartiles", quartiles_as_array(cost.rhythm_ms));
    row.set("warm_ratio", cost.warm_ms.median / bare.warm_ms.median);
    row.set("rhythm_ratio", cost.rhythm_ms.median / bare.rhythm_ms.median);
    row.set("memory_bytes", static_cast<double>(cost.memory_bytes));
    return row;
}

val frame_rows(int sea, int threads, double seconds) {
    const std::vector<SeaState> seas = headset_seas();
    if (sea < 0 || sea >= static_cast<int>(seas.size())) return val::null();
    TimingPlan plan{.seas = {seas[static_cast<std::size_t>(sea)]}, .isas = isas_here(), .seconds = seconds};
    plan.threads.resize(static_cast<std::size_t>(threads));
    std::iota(plan.threads.begin(), plan.threads.end(), 1);
    val rows = val::array();
    for (const FrameTiming& frame : time_frames(plan, show_progress).frames)
        rows.call<void>("push", frame_row(frame));
    return rows;
}

val cost_rows_within(double seconds) {
    const std::vector<OptionCost> costs =
        measure_option_costs({.isa = isas_here().back(), .seconds = seconds}, show_progress);
    val rows = val::array();
    for (const OptionCost& cost : costs) rows.call<void>("push", cost_row(cost, costs.front()));
    return rows;
}

std::string version() { return PELAGIC_VERSION; }

std::string frame_hash(double time_s) {
    Ocean ocean(SeaState{}, {.executor = make_serial_executor()});
    char text[17];
    std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(hash_of(ocean.frame_at(time_s))));
    return text;
}

}  // namespace

EMSCRIPTEN_BINDINGS(bench) {
    emscripten::function("frameRows", &frame_rows);
    emscripten::function("costRows", &cost_rows_within);
    emscripten::function("frameHash", &frame_hash);
    emscripten::function("version", &version);
}

}  // namespace pelagic::web
