#include "pelagic/tools/record/export_record.hpp"

#include <algorithm>
#include <functional>
#include <optional>

#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/image_files.hpp"
#include "pelagic/tools/export/mesh_files.hpp"
#include "pelagic/tools/files/digest.hpp"
#include "pelagic/tools/record/export_from_record.hpp"

namespace pelagic::tools {
namespace {

/// Maximum depth of JSON; records have five levels. Some functions of the library recurse for each
/// level.
constexpr int max_record_levels = 8;

ReadJson parsed_record(std::string_view text) {
    const auto check_depth = [](int depth, ReadJson::parse_event_t, ReadJson&) {
        if (depth > max_record_levels) throw DamagedRecord();
        return true;
    };
    try {
        return ReadJson::parse(text.begin(), text.end(), check_depth);
    } catch (const ReadJson::exception&) {
        throw DamagedRecord();
    }
}

std::string text_or_empty(const ReadJson& json) { return json.is_string() ? json.get<std::string>() : std::string(); }
double number_or_zero(const ReadJson& json) { return json.is_number() ? json.get<double>() : 0; }

/// Returns the file names of a frame, in the order of the records.
std::vector<std::string> file_names(const ExportOptions& options, int frame) {
    std::vector<std::string> names;
    for (const ImageFile& file : image_files(options, frame)) names.push_back(file.name);
    for (const MeshFile& file : mesh_files(options, frame)) names.push_back(file.name);
    return names;
}

}  // namespace

const ReadJson& value_of(const ReadJson& json, const std::string& key) {
    static const ReadJson none;
    if (!json.is_object()) return none;
    const auto found = json.find(key);
    return found == json.end() ? none : *found;
}

std::optional<FrameRecord> accepted_frame(const ReadJson& entry, const ExportOptions& options) {
    const ReadJson& number = value_of(entry, "frame");
    if (!number.is_number_unsigned() || number.get<std::uint64_t>() > FrameTimes::largest_number ||
        !options.times.contains(number.get<int>()))
        return {};
    const bool has_foam = options.has_foam();
    FrameRecord record{
        .frame = number.get<int>(),
        .time_s = options.times.time_of(number.get<int>()),
        .hash = text_or_empty(value_of(entry, "hash")),
        .foam_hash = has_foam ? text_or_empty(value_of(entry, "foam_hash")) : "",
        .dynamic_waves_hash = options.events ? text_or_empty(value_of(entry, "dynamic_waves_hash")) : "",
        .significant_wave_height_m = number_or_zero(value_of(entry, "significant_wave_height_m")),
        .height_min_m = number_or_zero(value_of(entry, "height_min_m")),
        .height_max_m = number_or_zero(value_of(entry, "height_max_m")),
        .files = {}};
    const ReadJson& files = value_of(entry, "files");
    const std::vector<std::string> names = file_names(options, record.frame);
    if (files.size() != names.size() || has_foam == record.foam_hash.empty() ||
        options.events.has_value() == record.dynamic_waves_hash.empty())
        return {};
    for (std::size_t i = 0; i < names.size(); ++i)
        record.files.push_back({names[i], files.is_array() ? text_or_empty(value_of(files[i], "xxh3")) : ""});
    // The time and the names in `record` are computed here, so an entry with others differs. The
    // digest in the entry must match too.
    if (entry != ReadJson(frame_as_json(record))) return {};
    return record;
}

ReadJson options_in(const ReadJson& head) {
    ReadJson options = ReadJson::object();
    for (const char* key : {"version", "sea", "export"}) {
        if (value_of(head, key).is_null()) throw DamagedRecord();
        options[key] = value_of(head, key);
    }
    if (const ReadJson& weather = value_of(head, "weather"); !weather.is_null()) options["weather"] = weather;
    return options;
}

namespace {

void take_name(const ReadJson& name, const ExportOptions& options, EarlierExport& earlier) {
    if (std::string text = text_or_empty(name); is_image_name(text, options.maps.names) ||
                                                is_mesh_name(text, options.maps.names) || is_flipbook_name(text) ||
                                                text == events_copy_name)
        earlier.images.push_back(std::move(text));
}

void take_frame(const ReadJson& entry, const ExportOptions& options, EarlierExport& earlier) {
    const ReadJson& files = value_of(entry, "files");
    if (files.is_array())
        for (const ReadJson& file : files) take_name(value_of(file, "name"), options, earlier);
    if (auto record = accepted_frame(entry, options))
        earlier.frames.insert_or_assign(record->frame, std::move(*record));
}

std::string_view next_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
}

std::string clipped(std::string text) {
    constexpr std::size_t longest = 60;
    if (text.size() > longest) text = text.substr(0, longest) + "...";
    return text;
}

}  // namespace

