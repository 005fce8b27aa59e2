#include "pelagic/tools/record/export_journal.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/shard.hpp"
#include "pelagic/tools/files/digest.hpp"
#include "pelagic/tools/record/record_file.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

double mean_significant_wave_height_m(const std::vector<FrameRecord>& frames) {
    double sum = 0;
    for (const FrameRecord& frame : frames) sum += frame.significant_wave_height_m;
    return sum / static_cast<double>(frames.size());
}

bool has_events(const ReadJson& options) {
    const ReadJson how = options.value("export", ReadJson());
    return how.is_object() && how.contains("events_xxh3");
}

}  // namespace

ExportJournal::ExportJournal(const ExportOptions& options, const OutputFolder& folder)
    : options_(options),
      folder_(folder),
      record_name_(record_name(options.shard)),
      journal_name_(journal_name(options.shard)) {
    const std::vector<int> here = options.frames_here();
    read_earlier();
    if (options.shard) join_others(here);
    std::erase_if(done_, [&](const auto& entry) {
        return !std::binary_search(here.begin(), here.end(), entry.first) || !is_whole(entry.second);
    });
}

std::optional<EarlierExport> ExportJournal::read_record_or_journal() const {
    const std::size_t max = max_record_bytes(options_);
    const auto text_in = [&](const std::string& name) {
        auto text = folder_.read_text(name, max);
        if (text && text->size() > max) throw DamagedRecord();
        return text;
    };
    if (const auto journal = text_in(journal_name_); journal && !journal->empty())
        return parse_journal(*journal, options_);
    if (const auto record = text_in(record_name_)) return parse_sea_json(*record, options_);
    return {};
}

void ExportJournal::require_nothing_finished() const {
    const auto reject = [&](const std::string& what) {
        throw InputError("--out " + folder_.path().string() + " already holds " + what);
    };
    std::size_t frames = 0;
    const RecordTaker count = {.head = [](const ReadJson&) { return true; },
                               .frame =
                                   [&](const ReadJson&) {
                                       ++frames;
                                       return true;
                                   }};
    for (const std::string& name : {record_name({}), std::string(sea_json_name)}) try {
            frames = 0;
            if (read_record(folder_, name, count))
                reject("a finished export of " + number_text(frames) + (frames == 1 ? " frame" : " frames") +
                       ": --resume keeps what is whole of it, --overwrite replaces it");
        } catch (const DamagedRecord&) {
            reject("an export whose " + name + " is damaged: --overwrite replaces it");
        }
    std::size_t shards = 0;
    folder_.for_each_name([&](const std::string& name) { shards += shard_of_record(name) ? 1 : 0; });
    if (shards > 0)
        reject(number_text(shards) + (shards == 1 ? " shard" : " shards") +
               " of an export: pelagic merge joins all of them, --overwrite replaces them");
}

void ExportJournal::read_earlier() {
    if (!options_.shard && !options_.resume && !options_.overwrite) require_nothing_finished();
    std::optional<EarlierExport> earlier;
    try {
        earlier = read_record_or_journal();
    } catch (const DamagedRecord&) {
        // A damaged record of a shard is ignored: the frames are made again. `pelagic merge` prints
        // the command.
        if (!options_.resume || options_.shard) return;
        throw InputError("--resume is not possible in " + folder_.path().string() + ", whose " + record_name_ +
                         " or journal is damaged; --overwrite starts anew");
    }
    if (!earlier && options_.resume && !options_.shard && folder_.open_for_reading(sea_json_name).is_open())
        throw InputError("--resume is not possible in " + folder_.path().string() + ", which has a sea.json but no " +
                         record_name_ + "; --overwrite starts anew");
    if (!earlier) return;

    if (!options_.shard) earlier_images_ = std::move(earlier->images);
    if (!options_.shard && has_events(earlier->options)) earlier_images_.emplace_back(events_copy_name);
    if (!options_.resume) return;
    if (const Json now = options_as_json(options_); earlier->options != ReadJson(now))
        throw InputError(
            "--resume is not possible in " + folder_.path().string() +
            ", whose export had other options: " + first_option_difference(earlier->options, now).was_and_is());
    done_ = std::move(earlier->frames);
}

