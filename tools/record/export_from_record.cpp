#include "pelagic/tools/record/export_from_record.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/path_text.hpp"

namespace pelagic::tools {
namespace {

/// Keys whose values are computed from other options.
constexpr std::array<std::string_view, 2> no_flags = {"mesh_cascades", "events_xxh3"};

/// Writes a single frame number as a range, because the option reads one number as a frame count.
std::string as_list(const std::string& numbers) {
    return numbers.find_first_of("-,") == std::string::npos ? numbers + "-" + numbers : numbers;
}

/// Returns the path in a form that is not parsed as an option.
std::string path_word(const std::filesystem::path& path) {
    if (path.empty()) return ".";
    return path.string().starts_with('-') ? "./" + path.string() : path.string();
}

/// Appends the arguments for a key of the object "export" in a record, whose value may be anything.
/// words_in() handles other keys itself.
void add_words(std::vector<std::string>& words, const std::string& key, const Json& value) {
    if (std::find(no_flags.begin(), no_flags.end(), key) != no_flags.end()) return;
    if (value.is_object()) {
        for (const auto& [inner, inner_value] : value.items()) {
            if (inner_value.is_object()) throw DamagedRecord();
            add_words(words, key + "_" + inner, inner_value);
        }
    } else if (!value.is_boolean()) {
        words.insert(words.end(), {flag_of(key), typed_value(value)});
    } else if (value.get<bool>()) {
        words.push_back(flag_of(key));
    }
}

/// Returns the arguments for all keys, except those with default values: a default may have no
/// valid argument, such as the compression where no file has one. The frame numbers and the file
/// names are options that depend on several keys.
std::vector<std::string> words_in(const Json& how, const std::filesystem::path& folder) {
    if (!how.is_object()) throw DamagedRecord();
    std::filesystem::path out = folder;
    if (how.contains("names")) out /= path_of(typed_value(how["names"])).filename();
    std::vector<std::string> words = {"--out", path_word(out)};
    const bool is_list = how.contains("frame_numbers"), is_loop = how.contains("loop");
    // The record contains the digest of the events file beside it.
    if (how.contains("events_xxh3")) words.insert(words.end(), {"--events", path_word(folder / events_copy_name)});
    const Json usual = options_as_json({})["export"];
    // Their default bit depth is that of a format and a pack.
    const Json maps = how.value("maps", Json());
    const bool has_normals = maps.is_array() && std::find(maps.begin(), maps.end(), "normal") != maps.end();
    for (const auto& [key, value] : how.items()) {
        if (key == "names" || key == "loop" || (key == "frames" && is_list)) continue;
        if (key == "frame_numbers")
            words.insert(words.end(), {"--frames", as_list(typed_value(value))});
        else if (key == "frames")
            words.insert(words.end(), {is_loop ? "--loop-frames" : "--frames", typed_value(value)});
        else if (!usual.contains(key) || usual[key] != value || (key == "bit_depth" && has_normals))
            add_words(words, key, value);
    }
    return words;
}

#if defined(_WIN32)
// cmd and PowerShell; programs split their command line at \"
constexpr const char *plain_letters = "-_./,=:+@\\", *quote = "\"", *quote_within = "\\\"";
#else
constexpr const char *plain_letters = "-_./,=:+@%", *quote = "'", *quote_within = "'\\''";
#endif

/// Quotes a word for the shells of the system.
std::string quoted(const std::string& word) {
    constexpr const char* letters_and_digits = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    const bool is_plain = !word.empty() && word.find_first_not_of(std::string(letters_and_digits) + plain_letters) ==
                                               std::string::npos;
    if (is_plain) return word;
    std::string text = quote;
    for (const char letter : word) letter == *quote ? text += quote_within : text += letter;
    return text + quote;
}

void require_this_version(const ReadJson& options, const std::filesystem::path& file) {
    const ReadJson& version = options["version"];
    if (!version.is_string()) throw DamagedRecord();
    if (version == PELAGIC_VERSION) return;
    throw InputError(file.string() + " was written by pelagic " + version.get<std::string>().substr(0, 20) +
                     ", expected one that this pelagic, " PELAGIC_VERSION ", has written");
}

/// Keys whose names differ from their options.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> other_flags = {
    {{"mesh_formats", "--mesh"},
     {"mesh_side_m", "--mesh-size"},
     {"mesh_cascades", "--mesh-size"},
     {"events_xxh3", "--events"},
     {"frame_numbers", "--frames"},
     {"loop", "--loop-frames"},
     {"names", "--out"}}};

std::string flag_without_unit(std::string key, std::initializer_list<std::string_view> units) {
    for (const std::string_view unit : units)
        if (key.ends_with(unit)) {
            key.resize(key.size() - unit.size());
            break;
        }
    std::replace(key.begin(), key.end(), '_', '-');
    return "--" + key;
}

}  // namespace