EarlierExport parse_journal(std::string_view text, const ExportOptions& options) {
    const ReadJson header = parsed_record(next_line(text));
    EarlierExport earlier{value_of(header, "options"), {}, {}};
    const ReadJson& replaced = value_of(header, "replaced_files");
    if (!earlier.options.is_object() || !replaced.is_array()) throw DamagedRecord();
    for (const ReadJson& name : replaced) take_name(name, options, earlier);
    while (!text.empty()) try {
            take_frame(parsed_record(next_line(text)), options, earlier);
        } catch (const DamagedRecord&) {
            // The last line is incomplete if the export was killed while it wrote the line. Ignore
            // the frame.
        }
    return earlier;
}

EarlierExport parse_sea_json(std::string_view text, const ExportOptions& options) {
    const ReadJson json = parsed_record(text);
    const ReadJson& frames = value_of(json, "frames");
    EarlierExport earlier{options_in(json), {}, {}};
    if (!frames.is_array()) throw DamagedRecord();
    for (const ReadJson& frame : frames) take_frame(frame, options, earlier);
    if (const ReadJson& files = value_of(json, "sequence_files"); files.is_array())
        for (const ReadJson& file : files) take_name(value_of(file, "name"), options, earlier);
    return earlier;
}

std::size_t max_record_bytes(const ExportOptions& options) {
    constexpr std::size_t usual = std::size_t{64} << 20;
    constexpr std::size_t bytes_per_frame = 1000, bytes_per_file = 200;  // twice the size of an entry
    const std::size_t files = file_names(options, 0).size();
    return std::max(usual, options.times.count() * (bytes_per_frame + files * bytes_per_file));
}

OptionDifference first_difference(const ReadJson& earlier, const Json& now) {
    const Json ordered = now.flatten();  // keeps the order of the options
    const ReadJson was = earlier.flatten(), is = ReadJson(ordered);
    std::vector<std::string> keys;
    for (const auto& [key, value] : ordered.items()) keys.push_back(key);
    for (const auto& [key, value] : was.items()) keys.push_back(key);
    const auto text = [](const ReadJson& value) {
        return value.is_null() ? "not set" : clipped(value.dump(-1, ' ', true));
    };
    for (const std::string& key : keys)
        if (const ReadJson& before = value_of(was, key), &after = value_of(is, key); before != after)
            return {clipped(key.substr(key.rfind('/') + 1)), text(before), text(after)};
    return {"something", "other", "as here"};
}

OptionDifference first_option_difference(const ReadJson& earlier, const Json& now) {
    const ReadJson is(now);
    const auto in = [](const ReadJson& json, const Json::json_pointer& at) {
        const ReadJson::json_pointer pointer(at.to_string());
        return json.contains(pointer) ? json.at(pointer) : ReadJson();
    };
    const auto text = [](const ReadJson& value) {
        return value.is_null() ? "not set" : clipped(typed_value(Json(value)));
    };
    const auto difference = [&](const Json::json_pointer& at) {
        return OptionDifference{clipped(flag_at(at.to_string())), text(in(earlier, at)), text(in(is, at))};
    };
    // A list is one option, and all changes of the weather together are one.
    const auto is_option = [](const Json& value) { return !value.is_object(); };
    std::optional<OptionDifference> found;
    const std::function<void(const Json&, const Json::json_pointer&)> visit = [&](const Json& object,
                                                                                  const Json::json_pointer& at) {
        for (const auto& [key, value] : object.items()) {
            if (found) return;
            if (!is_option(value))
                visit(value, at / key);
            else if (in(earlier, at / key) != in(is, at / key))
                found = difference(at / key);
        }
    };
    visit(now, Json::json_pointer());
    // options that only the earlier export has
    if (!found) visit(Json(earlier), Json::json_pointer());
    return found ? *found : OptionDifference{"something", "other", "as here"};
}

}  // namespace pelagic::tools
