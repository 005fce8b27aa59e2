// `pelagic merge`: joins the shards of an export, if all of them are complete.

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/export_summary.hpp"
#include "pelagic/tools/export/shard.hpp"
#include "pelagic/tools/measure/export_reader.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/record/export_from_record.hpp"
#include "pelagic/tools/record/file_check.hpp"
#include "pelagic/tools/record/folder_lock.hpp"
#include "pelagic/tools/record/record_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/path_text.hpp"
#include "pelagic/tools/text/progress.hpp"

namespace pelagic::tools {
namespace {

constexpr std::size_t max_lines = Findings::max_kept;

/// Names of files in the folder other than images.
struct FolderNames {
    /// indices of the shards with a record, by the number of shards
    std::map<int, std::set<int>> shards;
    /// candidates for removal once the export is complete
    std::vector<std::string> leftovers;
    bool has_record = false, has_sea_json = false;  ///< of a merged or unsharded export
};

FolderNames names_in_folder(const OutputFolder& folder) {
    FolderNames names;
    folder.for_each_name([&](const std::string& name) {
        if (const auto shard = shard_of_record(name)) names.shards[shard->count].insert(shard->index);
        const bool is_part = name.starts_with('.') && name.ends_with(".part");
        if (is_of_shard(name) || is_part || name == journal_name({})) names.leftovers.push_back(name);
        names.has_record = names.has_record || name == record_name({});
        names.has_sea_json = names.has_sea_json || name == sea_json_name;
    });
    return names;
}

/// Reads the records of an export: those of its shards, or the record of the whole export.
class Merge {
   public:
    Merge(const OutputFolder& folder, FolderNames names, const ComputeOptions& compute, bool has_lock)
        : folder_(folder), names_(std::move(names)), count_(names_.shards.begin()->first) {
        find_options();
        options_.compute = compute;
        options_.lock = has_lock;
        is_finished_ = has_finished_export();
    }

    void run() {
        const double height_sum_m = check_all();
        if (!wrong_.empty()) reject();
        if (!is_finished_) write(height_sum_m);
        folder_.sync();
        for (const std::string& name : names_.leftovers)
            if (is_export_name(name, options_.maps.names)) folder_.remove(name);
        folder_.sync();
        if (!is_quiet())
            print_summary(stderr, options_, {.frames = options_.times.count(), .height_sum_m = height_sum_m});
        print_notes(options_);
    }

   private:
    using Take = std::function<void(std::size_t place, FrameRecord&& frame)>;

    std::string path_of(const std::string& name) const { return (folder_.path() / name).string(); }

    /// Reads the options of the first readable record. All other records must have the same
    /// options.
    void find_options() {
        for (const int index : names_.shards.begin()->second) try {
                first_name_ = record_name(Shard{index, count_});
                read_record(folder_, first_name_,
                            {.head =
                                 [&](const ReadJson& head) {
                                     options_ = options_of_record(head, folder_.path() / first_name_);
                                     return false;
                                 },
                             .frame = {}});
                options_json_ = options_as_json(options_);
                wanted_ = options_json_;
                return;
            } catch (const DamagedRecord&) {
                // check_all() reports this record if another one can be read.
            }
        throw FileError("no record of a shard in " + folder_.path().string() +
                        " can be read: the options of the export are unknown, so all " + std::to_string(count_) +
                        " shards have to be made again");
    }

    void require_same_options(const std::string& name, const ReadJson& head) const {
        const ReadJson options = options_in(head);
        if (options == wanted_) return;
        // throws if the record is of another version
        options_of_record(head, folder_.path() / name);
        throw InputError(path_of(name) + " is of another export than " + first_name_ + ": " +
                         first_option_difference(options, options_json_).is_not());
    }

    /// Returns true if the folder has the record and sea.json of a whole export, and fewer records
    /// of shards than shards: a merge was interrupted, or shards were made again.
    bool has_finished_export() const {
        int found = 0;
        for (const std::string& name : {record_name({}), std::string(sea_json_name)}) try {
                read_record(folder_, name,
                            {.head =
                                 [&](const ReadJson& head) {
                                     require_same_options(name, head);
                                     ++found;
                                     return false;
                                 },
                             .frame = {}});
            } catch (const DamagedRecord&) {
                return false;
            }
        return found == 2 && names_.shards.begin()->second.size() < static_cast<std::size_t>(count_);
    }

    int records() const { return is_finished_ ? 1 : count_; }
    std::optional<Shard> shard_of(int record) const {
        return is_finished_ ? std::nullopt : std::optional(Shard{record, count_});
    }

    /// Reads a record. Returns the error in it; an empty text if there is none.
    std::string read(int record, const Take& take) const {
        const std::optional<Shard> shard = shard_of(record);
        const std::string name = record_name(shard);
        const std::size_t frames = options_.times.count();
        const Places places = shard ? Places{shard->begin(frames), shard->end(frames)} : Places{0, frames};
        const auto check_head = [&](const ReadJson& head) {
            require_same_options(name, head);
            if (shard &&
                head.value("shard", ReadJson()) != ReadJson{{"index", shard->index}, {"count", shard->count}})
                throw InputError(path_of(name) + " is of another shard than its name says");
        };
        const std::string wrong = read_frames(folder_, name, options_, places, check_head, take);
        return wrong.empty() ? "" : path_of(name) + wrong;
    }

