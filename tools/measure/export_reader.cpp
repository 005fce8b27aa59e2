#include "pelagic/tools/measure/export_reader.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <system_error>

#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/encode/exr_header.hpp"
#include "pelagic/tools/encode/image_codec.hpp"
#include "pelagic/tools/encode/texture.hpp"
#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/frame_times.hpp"
#include "pelagic/tools/export/shard.hpp"
#include "pelagic/tools/files/open_file.hpp"
#include "pelagic/tools/record/export_record.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/path_text.hpp"

namespace pelagic::tools {
namespace {

/// Size limit of sea.json, in bytes: enough for more than 100,000 frames.
constexpr std::size_t max_sea_json_bytes = std::size_t{256} << 20;
constexpr int max_sea_json_levels = 8;  ///< sea.json has five levels

/// Limit of plausible heights, in metres. A larger value is not a height in metres.
constexpr float highest_m = 1e4f;

ReadJson parsed_sea_json(const std::string& text, const std::string& place) {
    bool is_deep = false;
    const auto check_depth = [&](int depth, ReadJson::parse_event_t, ReadJson&) {
        is_deep = is_deep || depth > max_sea_json_levels;
        return !is_deep;
    };
    const ReadJson json = ReadJson::parse(text, check_depth, false);
    if (json.is_discarded() || is_deep || !json.is_object())
        throw InputError(place + ": malformed JSON, expected a sea.json of pelagic export");
    return json;
}

/// Returns the image names of the frame's heights, of the coarsest cascade and of as many finer
/// ones as the frame lists, as the export names them. If files hold all maps, every cascade has the
/// same name.
std::vector<std::string> heights_names(const ReadJson& frame, const MapOptions& options, std::size_t max_cascades) {
    const ReadJson &files = value_of(frame, "files"), &number = value_of(frame, "frame");
    if (!files.is_array() || !number.is_number_unsigned() || number > FrameTimes::largest_number) return {};
    const auto is_listed = [&](const std::string& name) {
        return std::any_of(files.begin(), files.end(),
                           [&](const ReadJson& file) { return value_of(file, "name") == name; });
    };
    std::vector<std::string> names;
    if (options.pack != Pack::files) {
        if (const std::string name = packed_name(options, number.get<int>()); is_listed(name))
            names.assign(max_cascades, name);
        return names;
    }
    for (std::size_t cascade = 0; cascade < max_cascades; ++cascade) {
        const ImageMark mark{MapKind::displacement, static_cast<int>(cascade)};
        const std::string name = image_name(options, mark, number.get<int>(), files.size() == 1);
        if (!is_listed(name)) break;
        names.push_back(name);
    }
    return names;
}

/// Reads the storage of heights from the record's pixel description. An export without displacement
/// has none; another check rejects it.
StoredHeights stored_heights(const ReadJson& record, const std::filesystem::path& place) {
    StoredHeights stored;
    const auto reject = [&](const std::string& what) { return InputError(place.string() + ": " + what); };
    if (const ReadJson& rows = value_of(value_of(record, "export"), "rows"); !rows.is_null()) {
        if (rows != "top" && rows != "bottom") throw reject("export's rows are neither top nor bottom");
        stored.overturned_rows = rows == "bottom";
    }
    const ReadJson& channels = value_of(value_of(record, "channels"), "displacement");
    if (channels.is_null()) return stored;
    for (const ReadJson& channel : channels) {
        if (value_of(channel, "name") != "height") continue;
        const ReadJson &letter = value_of(channel, "channel"), &scale = value_of(channel, "scale");
        const std::size_t number =
            letter.is_string() ? std::string("RGB").find(letter.get<std::string>()) : std::string::npos;
        // The scale is 1 for metres, 0.01 for centimetres.
        if (number > 2 || letter.get<std::string>().size() != 1 || !scale.is_number() ||
            !(scale == 1 || scale == 0.01) || value_of(channel, "offset") != 0)
            throw reject("the channel of heights is none that pelagic export writes");
        stored.channel = number;
        stored.metres = scale.get<float>();
        return stored;
    }
    throw reject("displacement has no channel of heights");
}

/// Returns the options that determine the names of images. If the record has others, its images are
/// not found.
MapOptions naming_options_in(const ReadJson& record) {
    MapOptions options;
    const ReadJson& how = value_of(record, "export");
    for (const ImageFormat format : values_of<ImageFormat>())
        if (value_of(how, "format") == name_of(format)) options.format = format;
    for (const Pack pack : values_of<Pack>())
        if (value_of(how, "pack") == name_of(pack)) options.pack = pack;
    if (const ReadJson& names = value_of(how, "names"); names.is_string())
        options.names = NamePattern::parse(names.get<std::string>());
    return options;
}

}  // namespace

OutputFolder open_export(const std::string& option, const std::filesystem::path& folder, Sync sync) {
    constexpr const char* an_export = "a folder that pelagic export has written";
    std::error_code error;
    if (folder.empty()) throw InputError(option + " is empty, expected " + an_export);
    if (!std::filesystem::is_directory(any_length(folder), error))
        throw bad_value(option, folder.string(),
                        std::string(an_export) + (error ? " (" + error.message() + ")" : ""));
    if (const int reason = reason_against_reading(folder); reason != 0)
        throw bad_value(option, folder.string(), std::string(an_export) + " (" + std::strerror(reason) + ")");
    return OutputFolder(folder, sync);
}

ExportReader::ExportReader(std::string option, const std::filesystem::path& folder)
    : option_(std::move(option)), folder_(open_export(option_, folder, Sync::no)) {
    const std::filesystem::path place = folder / sea_json_name;
    const std::optional<std::string> text = folder_.read_text(sea_json_name, max_sea_json_bytes);
    if (!text) throw InputError(place.string() + " is missing: expected a finished export");
    if (text->size() > max_sea_json_bytes)
        throw InputError(place.string() + " has more than " + number_text(max_sea_json_bytes >> 20) + " MiB");
    const ReadJson record = parsed_sea_json(*text, place.string());
    sea_ = SeaOptions::of_record(*text, place);
    cascades_ = plan_cascades(forecast_of(sea_));
    stored_ = stored_heights(record, place);

    const MapOptions maps = naming_options_in(record);
    is_packed_ = maps.pack != Pack::files;
    if (maps.format == ImageFormat::dds)
        throw InputError(place.string() +
                         ": the maps are dds textures, expected an export with --format exr, tif or ktx2");
    if (is_packed_ && value_of(value_of(record, "channels"), "displacement").is_null())
        throw InputError(place.string() + " names no displacement, expected an export with --maps displacement");
    const ReadJson& frames = value_of(record, "frames");
    if (!frames.is_array() || frames.empty())
        throw InputError(place.string() + " has no frames, expected a finished export");
    frames_there_ = frames.size();
    std::vector<double> times_s;
    for (const ReadJson& frame : frames) {
        if (names_.size() == max_frames) break;
        const std::string where = place.string() + ": frame " + number_text(names_.size());
        const ReadJson& time = value_of(frame, "time_s");
        if (!time.is_number() || !std::isfinite(time.get<double>()))
            throw InputError(where + " has no time_s, expected a number");
        times_s.push_back(time.get<double>());
        names_.push_back(heights_names(frame, maps, cascades_.size()));
        if (names_.size() == 1) cascades_.resize(std::min(cascades_.size(), names_[0].size()));
        if (names_.back().empty() || names_.back().size() < cascades_.size())
            throw InputError(where + " names no displacement image, expected an export with --maps displacement");
    }
    if (times_s.size() < 2) return;
    step_s_ = (times_s.back() - times_s.front()) / static_cast<double>(times_s.size() - 1);
    for (std::size_t i = 0; i < times_s.size(); ++i) {
        const double off = std::fabs(times_s[i] - times_s.front() - static_cast<double>(i) * step_s_);
        if (!(step_s_ > 0) || off > 1e-3 * step_s_)
            throw InputError(place.string() +
                             ": frames are not equally far apart in time, expected them one after the other");
    }
}

std::string ExportReader::channel_of(std::size_t cascade) const {
    const std::string letter(1, "RGB"[stored_.channel]);
    if (!is_packed_) return letter;
    return std::string(name_of(MapKind::displacement)) + (cascade > 0 ? "_c" + number_text(cascade) : "") + "." +
           letter;
}

std::vector<float> ExportReader::heights(std::size_t frame, std::size_t cascade) const {
    const std::string& name = names_[frame][cascade];
    const int resolution = cascades_[cascade].resolution;
    const std::filesystem::path place = folder_.path() / name;
    const std::size_t texels = static_cast<std::size_t>(resolution) * resolution;
    // Compression does not increase the size this much. A texture has four channels and smaller
    // levels. A packed file may have all maps of all cascades; levels add a third.
    const std::size_t texel_bytes =
        is_packed_ ? all_maps.size() * 4 * cascades_.size() * 2 * sizeof(float) : 4 * 2 * sizeof(float);
    const std::size_t max_bytes = 2 * texels * texel_bytes + (std::size_t{1} << 20);
    const std::optional<std::string> file = folder_.read_text(name, max_bytes);
    if (!file) throw FileError("can't read " + place.string() + ": " + std::strerror(ENOENT));
    if (file->size() > max_bytes)
        throw FileError("can't read " + place.string() + ": it is larger than " + number_text(resolution) + " x " +
                        number_text(resolution) + " pixels can be");
    const ImageDescription image{.extension = name.ends_with(".tif") ? "tif" : "exr",
                                 .width = resolution,
                                 .height = resolution,
                                 .channels = 0,
                                 .sample = Sample::float32,
                                 .colour_space = "Linear",
                                 .compression = nullptr};
    std::vector<float> heights(texels);
    try {
        const std::span<const unsigned char> bytes(reinterpret_cast<const unsigned char*>(file->data()),
                                                   file->size());
        const auto pixels = [&] {
            if (name.ends_with(".ktx2")) return ktx2_channel(bytes, resolution, stored_.channel);
            if (!name.ends_with(".tif")) read_exr_header(bytes);
            return image_codec().decode_channel(image, bytes, channel_of(cascade).c_str());
        }();
        const auto side = static_cast<std::size_t>(resolution);
        for (std::size_t j = 0; j < side; ++j) {
            const std::size_t row = stored_.overturned_rows ? side - 1 - j : j;
            for (std::size_t i = 0; i < side; ++i) heights[j * side + i] = stored_.metres * pixels[row * side + i];
        }
    } catch (const FileError&) {
        throw;  // the library itself is missing
    } catch (const std::runtime_error& error) {
        throw FileError("can't read " + place.string() + ": " + error.what());
    }
    for (const float height : heights)
        if (!(std::fabs(height) <= highest_m))
            throw FileError("can't read " + place.string() + ": it holds " + number_text(height) +
                            ", which is no height in metres");
    return heights;
}

}  // namespace pelagic::tools
