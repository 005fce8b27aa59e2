#include "pelagic/tools/export/export_summary.hpp"

#include <cstdio>
#include <string>

#include "pelagic/message/number_text.hpp"
#include "pelagic/message/one_line.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/text/progress.hpp"

namespace pelagic::tools {

namespace {

/// Returns a note if the sea repeats within the export, else an empty text. A sea with transitions
/// does not repeat. An export by --loop-frames or --frames loop ends with its loop.
std::string warning_about_loop(const ExportOptions& options) {
    const FrameTimes& times = options.times;
    if (!times.fps || !options.sea.changes.empty()) return {};
    const double last_s = times.time_of(times.number(times.count() - 1));
    const double span_s = last_s + 1 / *times.fps - times.time_of(times.number(0));
    constexpr double rounding = 1e-9;
    if (span_s <= times.loop_period_s * (1 + rounding)) return {};
    return "the frames span " + rounded_text(span_s, 6) + " s, and the sea repeats after its loop of " +
           rounded_text(times.loop_period_s, 6) + " s; a --loop-period of at least " + rounded_text(span_s, 6) +
           " repeats nothing";
}

}  // namespace

void print_summary(std::FILE* to, const ExportOptions& options, const ExportSummary& summary) {
    std::fprintf(to, "%s: ", escaped(options.folder.string()).c_str());
    if (options.shard) std::fprintf(to, "shard %s, ", text_of(*options.shard).c_str());
    std::fprintf(to, "%zu frame%s", summary.frames, summary.frames == 1 ? "" : "s");
    if (options.resume) std::fprintf(to, " (%zu of them kept)", summary.kept);
    const SeaState& sea = options.sea.sea;
    const std::string_view waves = sea.waves == WaveModel::spectrum ? name_of(sea.spectrum) : name_of(sea.waves);
    std::fprintf(to, ", %s sea, ", std::string(waves).c_str());
    if (summary.frames > 0)
        std::fprintf(to, "Hs %.2f m, ", summary.height_sum_m / static_cast<double>(summary.frames));
    std::fprintf(to, "peak period %s\n",
                 peak_period_text(expected_waves(sea).peak_period_s, sea.loop_period_s, 3).c_str());
}

void print_notes(const ExportOptions& options) {
    if (options.shard) return;
    const SeaState& sea = options.sea.sea;
    for (const std::string& warning : warnings_about(sea)) print_note(warning);
    print_weather_note(options.sea);
    if (const std::string warning = warning_about_loop(options); !warning.empty()) print_note(warning);
    if (options.events)
        for (const std::string& warning : warnings_about(*options.events, !options.times.fps)) print_note(warning);
    if (const SeaPatch& patch = options.meshes.patch;
        options.meshes.any() && patch.cascades < static_cast<std::size_t>(cascades_of(sea)))
        print_note("the mesh's steps of " + rounded_text(patch.side_m / patch.steps, 3) +
                   " m show the waves of the coarsest " + number_text(patch.cascades) + " of " +
                   number_text(cascades_of(sea)) +
                   " cascades; a smaller --mesh-size or more --mesh-steps show shorter waves");
}

}  // namespace pelagic::tools