    /// Checks every record and every file. Returns the sum of the frames' significant wave heights
    /// in metres, added in order.
    double check_all() {
        double height_sum_m = 0;
        std::mutex mutex;
        const std::size_t frames = options_.times.count();
        const auto report = [&](int record, std::size_t place, const std::string& what) {
            findings_.add(place, what);
            const std::lock_guard lock(mutex);
            wrong_.insert(record);
        };
        FileCheck check(folder_, options_.compute.threads,
                        [&](std::size_t place, const std::string& what) { report(record_at(place), place, what); });
        Progress progress("frame", frames);
        for (int record = 1; record <= records(); ++record) {
            const std::string wrong = read(record, [&](std::size_t place, FrameRecord&& frame) {
                height_sum_m += frame.significant_wave_height_m;
                check.add(place, std::move(frame.files));
                progress.show(place);
            });
            if (!wrong.empty()) report(record, is_finished_ ? 0 : Shard{record, count_}.begin(frames), wrong);
        }
        check.finish();
        return height_sum_m;
    }

    /// Returns the index of the record that contains a frame.
    int record_at(std::size_t place) const {
        if (is_finished_) return 1;
        const std::size_t frames = options_.times.count();
        int first = 1, last = count_;
        while (first < last) {
            const int middle = first + (last - first) / 2;
            if (Shard{middle, count_}.end(frames) > place)
                last = middle;
            else
                first = middle + 1;
        }
        return first;
    }

    void write(double height_sum_m) const {
        const double mean_m = height_sum_m / static_cast<double>(options_.times.count());
        write_finished(folder_, options_, mean_m, {}, [&](const auto& take) {
            for (int record = 1; record <= records(); ++record) {
                const std::string wrong = read(record, [&](std::size_t, FrameRecord&& frame) { take(frame); });
                if (!wrong.empty()) throw FileError(wrong + ", which it was not a moment ago");
            }
        });
    }

    [[noreturn]] void reject() {
        findings_.print();
        const std::filesystem::path record = folder_.path() / (is_finished_ ? record_name({}) : first_name_);
        std::size_t lines = 0;
        for (const int wrong : wrong_) {
            if (lines++ == max_lines) break;
            ExportOptions again = options_;
            again.shard = shard_of(wrong);
            again.resume = true;
            std::printf("%s\n", command_line_of(again, record).c_str());
        }
        if (is_finished_)
            throw FileError(folder_.path().string() +
                            " is not whole, nothing was changed; the line above makes the rest");
        throw FileError(folder_.path().string() +
                        " is not whole, nothing was changed: " + std::to_string(wrong_.size()) + " of " +
                        std::to_string(count_) + " shards have to be made again, " + text_of_wrong());
    }

    /// Returns the indices of invalid shards as "3,7-12", the format of job schedulers.
    std::string text_of_wrong() const {
        constexpr std::size_t max_ranges = 100;
        std::vector<FrameRange> ranges;
        for (const int index : wrong_) {
            if (!ranges.empty() && ranges.back().last + 1 == index)
                ranges.back().last = index;
            else if (ranges.size() == max_ranges)
                return tools::text_of(ranges) + ",...";
            else
                ranges.push_back({index, index});
        }
        return tools::text_of(ranges);
    }

    const OutputFolder& folder_;
    FolderNames names_;
    int count_;
    std::string first_name_;
    ExportOptions options_;
    Json options_json_;
    ReadJson wanted_;  ///< options_json_ with sorted keys
    bool is_finished_ = false;
    Findings findings_;
    std::set<int> wrong_;  ///< indices of invalid records
};

class MergeCommand final : public Command {
   public:
    void add_options(CLI::App& app) override;
    /// Checks every record and every file, then writes sea_files.json and sea.json and removes the
    /// records, journals and locks of the shards. If anything is missing or invalid, it changes
    /// nothing, prints the errors on stderr and a command for each shard that has to be made again
    /// on stdout, and throws FileError. Throws InputError if records are of different exports or of
    /// another version of pelagic.
    void run() override;

   private:
    std::optional<std::string> folder_;
    ComputeFlags compute_;
    bool no_lock_ = false;
};

void MergeCommand::add_options(CLI::App& app) {
    app.add_option("DIR", folder_, "folder with the shards of an export")->type_name("");
    app.add_flag("--no-lock", no_lock_, "do not lock the folder, for file systems without locks")
        ->group(help_group::output);
    compute_.add_to(app);
}

void MergeCommand::run() {
    if (!folder_) throw InputError("DIR is missing: expected a folder with the shards of an export");
    const ComputeOptions compute = compute_.resolve();
    const OutputFolder folder = open_export("DIR", path_of(*folder_), Sync::yes);
    std::optional<FolderLock> lock;
    if (!no_lock_) lock.emplace(folder, "DIR");
    FolderNames names = names_in_folder(folder);
    if (names.shards.empty()) {
        if (!names.has_record)
            throw bad_value("DIR", *folder_,
                            "a folder with records of shards, sea.1-of-N.json and so on: none is there");
        print_note(*folder_ + ": nothing to merge, it holds one export and no shards; pelagic verify checks it");
        return;
    }
    if (names.shards.size() > 1) {
        const auto first = names.shards.begin(), second = std::next(first);
        throw bad_value("DIR", *folder_,
                        "the shards of one export: there are " +
                            record_name(Shard{*first->second.begin(), first->first}) + " and " +
                            record_name(Shard{*second->second.begin(), second->first}));
    }
    Merge(folder, std::move(names), compute, !no_lock_).run();
}

}  // namespace

std::unique_ptr<Command> make_merge_command() { return std::make_unique<MergeCommand>(); }

}  // namespace pelagic::tools
