#include "pelagic/tools/export_command.hpp"

#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <vector>

#include "pelagic/jobs/chrome_trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/digest.hpp"
#include "pelagic/tools/errors.hpp"
#include "pelagic/tools/export_journal.hpp"
#include "pelagic/tools/export_preview.hpp"
#include "pelagic/tools/folder_lock.hpp"
#include "pelagic/tools/frame_writer.hpp"
#include "pelagic/tools/output_folder.hpp"
#include "pelagic/tools/progress.hpp"
#include "pelagic/tools/sequence_output.hpp"
#include "pelagic/tools/stop_signal.hpp"

namespace pelagic::tools {
namespace {

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw FileError("can't write " + folder.string() + ": " + error.message());
}

OceanOptions ocean_options(const ExportOptions& options, const std::shared_ptr<ChromeTrace>& trace) {
    return {.executor = make_default_executor(options.compute.threads),
            .isa = options.compute.isa,
            .trace = trace,
            .gradients = options.maps.has(MapKind::gradient),
            .foam = options.has_foam()};
}

/// Computes frames in order, the next one while the last is looked at. False if a signal stopped it.
bool for_each_frame(const ExportOptions& options, Ocean& ocean, std::span<const int> numbers,
                    const std::function<void(int, const Frame&)>& take) {
    if (numbers.empty()) return true;
    Progress progress("frame", numbers.size());
    ocean.schedule(options.times.time_of(numbers.front()));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (stop_signal() != 0) return false;
        progress.show(i);
        const Frame& frame = ocean.complete();
        if (i + 1 < numbers.size()) ocean.schedule(options.times.time_of(numbers[i + 1]));
        take(numbers[i], frame);
    }
    return true;
}

Stopped stopped(const ExportOptions& options, std::size_t done) {
    return {stop_signal(), static_cast<int>(done), static_cast<int>(options.times.count())};
}

/// Computes and writes the frames that `records` lacks.
void make_frames(const ExportOptions& options, const OutputFolder& folder, ExportJournal& journal,
                 std::map<int, FrameRecord>& records, const std::shared_ptr<ChromeTrace>& trace) {
    std::vector<int> missing;
    for (std::size_t i = 0; i < options.times.count(); ++i)
        if (const int number = options.times.number(i); !records.contains(number)) missing.push_back(number);
    if (missing.empty()) return;

    Ocean ocean(forecast_of(options.sea), ocean_options(options, trace));
    FrameWriter writer(options, folder, journal, records, trace.get(), bytes_for_writing(ocean.memory_bytes()));
    const bool all_made =
        for_each_frame(options, ocean, missing, [&](int number, const Frame& frame) { writer.write(number, frame); });
    writer.finish();
    if (!all_made) throw stopped(options, records.size());
}

/// Computes all frames once more for what is made of them together.
std::vector<FileRecord> make_sequences(const ExportOptions& options, const OutputFolder& folder,
                                       const std::shared_ptr<ChromeTrace>& trace) {
    const std::vector<std::unique_ptr<SequenceOutput>> outputs = sequence_outputs(options);
    if (outputs.empty()) return {};
    std::vector<int> numbers;
    for (std::size_t i = 0; i < options.times.count(); ++i) numbers.push_back(options.times.number(i));
    Ocean ocean(forecast_of(options.sea), ocean_options(options, trace));
    std::size_t index = 0;
    const bool all_seen = for_each_frame(options, ocean, numbers, [&](int, const Frame& frame) {
        for (const auto& output : outputs) output->add(index, frame);
        ++index;
    });
    if (!all_seen) throw stopped(options, numbers.size());
    std::vector<FileRecord> records;
    for (const auto& output : outputs)
        for (const SequenceOutput::File& file : output->finish()) {
            const std::string_view bytes(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
            folder.write(file.name, bytes);
            records.push_back({file.name, digest_of(bytes)});
        }
    return records;
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
    if (const SeaPatch& patch = options.meshes.patch;
        options.meshes.any() && patch.tiles < static_cast<std::size_t>(cascades_of(sea)))
        std::printf(
            "note: the mesh's steps of %s m show the waves of the coarsest %zu of %d tiles; a smaller --mesh-size or "
            "more --mesh-steps show shorter waves\n",
            rounded_text(patch.side_m / patch.steps, 3).c_str(), patch.tiles, cascades_of(sea));
}

}  // namespace

void run_export(const ExportOptions& options) {
    catch_stop_signals();
    make_folder(options.folder);
    const OutputFolder folder(options.folder, options.sync ? Sync::yes : Sync::no);
    std::optional<FolderLock> lock;
    if (options.lock) lock.emplace(folder);
    if (options.preview) return preview_export(options, ocean_options(options, nullptr), folder);
    ExportJournal journal(options, folder);
    std::optional<OutputFile> trace_file;
    if (options.trace) trace_file.emplace(*options.trace);
    journal.begin();
    std::map<int, FrameRecord> records = journal.done();
    const std::size_t kept = records.size();
    const auto trace = options.trace ? std::make_shared<ChromeTrace>() : nullptr;
    std::vector<FileRecord> sequence_files;
    try {
        make_frames(options, folder, journal, records, trace);
        sequence_files = make_sequences(options, folder, trace);
    } catch (const Stopped&) {
        if (trace) write_trace(*trace_file, *trace);
        throw;
    }

    std::vector<FrameRecord> frames;
    for (auto& [number, record] : records) frames.push_back(std::move(record));
    journal.end(frames, sequence_files);
    if (trace) write_trace(*trace_file, *trace);
    print_summary(options, frames, kept);
    if (trace && trace->left_out() > 0)
        std::printf("note: %s holds the first %zu spans, %zu later ones are left out\n", options.trace->c_str(),
                    ChromeTrace::default_most_spans, trace->left_out());
}

}  // namespace pelagic::tools