ExportOptions options_of_record(const ReadJson& head, const std::filesystem::path& file) {
    const ReadJson recorded = options_in(head);
    require_this_version(recorded, file);

    CLI::App app;
    ExportFlags flags;
    flags.add_to(app);
    const std::vector<std::string> words = words_in(Json(recorded["export"]), file.parent_path());
    ExportOptions options;
    try {
        // CLI11 expects the words in reverse order
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
        options = flags.resolve_with(SeaOptions::of_record(recorded.dump(), file));
    } catch (const CLI::Error& error) {
        throw InputError(file.string() + ": export: " + error.what());
    } catch (const InputError& error) {
        const std::string what = error.what();
        throw what.starts_with(file.string()) ? error : InputError(file.string() + ": export: " + what);
    }
    if (const Json now = options_as_json(options); recorded != ReadJson(now))
        throw InputError(file.string() + ": its options are not those of an export: " +
                         first_option_difference(recorded, now).is_not());
    return options;
}

std::vector<std::string> words_of(const ExportOptions& options) {
    return words_in(options_as_json(options)["export"], options.folder);
}

std::string command_line_of(const ExportOptions& options, const std::filesystem::path& record) {
    std::vector<std::string> words = {"pelagic", "export"};
    words.insert(words.end(), {options.sea.changes.empty() ? "--config" : "--weather", path_word(record)});
    for (std::string& word : words_of(options)) words.push_back(std::move(word));
    if (options.shard) words.insert(words.end(), {"--shard", text_of(*options.shard)});
    if (options.resume) words.push_back("--resume");
    if (options.overwrite) words.push_back("--overwrite");
    if (!options.sync) words.push_back("--no-sync");
    if (!options.lock) words.push_back("--no-lock");
    std::string line;
    for (const std::string& word : words) line.append(line.empty() ? "" : " ").append(quoted(word));
    return line;
}

std::string flag_of(const std::string& key) {
    for (const auto& [other_key, flag] : other_flags)
        if (key == other_key) return std::string(flag);
    return flag_without_unit(key, {"_mps", "_s", "_m"});
}

std::string flag_at(std::string_view pointer) {
    std::string key(pointer.substr(std::min<std::size_t>(1, pointer.size())));
    const auto remove = [&](std::string_view start) {
        if (!key.starts_with(start)) return false;
        key.erase(0, start.size());
        return true;
    };
    if (remove("weather")) return "--weather";
    if (remove("sea/systems")) return "--system";
    if (remove("sea/")) return flag_without_unit(key, {"_mps", "_deg", "_m", "_s"});
    if (!remove("export/")) return key;
    std::replace(key.begin(), key.end(), '/', '_');
    return flag_of(key);
}

std::string typed_value(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (!value.is_array()) return value.dump();
    std::string list;
    for (const Json& item : value) list.append(list.empty() ? "" : ",").append(typed_value(item));
    return list.empty() ? "none" : list;
}

}  // namespace pelagic::tools
