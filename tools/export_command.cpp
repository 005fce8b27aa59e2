#include "pelagic/tools/export_command.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <deque>
#include <future>
#include <map>
#include <memory>
#include <sstream>
#include <thread>
#include <vector>

#include "pelagic/jobs/chrome_trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/atomic_file.hpp"
#include "pelagic/tools/errors.hpp"
#include "pelagic/tools/export_journal.hpp"
#include "pelagic/tools/progress.hpp"
#include "pelagic/tools/stop_signal.hpp"

namespace pelagic::tools {
namespace {

std::string file_name(const char* map, int frame, int level, const char* extension) {
    std::array<char, 64> name;
    if (level == 0)
        std::snprintf(name.data(), name.size(), "%s_%04d.%s", map, frame, extension);
    else
        std::snprintf(name.data(), name.size(), "%s_%04d_mip%d.%s", map, frame, level, extension);
    return name.data();
}

/// A frame's outputs copied, so that its images can be encoded while the ocean goes on.
class FrameCopy {
   public:
    explicit FrameCopy(const Frame& frame) : frame_(frame) {
        const std::size_t n = static_cast<std::size_t>(frame.resolution());
        planes_.reserve(3 * n * n);
        for (PlaneView* plane : {&frame_.dx, &frame_.height, &frame_.dz}) {
            const int size = plane->resolution;
            float* copy = planes_.data() + planes_.size();
            planes_.resize(planes_.size() + n * n);
            for (int j = 0; j < size; ++j) plane->copy_row(j, copy + j * size);
            *plane = {copy, size, size, size, 0};
        }
        halves_.assign(frame.displacement_rgba16f.begin(), frame.displacement_rgba16f.end());
        bytes_.assign(frame.gradient_rgba8.begin(), frame.gradient_rgba8.end());
        frame_.displacement_rgba16f = halves_;
        frame_.gradient_rgba8 = bytes_;
    }
    FrameCopy(FrameCopy&&) = default;  // vectors keep their memory when they move
    FrameCopy(const FrameCopy&) = delete;

    const Frame& frame() const { return frame_; }

   private:
    Frame frame_;
    std::vector<float> planes_;
    std::vector<std::uint16_t> halves_;
    std::vector<std::uint32_t> bytes_;
};

constexpr const char* file_category = "file";

FileRecord write_image(const ExportOptions& options, const std::string& name, std::vector<unsigned char> image,
                       TraceSink* trace) {
    const TraceScope scope(trace, "write", file_category, {{{"bytes", static_cast<double>(image.size())}}});
    write_whole_file(options.folder / name, std::as_bytes(std::span(image)));
    return {name, xxh3_text(image.data(), image.size())};
}

std::vector<unsigned char> displacement_image(const ExportOptions& options, const Frame& frame, TraceSink* trace) {
    const TraceScope scope(trace, "encode displacement", file_category);
    return encode_displacement(frame, options.format, options.half);
}

std::vector<unsigned char> gradient_image(const ExportOptions& options, const Frame& frame, int level,
                                          TraceSink* trace) {
    const TraceScope scope(trace, "encode gradient", file_category, {{{"level", static_cast<double>(level)}}});
    return encode_gradient(frame, level, options.format);
}

FrameRecord write_frame(const ExportOptions& options, int number, const Frame& frame, TraceSink* trace) {
    const TraceScope scope(trace, "files", file_category,
                           {{{"frame", static_cast<double>(number)}, {"time_s", frame.time_s}}});
    FrameRecord record{.frame = number,
                       .time_s = frame.time_s,
                       .hash = hex_text(hash_of(frame)),
                       .significant_wave_height_m = measured_significant_wave_height_m(frame),
                       .height_min_m = frame.bounds.height_min_m,
                       .height_max_m = frame.bounds.height_max_m,
                       .files = {}};
    if (options.displacement)
        record.files.push_back(
            write_image(options, file_name("displacement", number, 0, displacement_extension(options.format)),
                        displacement_image(options, frame, trace), trace));
    if (options.gradient)
        for (int level = 0; level < (options.mips ? mip_levels(frame.resolution()) : 1); ++level)
            record.files.push_back(
                write_image(options, file_name("gradient", number, level, gradient_extension(options.format)),
                            gradient_image(options, frame, level, trace), trace));
    return record;
}

/// A frame in flight is copied, interleaved, encoded and compressed: about so many bytes a texel, measured.
constexpr std::size_t bytes_per_texel_in_flight = 64;
constexpr std::size_t most_bytes_in_flight = std::size_t{2} << 30;

/// Encodes frames on a few threads and journals them in order. Memory is bounded: one frame a thread, 2 GiB in all.
class FrameWriter {
   public:
    FrameWriter(const ExportOptions& options, ExportJournal& journal, std::map<int, FrameRecord>& records,
                TraceSink* trace)
        : options_(options), journal_(journal), records_(records), trace_(trace) {
        const unsigned cores = std::max(1u, std::thread::hardware_concurrency());
        const std::size_t threads =
            options.compute.threads == 0 ? cores : static_cast<std::size_t>(options.compute.threads);
        const std::size_t texels = static_cast<std::size_t>(options.sea.sea.resolution) * options.sea.sea.resolution;
        most_ =
            std::min(threads, std::max<std::size_t>(1, most_bytes_in_flight / (texels * bytes_per_texel_in_flight)));
    }