// Takes frames from the record and the journal of a run without --shard.
void ExportJournal::join_others(const std::vector<int>& here) {
    const Json now = options_as_json(options_);
    const ReadJson wanted = now;
    const auto require_same = [&](const ReadJson& options) {
        if (options != wanted)
            throw bad_value("--shard", text_of(*options_.shard),
                            "a folder for this export alone: the one in " + folder_.path().string() +
                                " has other options: " + first_option_difference(options, now).is_not());
    };
    const auto take = [&](FrameRecord&& frame) {
        if (std::binary_search(here.begin(), here.end(), frame.frame)) done_.emplace(frame.frame, std::move(frame));
    };
    try {
        const bool has_record = read_record(folder_, record_name({}),
                                            {.head =
                                                 [&](const ReadJson& head) {
                                                     require_same(options_in(head));
                                                     return options_.resume && !here.empty();
                                                 },
                                             .frame =
                                                 [&](const ReadJson& entry) {
                                                     auto frame = accepted_frame(entry, options_);
                                                     const bool goes_on = !frame || frame->frame < here.back();
                                                     if (frame) take(std::move(*frame));
                                                     return goes_on;
                                                 }});
        if (!has_record && folder_.open_for_reading(sea_json_name).is_open()) throw DamagedRecord();
        const std::size_t max = max_record_bytes(options_);
        const auto journal = folder_.read_text(journal_name({}), max);
        if (!journal || journal->empty()) return;
        EarlierExport earlier = parse_journal(*journal, options_);
        require_same(earlier.options);
        if (options_.resume)
            for (auto& [number, frame] : earlier.frames) take(std::move(frame));
    } catch (const DamagedRecord&) {
        throw bad_value("--shard", text_of(*options_.shard),
                        "a folder for this export alone: " + record_name({}) + " or the journal in " +
                            folder_.path().string() + " is damaged or missing");
    }
}

bool ExportJournal::is_whole(const FrameRecord& record) const {
    for (const FileRecord& file : record.files) {
        Digest digest;
        const bool is_there = folder_.read(file.name, [&](std::string_view piece) {
            digest.add(piece);
            return true;
        });
        if (!is_there || digest.text() != file.xxh3) return false;
    }
    return true;
}

void ExportJournal::begin() {
    // Report files that cannot be replaced now, not after hours of work.
    folder_.check_writable(record_name_);
    if (!options_.shard) folder_.check_writable(sea_json_name);
    const Json header = {{"options", options_as_json(options_)}, {"replaced_files", earlier_images_}};
    std::string lines = header.dump() + "\n";
    for (const auto& [number, record] : done_) lines += frame_as_json(record).dump() + "\n";
    folder_.write(journal_name_, lines);
    folder_.sync();
    journal_ = folder_.open_for_lines(journal_name_);
    // A resumed export keeps its record until the end, because a command of `pelagic merge` or
    // `pelagic verify` reads the options from it. A shard keeps it too.
    if (options_.shard || options_.resume) return;
    folder_.remove(record_name_);
    folder_.remove(sea_json_name);
    folder_.sync();
}

void ExportJournal::add(const FrameRecord& record) {
    folder_.sync();
    folder_.append_line(journal_name_, journal_, frame_as_json(record).dump());
}

void ExportJournal::end(const std::vector<FrameRecord>& frames, const std::vector<FileRecord>& sequence_files) {
    const MakeFrames make_frames = [&](const auto& take) {
        for (const FrameRecord& frame : frames) take(frame);
    };
    if (options_.shard)
        write_record(folder_, record_name_, shard_head(options_), make_frames);
    else
        write_finished(folder_, options_, mean_significant_wave_height_m(frames), sequence_files, make_frames);
    folder_.sync();

    // Other shards have temporary files and records; `pelagic merge` removes theirs.
    if (!options_.shard) remove_stale_files(frames, sequence_files);
    journal_ = {};  // Windows would keep the name until then
    folder_.remove(journal_name_);
    folder_.sync();
}

void ExportJournal::remove_stale_files(const std::vector<FrameRecord>& frames,
                                       const std::vector<FileRecord>& sequence_files) {
    std::set<std::string> stale(earlier_images_.begin(), earlier_images_.end());
    if (options_.events) stale.erase(events_copy_name);
    for (const FrameRecord& frame : frames)
        for (const FileRecord& file : frame.files) stale.erase(file.name);
    for (const FileRecord& file : sequence_files) stale.erase(file.name);
    folder_.for_each_name([&](const std::string& name) {
        if (is_export_part(name, options_.maps.names) || is_of_shard(name)) stale.insert(name);
    });
    for (const std::string& name : stale) folder_.remove(name);
}

}  // namespace pelagic::tools
