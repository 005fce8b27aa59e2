// `pelagic verify`: compares a finished export with its record, and with frames computed on this
// machine.

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/message/one_line.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/export/mesh_files.hpp"
#include "pelagic/tools/export/sequence_output.hpp"
#include "pelagic/tools/export/shard.hpp"
#include "pelagic/tools/files/digest.hpp"
#include "pelagic/tools/measure/export_reader.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/record/export_from_record.hpp"
#include "pelagic/tools/record/file_check.hpp"
#include "pelagic/tools/record/frame_writer.hpp"
#include "pelagic/tools/record/record_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/path_text.hpp"
#include "pelagic/tools/text/progress.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* whole_export = "all";
constexpr std::size_t default_sample = 8;

/// Returns `count` distinct random indices of frames, determined by the seed. Floyd's algorithm
/// (Bentley 1987).
std::set<std::size_t> sample_of(std::size_t frames, std::size_t count, std::uint64_t seed) {
    std::set<std::size_t> places;
    std::mt19937_64 random(seed);
    for (std::size_t last = frames - std::min(count, frames); last < frames; ++last)
        if (!places.insert(random() % (last + 1)).second) places.insert(last);
    return places;
}

class Verification {
   public:
    Verification(const OutputFolder& folder, const ComputeOptions& compute) : folder_(folder) {
        const bool is_there = read_record(folder_, name_,
                                          {.head =
                                               [&](const ReadJson& head) {
                                                   head_ = head;
                                                   options_ = options_of_record(head, path());
                                                   return false;
                                               },
                                           .frame = {}});
        if (!is_there)
            throw InputError(path().string() + " is missing: expected a finished export" + hint_of_shards());
        options_.compute = compute;
    }

    std::size_t frames() const { return options_.times.count(); }
    std::size_t wrong() const { return findings_.count(); }

    /// Checks the record, every file and sea.json. Stores the recorded entries of the sample.
    void check_files(const std::set<std::size_t>& sample) {
        double height_sum_m = 0;
        std::vector<std::string> summaries;  // XXH3 of the expected entry of each frame in sea.json
        FileCheck check(folder_, options_.compute.threads,
                        [&](std::size_t place, const std::string& what) { findings_.add(place, what); });
        Progress progress("frame", frames());
        const std::string wrong = read_frames(
            folder_, name_, options_, {0, frames()}, [](const ReadJson&) {},
            [&](std::size_t place, FrameRecord&& frame) {
                height_sum_m += frame.significant_wave_height_m;
                summaries.push_back(digest_of(ReadJson(frame_summary_as_json(frame)).dump()));
                check.add(place, frame.files);
                if (sample.contains(place)) sample_.push_back(std::move(frame));
                progress.show(place);
            });
        if (wrong.empty()) {
            sequence_files_ = check_head();
            check_sea_json(height_sum_m / static_cast<double>(frames()), sequence_files_, summaries);
            check.add(frames(), sequence_files_);
        } else {
            findings_.add(0, path().string() + wrong);
        }
        check.finish();
    }

    /// Computes the frames of the sample again and compares them, and their meshes, with their
    /// entries; with all frames the animations, too. Encoders of images are libraries, whose bytes
    /// depend on their versions.
    void check_sample() {
        if (sample_.empty()) return;
        const OceanOptions how = ocean_options(options_, nullptr);
        Ocean ocean(forecast_of(options_.sea), how);
        const std::unique_ptr<EventPlayer> player = event_player(options_, how);
        std::vector<std::unique_ptr<SequenceOutput>> animations;
        if (sample_.size() == frames()) animations = mesh_sequences(options_);
        Progress progress("sample", sample_.size());
        std::size_t done = 0;
        for (const FrameRecord& recorded : sample_) {
            progress.show(done);
            const Frame frame = exported_frame(ocean.frame_at(recorded.time_s), player.get());
            FrameRecord computed = statistics_of(recorded.frame, frame, options_.has_foam());
            computed.files = recorded.files;
            check_meshes(recorded, frame);
            for (const auto& output : animations) output->add(done, frame);
            ++done;
            const Json now = frame_as_json(computed);
            if (now == frame_as_json(recorded)) continue;
            is_other_sea_ = true;
            findings_.add(frames(), "frame " + std::to_string(recorded.frame) + " is computed otherwise here: " +
                                        first_difference(ReadJson(frame_as_json(recorded)), now).is_not());
        }
        for (const auto& output : animations)
            for (const SequenceOutput::File& file : output->finish())
                check_bytes(sequence_files_, file.name, file.bytes);
    }

    /// \pre wrong() > 0
    [[noreturn]] void reject() {
        findings_.print();
        options_.resume = !is_other_sea_;  // --resume would keep files that match their record
        options_.overwrite = is_other_sea_;
        std::printf("%s\n", command_line_of(options_, path()).c_str());
        throw FileError(folder_.path().string() + " is not what was exported: " + std::to_string(findings_.count()) +
                        (findings_.count() == 1 ? " thing is wrong" : " things are wrong") +
                        "; the line above makes it again");
    }

    std::size_t sampled() const { return sample_.size(); }

   private:
    std::filesystem::path path() const { return folder_.path() / name_; }

    std::string hint_of_shards() const {
        bool has_shards = false;
        folder_.for_each_name(
            [&](const std::string& name) { has_shards = has_shards || shard_of_record(name).has_value(); });
        return has_shards ? "; pelagic merge makes one of the shards" : "";
    }