    void write(int number, const Frame& frame) {
        while (in_flight_.size() >= most_) take_oldest();
        // With one thread the work is done when it is taken, by the thread that takes it.
        const auto policy = most_ == 1 ? std::launch::deferred : std::launch::async;
        in_flight_.push_back(std::async(policy, [this, number, copy = FrameCopy(frame)] {
            return write_frame(options_, number, copy.frame(), trace_);
        }));
    }

    void finish() {
        while (!in_flight_.empty()) take_oldest();
    }

   private:
    void take_oldest() {
        std::future<FrameRecord> oldest = std::move(in_flight_.front());
        in_flight_.pop_front();
        FrameRecord record = wait_for(oldest);
        journal_.add(record);
        const int number = record.frame;
        records_.emplace(number, std::move(record));
    }

    FrameRecord wait_for(std::future<FrameRecord>& files) {
        const TraceScope scope(trace_, "wait for files", file_category);
        return files.get();
    }

    const ExportOptions& options_;
    ExportJournal& journal_;
    std::map<int, FrameRecord>& records_;
    TraceSink* trace_;
    std::size_t most_;
    std::deque<std::future<FrameRecord>> in_flight_;
};

void make_folder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw FileError("can't write " + folder.string() + ": " + error.message());
}

/// Computes and writes the frames that `records` lacks.
void make_frames(const ExportOptions& options, ExportJournal& journal, std::map<int, FrameRecord>& records, Isa isa,
                 const std::shared_ptr<ChromeTrace>& trace) {
    std::vector<int> missing;
    for (int frame = 0; frame < options.frames; ++frame)
        if (!records.contains(frame)) missing.push_back(frame);
    if (missing.empty()) return;

    Ocean ocean(options.sea.sea,
                {.executor = make_default_executor(options.compute.threads), .isa = isa, .trace = trace});
    Progress progress("frame", missing.size());
    FrameWriter writer(options, journal, records, trace.get());
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

void write_trace(const std::filesystem::path& file, const ChromeTrace& trace) {
    std::ostringstream json;
    trace.write(json);
    write_whole_file(file, json.view());
}

void print_summary(const ExportOptions& options, const std::vector<FrameRecord>& frames, std::size_t kept) {
    double height = 0;
    for (const FrameRecord& frame : frames) height += frame.significant_wave_height_m;
    std::printf("%s: %zu frame%s", options.folder.c_str(), frames.size(), frames.size() == 1 ? "" : "s");
    if (options.resume) std::printf(" (%zu of them kept)", kept);
    std::printf(", %s sea, Hs %.2f m, peak period %.1f s\n", std::string(name_of(options.sea.sea.spectrum)).c_str(),
                height / static_cast<double>(frames.size()), expected_waves(options.sea.sea).peak_period_s);
    for (const std::string& warning : warnings_about(options.sea.sea)) std::printf("note: %s\n", warning.c_str());
}

}  // namespace

void run_export(const ExportOptions& options) {
    catch_stop_signals();
    ExportJournal journal(options);
    make_folder(options.folder);
    if (options.trace) check_writable(*options.trace);
    journal.begin();
    std::map<int, FrameRecord> records = journal.done();
    const std::size_t kept = records.size();
    const auto trace = options.trace ? std::make_shared<ChromeTrace>() : nullptr;
    try {
        make_frames(options, journal, records, *options.compute.isa, trace);
    } catch (const Stopped&) {
        if (trace) write_trace(*options.trace, *trace);
        throw;
    }

    std::vector<FrameRecord> frames;
    for (auto& [number, record] : records) frames.push_back(std::move(record));
    journal.end(frames);
    if (trace) write_trace(*options.trace, *trace);
    print_summary(options, frames, kept);
    if (trace && trace->left_out() > 0)
        std::printf("note: %s holds the first %zu spans, %zu later ones are left out\n", options.trace->c_str(),
                    ChromeTrace::default_most_spans, trace->left_out());
}

}  // namespace pelagic::tools
