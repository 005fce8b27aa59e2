#include "pelagic/tools/export_journal.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <fstream>
#include <iterator>
#include <optional>
#include <set>

#include "pelagic/tools/atomic_file.hpp"
#include "pelagic/tools/errors.hpp"

namespace pelagic::tools {
namespace {

bool is_image(const std::string& name) { return name.starts_with("displacement_") || name.starts_with("gradient_"); }

std::optional<std::string> file_hash(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return {};
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    return xxh3_text(bytes.data(), bytes.size());
}

/// "wind_speed_mps was 9 and is 12", for the first value that differs.
std::string first_difference(const Json& earlier, const Json& now) {
    const Json was = earlier.flatten(), is = now.flatten();
    const auto text_of = [](const Json& values, const std::string& key) {
        return values.contains(key) ? values.at(key).dump() : "not set";
    };
    for (const Json& values : {is, was})
        for (const auto& [key, value] : values.items())
            if (text_of(was, key) != text_of(is, key))
                return key.substr(key.rfind('/') + 1) + " was " + text_of(was, key) + " and is " + text_of(is, key);
    return {};
}

/// What an earlier export recorded: its options, its frames in any order, and files that it was about to replace.
struct Earlier {
    Json options;
    std::vector<FrameRecord> frames;
    std::vector<std::string> replaced_files;
};

std::optional<Earlier> read_journal(const std::filesystem::path& file) {
    std::ifstream stream(file);
    std::string line;
    if (!std::getline(stream, line)) return {};
    const Json header = Json::parse(line);
    Earlier earlier{header.at("options"), {}, header.at("replaced_files")};
    while (std::getline(stream, line)) {
        // A line may be torn if the export was killed while writing it: its frame does not count.
        const Json record = Json::parse(line, nullptr, false);
        if (!record.is_discarded()) earlier.frames.push_back(frame_from_json(record));
    }
    return earlier;
}

std::optional<Earlier> read_sea_json(const std::filesystem::path& file) {
    std::ifstream stream(file);
    if (!stream) return {};
    const Json json = Json::parse(stream);
    Earlier earlier{
        {{"version", json.at("version")}, {"sea", json.at("sea")}, {"export", json.at("export")}}, {}, {}};
    for (const Json& frame : json.at("frames")) earlier.frames.push_back(frame_from_json(frame));
    return earlier;
}

}  // namespace

bool is_export_file(const std::string& name) {
    return name == journal_name || name == sea_json_name || is_image(name);
}

std::string xxh3_text(const void* bytes, std::size_t size) { return hex_text(XXH3_64bits(bytes, size)); }

ExportJournal::ExportJournal(const ExportOptions& options)
    : options_(options), journal_(options.folder / journal_name), sea_json_(options.folder / sea_json_name) {
    read_earlier(options.resume);
    forget_torn_frames();
}

void ExportJournal::read_earlier(bool resume) {
    std::optional<Earlier> earlier;
    try {
        earlier = read_journal(journal_);
        if (!earlier) earlier = read_sea_json(sea_json_);
    } catch (const nlohmann::json::exception&) {
        if (resume)
            throw InputError("--resume is not possible in " + options_.folder.string() +
                             ", whose sea.json or journal is damaged; without it the export starts anew");
        return;
    }
    if (!earlier) return;

    earlier_files_ = earlier->replaced_files;
    for (const FrameRecord& frame : earlier->frames)
        for (const FileRecord& file : frame.files) earlier_files_.push_back(file.name);
    if (!resume) return;
    const Json now = options_as_json(options_);
    if (earlier->options != now)
        throw InputError("--resume is not possible in " + options_.folder.string() +
                         ", whose export had other options: " + first_difference(earlier->options, now));
    for (FrameRecord& frame : earlier->frames) done_[frame.frame] = std::move(frame);
}

void ExportJournal::forget_torn_frames() {
    std::erase_if(done_, [&](const auto& entry) {
        for (const FileRecord& file : entry.second.files)
            if (file_hash(options_.folder / file.name) != file.xxh3) return true;
        return false;
    });
}

void ExportJournal::begin() {
    const Json header = {{"options", options_as_json(options_)}, {"replaced_files", earlier_files_}};
    std::string lines = header.dump() + "\n";
    for (const auto& [number, record] : done_) lines += frame_as_json(record).dump() + "\n";
    write_whole_file(journal_, lines);
    std::filesystem::remove(sea_json_);
}

void ExportJournal::add(const FrameRecord& record) { append_line(journal_, frame_as_json(record).dump()); }

void ExportJournal::end(const std::vector<FrameRecord>& frames) {
    write_whole_file(sea_json_, sea_json(options_, frames).dump(2) + "\n");

    std::set<std::string> made;
    for (const FrameRecord& frame : frames)
        for (const FileRecord& file : frame.files) made.insert(file.name);
    std::error_code ignored;
    for (const std::string& name : earlier_files_) {
        // Only plain names that an export could have made: a sea.json is a file that anybody may have edited.
        if (is_image(name) && name.find('/') == std::string::npos && !made.contains(name))
            std::filesystem::remove(options_.folder / name, ignored);
    }
    for (const std::string& name : made) std::filesystem::remove(part_name(options_.folder / name), ignored);
    std::filesystem::remove(journal_, ignored);
}

}  // namespace pelagic::tools