    /// Checks the head of the record. Returns the files that are made of all frames together.
    std::vector<FileRecord> check_head() {
        std::vector<FileRecord> sequence_files;
        for (const ReadJson& file : head_.value("sequence_files", ReadJson::array())) {
            if (!file.is_object()) continue;
            FileRecord record{file.value("name", ""), file.value("xxh3", "")};
            const bool is_plain = !record.name.empty() && record.name.find('/') == std::string::npos;
            if (is_plain) sequence_files.push_back(std::move(record));
        }
        const Json expected = record_head(options_, sequence_files);
        if (head_ != ReadJson(expected))
            findings_.add(0, path().string() + " is edited: " + first_difference(head_, expected).is_not());
        return sequence_files;
    }

    /// Checks that sea.json has the contents that follow from the record.
    void check_sea_json(double mean_significant_wave_height_m, const std::vector<FileRecord>& sequence_files,
                        const std::vector<std::string>& summaries) {
        std::size_t next = 0;
        std::string wrong;
        const auto check_summary_head = [&](const ReadJson& head) {
            const Json expected = sea_json_head(options_, mean_significant_wave_height_m, sequence_files);
            if (head != ReadJson(expected)) wrong = " is edited: " + first_difference(head, expected).is_not();
            return wrong.empty();
        };
        const auto check_summary_frame = [&](const ReadJson& entry) {
            if (next == summaries.size() || digest_of(entry.dump()) != summaries[next])
                wrong =
                    " is edited: its entry " + std::to_string(next) + " of frames is not what an export writes there";
            ++next;
            return wrong.empty();
        };
        try {
            if (!read_record(folder_, sea_json_name, {.head = check_summary_head, .frame = check_summary_frame}))
                wrong = " is missing";
            else if (wrong.empty() && next < summaries.size())
                wrong = " is edited: it has " + std::to_string(next) + " of " + std::to_string(summaries.size()) +
                        " frames";
        } catch (const DamagedRecord&) {
            wrong = " is damaged";
        }
        if (!wrong.empty()) findings_.add(0, (folder_.path() / sea_json_name).string() + wrong);
    }

    void check_meshes(const FrameRecord& recorded, const Frame& frame) {
        const std::vector<MeshFile> files = mesh_files(options_, recorded.frame);
        if (files.empty()) return;
        const Mesh mesh = exported_mesh(frame, options_);
        for (const MeshFile& file : files)
            check_bytes(recorded.files, file.name, encode_mesh_file(file.format, mesh));
    }

    void check_bytes(const std::vector<FileRecord>& recorded, const std::string& name, const Bytes& bytes) {
        const std::string xxh3 = digest_of({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
        const auto is_other = [&](const FileRecord& file) { return file.name == name && file.xxh3 != xxh3; };
        if (std::none_of(recorded.begin(), recorded.end(), is_other)) return;
        is_other_sea_ = true;
        findings_.add(frames(), (folder_.path() / name).string() + " is computed otherwise here");
    }

    const OutputFolder& folder_;
    const std::string name_ = record_name({});
    ReadJson head_;
    ExportOptions options_;
    std::vector<FrameRecord> sample_;
    std::vector<FileRecord> sequence_files_;
    Findings findings_;
    bool is_other_sea_ = false;
};

class VerifyCommand final : public Command {
   public:
    void add_options(CLI::App& app) override;
    /// Checks the record, every file against its hash, and sea.json, and computes a sample of
    /// frames again. If anything is wrong, it prints the errors on stderr and the command that
    /// repairs the export on stdout, and throws FileError. Writes no files. Throws InputError if
    /// there is no export, or one of another version of pelagic.
    void run() override;

   private:
    std::optional<std::string> folder_, sample_, seed_;
    ComputeFlags compute_;
};

void VerifyCommand::add_options(CLI::App& app) {
    app.add_option("DIR", folder_, "folder of a finished export")->type_name("");
    app.option_defaults()->group(help_group::input);
    app.add_option("--sample", sample_,
                   "number of frames to recompute; 0 to 1000000, or all, with animations (default: 8)")
        ->type_name("NUMBER");
    app.add_option("--seed", seed_, "seed that selects these frames; 0 to 2147483647 (default: 0)")
        ->type_name("NUMBER");
    compute_.add_to(app);
}

void VerifyCommand::run() {
    if (!folder_) throw InputError("DIR is missing: expected the folder of a finished export");
    std::size_t sample = default_sample;
    if (sample_ == whole_export)
        sample = SIZE_MAX;
    else if (sample_)
        sample = static_cast<std::size_t>(whole_number_in("--sample", *sample_, 0, 1'000'000));
    const int seed = seed_ ? whole_number_in("--seed", *seed_, 0, INT32_MAX) : 0;
    const OutputFolder folder = open_export("DIR", path_of(*folder_), Sync::no);
    try {
        Verification verification(folder, compute_.resolve());
        verification.check_files(sample_of(verification.frames(), sample, static_cast<std::uint64_t>(seed)));
        verification.check_sample();
        if (verification.wrong() > 0) verification.reject();
        if (!is_quiet())
            std::fprintf(stderr, "%s: %zu frame%s as written, %zu of them recomputed\n", escaped(*folder_).c_str(),
                         verification.frames(), verification.frames() == 1 ? "" : "s", verification.sampled());
    } catch (const DamagedRecord&) {
        throw FileError((folder.path() / record_name({})).string() +
                        " is damaged: its options are unknown, so the export has to be made again");
    }
}

}  // namespace

std::unique_ptr<Command> make_verify_command() { return std::make_unique<VerifyCommand>(); }

}  // namespace pelagic::tools
