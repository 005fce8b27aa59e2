#include "pelagic/tools/options/floor_options.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <utility>
#include <vector>

#include "pelagic/tools/encode/exr_header.hpp"
#include "pelagic/tools/encode/image_codec.hpp"
#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/files/open_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/path_text.hpp"
#include "pelagic/tools/text/progress.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* an_image = "a PNG or EXR image, each side from 2 to 4096 pixels";
constexpr std::size_t max_depth_image_bytes = std::size_t{256} << 20;
constexpr double default_size_m = 1000, default_low_m = -20, default_high_m = 10;

std::pair<double, double> two_numbers(const char* option, const std::string& text, double max, const char* accepted) {
    const std::vector<std::string> numbers = split_at_commas(text);
    const auto first = parse_number(numbers[0]), second = parse_number(numbers.size() == 2 ? numbers[1] : "");
    if (!first || !second || std::abs(*first) > max || std::abs(*second) > max)
        throw bad_value(option, text, accepted);
    return {*first, *second};
}

/// Limits memory: all channels are decoded, but only the first is used.
void require_few_channels(std::size_t channels) {
    constexpr std::size_t max = 4;
    if (channels > max)
        throw std::runtime_error("it has " + number_text(channels) + " channels, expected at most " +
                                 number_text(max));
}

/// Returns the first channel of an image: 0 (black) to 1 (white) of a PNG, the stored values of an
/// EXR.
ShoreOptions read_heights(const std::string& file, const std::string& extension) {
    const std::string bytes = InputFile("--floor", path_of(file), an_image).read_all(max_depth_image_bytes);
    const std::span<const unsigned char> data(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
    ShoreOptions field;
    try {
        const SilentStderr libraries;
        ImageDescription image{.extension = extension.c_str(),
                               .width = 0,
                               .height = 0,
                               .channels = 0,
                               .sample = Sample::float32,
                               .colour_space = nullptr,
                               .compression = nullptr};
        if (extension == "exr") require_few_channels(read_exr_header(data).channels);
        image_codec().measure(image, data);
        require_few_channels(static_cast<std::size_t>(image.channels));
        constexpr int max = ShoreOptions::max_samples_per_side;
        if (image.width < 2 || image.width > max || image.height < 2 || image.height > max)
            throw std::runtime_error("it has " + number_text(image.width) + " x " + number_text(image.height) +
                                     " pixels");
        const std::vector<float> pixels = image_codec().decode(image, data);
        field.columns = image.width;
        field.rows = image.height;
        for (std::size_t i = 0; i < pixels.size(); i += static_cast<std::size_t>(image.channels))
            field.heights_m.push_back(pixels[i]);
    } catch (const FileError&) {
        throw;
    } catch (const std::runtime_error& error) {
        const std::string reason = error.what();  // some readers add a line for each of their functions
        throw bad_value("--floor", file, std::string(an_image) + " (" + reason.substr(0, reason.find('\n')) + ")");
    }
    return field;
}

}  // namespace

void FloorFlags::add_to(CLI::App& app) {
    const auto add = [&](const char* name, std::optional<std::string>& typed, const char* type, const char* help) {
        app.add_option(name, typed, help)->type_name(type)->group(help_group::floor);
    };
    add("--floor", file_, "FILE.png|exr", "image of the sea floor's heights (default: a flat floor at --depth)");
    add("--floor-size", size_, "METRES", "width of the image in the world; [1, 1e6] (default: 1000)");
    add("--floor-middle", middle_, "X,Z", "centre of the image in metres (default: 0,0)");
    add("--floor-heights", heights_, "LOW,HIGH",
        "heights of a PNG's black and white in metres above still water; an EXR holds metres (default: -20,10)");
    app.add_flag("--shore", shore_, "apply shoaling, refraction, breaking and sheltering by --floor")
        ->group(help_group::floor);
}

std::string FloorFlags::typed() const {
    std::string text;
    for (const auto& [option, value] :
         {std::pair{" --floor ", &file_}, std::pair{" --floor-size ", &size_},
          std::pair{" --floor-middle ", &middle_}, std::pair{" --floor-heights ", &heights_}})
        if (*value) text += option + **value;
    if (shore_) text += " --shore";
    return text;
}

FloorOptions FloorFlags::resolve(const ResolvedSea& sea) const {
    if (!file_) {
        if (shore_) throw InputError("--shore requires --floor FILE, the heights of the sea floor");
        for (const auto& [option, text] : {std::pair{"--floor-size", &size_}, std::pair{"--floor-middle", &middle_},
                                           std::pair{"--floor-heights", &heights_}})
            if (*text) throw bad_value(option, **text, "--floor beside it");
        return {};
    }
    if (shore_ && !sea.changes.empty()) throw InputError("--shore cannot be combined with --weather");
    FloorOptions floor{.field = read_field(), .waves_feel_it = shore_};
    // The field has been checked, so that check() can only report a field of the sea, named as its
    // flag.
    if (shore_) {
        if (const std::string reason = check(*floor.field, sea.sea); !reason.empty()) throw InputError("--" + reason);
        if (const std::string warning = warning_about(*floor.field, sea.sea); !warning.empty())
            print_note(warning + "; --floor-size sets them");
    }
    return floor;
}

ShoreOptions FloorFlags::read_field() const {
    std::string extension = path_of(*file_).extension().string();
    if (!extension.empty()) extension.erase(0, 1);
    std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
    if (extension != "png" && extension != "exr") throw bad_value("--floor", *file_, an_image);
    const double size_m = size_ ? number_in("--floor-size", *size_, 1, 1e6, "metres in [1, 1e6]") : default_size_m;
    const auto [x, z] = middle_ ? two_numbers("--floor-middle", *middle_, 1e7, "X,Z in metres, each in [-1e7, 1e7]")
                                : std::pair{0.0, 0.0};
    const char* const two_heights = "LOW,HIGH in metres above rest, -11000 <= LOW < HIGH <= 9000";
    if (heights_ && extension == "exr") throw bad_value("--floor-heights", *heights_, "a PNG: an EXR holds metres");
    const auto [low, high] = heights_ ? two_numbers("--floor-heights", *heights_, 11000, two_heights)
                                      : std::pair{default_low_m, default_high_m};
    if (!(low < high) || high > 9000) throw bad_value("--floor-heights", *heights_, two_heights);

    ShoreOptions field = read_heights(*file_, extension);
    field.metres_per_sample = size_m / field.columns;
    field.corner_x_m = x - 0.5 * field.metres_per_sample * (field.columns - 1);
    field.corner_z_m = z - 0.5 * field.metres_per_sample * (field.rows - 1);
    if (extension == "png")
        for (float& height : field.heights_m) height = static_cast<float>(low + height * (high - low));
    if (const std::string reason = check(field); !reason.empty())
        throw bad_value("--floor", *file_, "heights in metres (" + reason + ")");
    return field;
}

}  // namespace pelagic::tools
