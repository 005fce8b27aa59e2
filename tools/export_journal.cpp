#include "pelagic/tools/export_journal.hpp"

#include <optional>
#include <set>
#include <utility>

#include "pelagic/tools/digest.hpp"
#include "pelagic/tools/errors.hpp"
#include "pelagic/tools/export_names.hpp"

namespace pelagic::tools {

ExportJournal::ExportJournal(const ExportOptions& options, const OutputFolder& folder)
    : options_(options), folder_(folder) {
    read_earlier();
    std::erase_if(done_, [&](const auto& entry) { return !is_whole(entry.second); });
}

void ExportJournal::read_earlier() {
    const std::size_t most = most_record_bytes(options_);
    const auto text_of = [&](const char* name) {
        auto text = folder_.read_text(name, most);
        if (text && text->size() > most) throw DamagedRecord();
        return text;
    };
    std::optional<EarlierExport> earlier;
    try {
        if (const auto journal = text_of(journal_name); journal && !journal->empty())
            earlier = parse_journal(*journal, options_);
        else if (const auto sea_json = text_of(sea_json_name))
            earlier = parse_sea_json(*sea_json, options_);
    } catch (const DamagedRecord&) {
        if (!options_.resume) return;
        throw InputError("--resume is not possible in " + folder_.path().string() +
                         ", whose sea.json or journal is damaged; without it the export starts anew");
    }
    if (!earlier) return;

    earlier_images_ = std::move(earlier->images);
    if (!options_.resume) return;
    if (const Json now = options_as_json(options_); earlier->options != ReadJson(now))
        throw InputError("--resume is not possible in " + folder_.path().string() +
                         ", whose export had other options: " + first_difference(earlier->options, now));
    done_ = std::move(earlier->frames);
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
    // What can't be replaced is said now, not after hours of work.
    folder_.check_writable(sea_json_name);
    const Json header = {{"options", options_as_json(options_)}, {"replaced_files", earlier_images_}};
    std::string lines = header.dump() + "\n";
    for (const auto& [number, record] : done_) lines += frame_as_json(record).dump() + "\n";
    folder_.write(journal_name, lines);
    folder_.sync();
    journal_ = folder_.open_for_lines(journal_name);
    folder_.remove(sea_json_name);
    folder_.sync();
}

void ExportJournal::add(const FrameRecord& record) {
    folder_.sync();
    folder_.append_line(journal_name, journal_, frame_as_json(record).dump());
}

void ExportJournal::end(const std::vector<FrameRecord>& frames, const std::vector<FileRecord>& sequence_files) {
    folder_.write(sea_json_name, sea_json(options_, frames, sequence_files).dump(2) + "\n");
    folder_.sync();

    std::set<std::string> made;
    for (const FrameRecord& frame : frames)
        for (const FileRecord& file : frame.files) made.insert(file.name);
    for (const FileRecord& file : sequence_files) made.insert(file.name);
    for (const std::string& name : earlier_images_) {
        folder_.remove(part_name(name));
        if (!made.contains(name)) folder_.remove(name);
    }
    for (const std::string& name : made) folder_.remove(part_name(name));
    folder_.remove(journal_name);
    folder_.sync();
}

}  // namespace pelagic::tools
