// `pelagic export`: writes a sea as image files, one set for each frame, and sea.json.

#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <sstream>
#include <thread>
#include <vector>

#include "pelagic/jobs/chrome_trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/export_preview.hpp"
#include "pelagic/tools/export/export_summary.hpp"
#include "pelagic/tools/export/mesh_files.hpp"
#include "pelagic/tools/export/sequence_output.hpp"
#include "pelagic/tools/files/digest.hpp"
#include "pelagic/tools/files/open_file.hpp"
#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/maps/map_image.hpp"
#include "pelagic/tools/record/export_journal.hpp"
#include "pelagic/tools/record/folder_lock.hpp"
#include "pelagic/tools/record/frame_writer.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/progress.hpp"
#include "pelagic/tools/text/stop_signal.hpp"

namespace pelagic::tools {
namespace {

/// Makes the folder and those above it. std::filesystem::create_directories() knows no drives in paths
/// of any length.
void make_folder(const std::filesystem::path& folder) {
    std::filesystem::path made;
    for (const std::filesystem::path& name : folder) {
        made /= name;
        std::error_code error;
        if (!made.has_relative_path() || std::filesystem::is_directory(any_length(made), error)) continue;
        std::filesystem::create_directory(any_length(made), error);
        if (error) throw FileError("can't write " + folder.string() + ": " + error.message());
    }
}

/// Computes frames in order and calls `take` for each while the next one is computed. Returns false
/// if a signal stopped it.
/// \param player  may be null
bool for_each_frame(const ExportOptions& options, Ocean& ocean, EventPlayer* player, std::span<const int> numbers,
                    const std::function<void(int, const Frame&)>& take) {
    if (numbers.empty()) return true;
    Progress progress("frame", numbers.size());
    ocean.schedule(options.times.time_of(numbers.front()));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        if (stop_signal() != 0) return false;
        progress.show(i);
        const Frame& frame = ocean.complete();
        if (i + 1 < numbers.size()) ocean.schedule(options.times.time_of(numbers[i + 1]));
        take(numbers[i], exported_frame(frame, player));
    }
    return true;
}

Stopped stopped(const ExportOptions& options, std::size_t done) {
    return {stop_signal(), static_cast<int>(done), static_cast<int>(options.frames_here().size())};
}

/// Copies the events file to the export's folder, from which `pelagic merge`, `verify` and --resume
/// read it. Shards of one export may do so at the same time; a later shard finds an equal copy.
void keep_events(const EventFile& events, const OutputFolder& folder) {
    constexpr int max_tries = 50;
    for (int tries = 1;; ++tries) try {
            if (folder.read_text(events_copy_name, events.text.size()) == events.text) return;
            return folder.write(events_copy_name, events.text);
        } catch (const FileError&) {
            if (tries == max_tries) throw;
            std::this_thread::sleep_for(std::chrono::milliseconds(tries));
        }
}

/// Computes each frame once, and writes the frames that `records` lacks and the files that are made of
/// all frames together. Frames of the record are computed again only for such files.
/// \return the records of the files made of all frames
std::vector<FileRecord> make_frames(const ExportOptions& options, const OutputFolder& folder, ExportJournal& journal,
                                    std::map<int, FrameRecord>& records, const std::shared_ptr<ChromeTrace>& trace) {
    const std::vector<std::unique_ptr<SequenceOutput>> outputs = sequence_outputs(options);
    std::vector<int> numbers = options.frames_here();
    if (outputs.empty()) std::erase_if(numbers, [&](int number) { return records.contains(number); });
    if (numbers.empty()) return {};

    const OceanOptions how = ocean_options(options, trace);
    Ocean ocean(forecast_of(options.sea), how);
    const std::unique_ptr<EventPlayer> player = event_player(options, how);
    // The outputs hold all frames in memory.
    const std::size_t max_bytes = outputs.empty() ? bytes_for_writing(ocean.memory_bytes()) : min_bytes_for_writing;
    FrameWriter writer(options, folder, journal, records, trace.get(), max_bytes);
    std::size_t index = 0;
    const bool all_made = for_each_frame(options, ocean, player.get(), numbers, [&](int number, const Frame& frame) {
        if (!records.contains(number)) writer.write(number, frame);
        for (const auto& output : outputs) output->add(index, frame);
        ++index;
    });
    writer.finish();
    if (!all_made) throw stopped(options, records.size());

    std::vector<FileRecord> files;
    for (const auto& output : outputs)
        for (const SequenceOutput::File& file : output->finish()) {
            const std::string_view bytes(reinterpret_cast<const char*>(file.bytes.data()), file.bytes.size());
            folder.write(file.name, bytes);
            files.push_back({file.name, digest_of(bytes)});
        }
    return files;
}

void write_trace(const OutputFile& file, const ChromeTrace& trace) {
    std::ostringstream json;
    trace.write(json);
    file.write(json.view());
}

void run_export(const ExportOptions& options) {
    catch_stop_signals();
    make_folder(options.folder);
    const OutputFolder folder(options.folder, options.sync ? Sync::yes : Sync::no);
    std::optional<FolderLock> lock;
    if (options.lock) lock.emplace(folder, "--out", options.shard);
    if (options.preview) return preview_export(options, folder);
    ExportJournal journal(options, folder);
    std::optional<OutputFile> trace_file;
    if (options.trace) trace_file.emplace(*options.trace);
    if (options.events) keep_events(*options.events->file, folder);
    journal.begin();
    print_notes(options);
    std::map<int, FrameRecord> records = journal.done();
    const std::size_t kept = records.size();
    const auto trace = options.trace ? std::make_shared<ChromeTrace>() : nullptr;
    std::vector<FileRecord> sequence_files;
    try {
        sequence_files = make_frames(options, folder, journal, records, trace);
    } catch (const Stopped&) {
        if (trace) write_trace(*trace_file, *trace);
        throw;
    }

    std::vector<FrameRecord> frames;
    double height_sum_m = 0;
    for (auto& [number, record] : records) {
        height_sum_m += record.significant_wave_height_m;
        frames.push_back(std::move(record));
    }
    journal.end(frames, sequence_files);
    if (trace) write_trace(*trace_file, *trace);
    if (!is_quiet())
        print_summary(stdout, options, {.frames = frames.size(), .kept = kept, .height_sum_m = height_sum_m});
    if (clamped_halves())
        print_note(
            "values beyond 65504, the largest 16-bit float, are stored as 65504; 32-bit floats hold them, without "
            "--half and --format ktx2");
    if (trace && trace->omitted() > 0)
        print_note(options.trace->string() + " holds the first " + number_text(ChromeTrace::default_max_spans) +
                   " spans, " + number_text(trace->omitted()) + " later ones are omitted");
}

class ExportCommand final : public Command {
   public:
    void add_options(CLI::App& app) override { flags_.add_to(app); }
    /// Prints a summary on stdout, and progress on stderr if stderr is a terminal.
    void run() override { run_export(flags_.resolve()); }

   private:
    ExportFlags flags_;
};

}  // namespace

std::unique_ptr<Command> make_export_command() { return std::make_unique<ExportCommand>(); }

}  // namespace pelagic::tools
