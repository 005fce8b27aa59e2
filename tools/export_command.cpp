#include "pelagic/tools/export_command.hpp"

#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <vector>

#include "pelagic/jobs/chrome_trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/errors.hpp"
#include "pelagic/tools/export_journal.hpp"
#include "pelagic/tools/folder_lock.hpp"
#include "pelagic/tools/frame_writer.hpp"
#include "pelagic/tools/output_folder.hpp"
#include "pelagic/tools/progress.hpp"
#include "pelagic/tools/stop_signal.hpp"

namespace pelagic::tools {
namespace {

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw FileError("can't write " + folder.string() + ": " + error.message());
}

/// Computes and writes the frames that `records` lacks.
void make_frames(const ExportOptions& options, const OutputFolder& folder, ExportJournal& journal,
                 std::map<int, FrameRecord>& records, const std::shared_ptr<ChromeTrace>& trace) {
    std::vector<int> missing;
    for (int frame = 0; frame < options.frames; ++frame)
        if (!records.contains(frame)) missing.push_back(frame);
    if (missing.empty()) return;

    Ocean ocean(forecast_of(options.sea), {.executor = make_default_executor(options.compute.threads),
                                           .isa = options.compute.isa,
                                           .trace = trace,
                                           .gradients = options.gradient,
                                           .foam = options.foam});
    Progress progress("frame", missing.size());
    FrameWriter writer(options, folder, journal, records, trace.get());
    ocean.schedule(options.time_of(missing.front()));
    for (std::size_t i = 0; i < missing.size(); ++i) {
        if (stop_signal() != 0) {
            writer.finish();
            throw Stopped{stop_signal(), static_cast<int>(records.size()), options.frames};
        }
        progress.show(i);
        const Frame& frame = ocean.complete();
        if (i + 1 < missing.size()) ocean.schedule(options.time_of(missing[i + 1]));
        writer.write(missing[i], frame);
    }
    writer.finish();
}

void write_trace(const OutputFile& file, const ChromeTrace& trace) {
    std::ostringstream json;
    trace.write(json);
    file.write(json.view());
}

void print_summary(const ExportOptions& options, const std::vector<FrameRecord>& frames, std::size_t kept) {
    double height = 0;
    for (const FrameRecord& frame : frames) height += frame.significant_wave_height_m;
    std::printf("%s: %zu frame%s", options.folder.c_str(), frames.size(), frames.size() == 1 ? "" : "s");
    if (options.resume) std::printf(" (%zu of them kept)", kept);
    const SeaState& sea = options.sea.sea;
    const std::string_view waves = sea.waves == WaveModel::spectrum ? name_of(sea.spectrum) : name_of(sea.waves);
    std::printf(", %s sea, Hs %.2f m, peak period %.1f s\n", std::string(waves).c_str(),
                height / static_cast<double>(frames.size()), expected_waves(options.sea.sea).peak_period_s);
    for (const std::string& warning : warnings_about(options.sea.sea)) std::printf("note: %s\n", warning.c_str());
}

}  // namespace

void run_export(const ExportOptions& options) {
    catch_stop_signals();
    make_folder(options.folder);
    const OutputFolder folder(options.folder, options.sync ? Sync::yes : Sync::no);
    std::optional<FolderLock> lock;
    if (options.lock) lock.emplace(folder);
    ExportJournal journal(options, folder);
    std::optional<OutputFile> trace_file;
    if (options.trace) trace_file.emplace(*options.trace);
    journal.begin();
    std::map<int, FrameRecord> records = journal.done();
    const std::size_t kept = records.size();
    const auto trace = options.trace ? std::make_shared<ChromeTrace>() : nullptr;
    try {
        make_frames(options, folder, journal, records, trace);
    } catch (const Stopped&) {
        if (trace) write_trace(*trace_file, *trace);
        throw;
    }

    std::vector<FrameRecord> frames;
    for (auto& [number, record] : records) frames.push_back(std::move(record));
    journal.end(frames);
    if (trace) write_trace(*trace_file, *trace);
    print_summary(options, frames, kept);
    if (trace && trace->left_out() > 0)
        std::printf("note: %s holds the first %zu spans, %zu later ones are left out\n", options.trace->c_str(),
                    ChromeTrace::default_most_spans, trace->left_out());
}

}  // namespace pelagic::tools
