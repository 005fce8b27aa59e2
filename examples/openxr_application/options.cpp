#include "options.hpp"

#include <charconv>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

namespace openxr_application {
namespace {

constexpr const char* usage =
    "needs [--preset NAME] [--resolution N] [--quality NAME] [--frames N] [--images FOLDER] [--hashes FILE]";

int whole_number(std::string_view option, std::string_view text, int min) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size() || number < min)
        throw std::invalid_argument(std::string(option) + " is " + std::string(text) +
                                    ", expected a whole number from " + std::to_string(min));
    return number;
}

template <class Preset>
Preset one_named(std::string_view option, std::string_view name, std::span<const Preset> presets) {
    std::string names;
    for (const Preset& preset : presets) {
        if (preset.name == name) return preset;
        names += (names.empty() ? "" : ", ") + std::string(preset.name);
    }
    throw std::invalid_argument(std::string(option) + " is " + std::string(name) + ", expected one of " + names);
}

std::filesystem::path folder(std::string_view option, std::string_view name) {
    if (!std::filesystem::is_directory(name))
        throw std::invalid_argument(std::string(option) + " is " + std::string(name) +
                                    ", expected a folder that is there");
    return name;
}

std::filesystem::path file(std::string_view option, std::string_view name) {
    const std::filesystem::path file = name;
    const bool has_folder = !file.has_parent_path() || std::filesystem::is_directory(file.parent_path());
    if (!file.has_filename() || !has_folder || std::filesystem::is_directory(file))
        throw std::invalid_argument(std::string(option) + " is " + std::string(name) +
                                    ", expected the name of a file in a folder that is there");
    return file;
}

}  // namespace

Options options_of(int count, char** arguments) {
    std::string_view preset = "moderate", quality = "medium";
    Options options;
    int resolution = 128;
    for (int i = 1; i < count; i += 2) {
        const std::string_view option = arguments[i];
        if (i + 1 == count) throw std::invalid_argument(std::string(option) + " has no value; " + usage);
        const std::string_view value = arguments[i + 1];
        if (option == "--preset")
            preset = value;
        else if (option == "--resolution")
            resolution = whole_number(option, value, 0);
        else if (option == "--quality")
            quality = value;
        else if (option == "--frames")
            options.frames = whole_number(option, value, 1);
        else if (option == "--images")
            options.images = folder(option, value);
        else if (option == "--hashes")
            options.hashes = file(option, value);
        else
            throw std::invalid_argument(std::string(option) + " is no option; " + usage);
    }
    options.sea = one_named("--preset", preset, pelagic::sea_presets()).sea;
    options.quality = one_named("--quality", quality, pelagic::quadtree_presets());
    options.sea.resolution = resolution;
    if (const std::string reason = check(options.sea); !reason.empty()) throw std::invalid_argument("--" + reason);
    return options;
}

}  // namespace openxr_application
