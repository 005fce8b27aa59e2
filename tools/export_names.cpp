#include "pelagic/tools/export_names.hpp"

#include <array>
#include <cstdio>
#include <regex>

namespace pelagic::tools {
namespace {

std::string image_name(const char* map, int tile, int frame, int level, const char* extension) {
    std::array<char, 16> number;
    std::snprintf(number.data(), number.size(), "%04d", frame);
    std::string name = map;
    if (tile > 0) name += "_c" + std::to_string(tile);
    name.append("_").append(number.data());
    if (level > 0) name += "_mip" + std::to_string(level);
    return name + "." + extension;
}

int levels_of_a_chain(const ExportOptions& options) {
    return options.mips ? mip_levels(resolution_of(options.sea.sea)) : 1;
}

}  // namespace

std::string displacement_name(const ExportOptions& options, int tile, int frame) {
    return image_name("displacement", tile, frame, 0, displacement_extension(options.format));
}

std::string gradient_name(const ExportOptions& options, int tile, int frame, int level) {
    return image_name("gradient", tile, frame, level, gradient_extension(options.format));
}

std::string foam_name(const ExportOptions& options, int tile, int frame, int level) {
    return image_name("foam", tile, frame, level, gradient_extension(options.format));
}

int gradient_levels(const ExportOptions& options) { return options.gradient ? levels_of_a_chain(options) : 0; }
int foam_levels(const ExportOptions& options) { return options.foam ? levels_of_a_chain(options) : 0; }

std::vector<std::string> image_names(const ExportOptions& options, int frame) {
    std::vector<std::string> names;
    for (int tile = 0; tile < cascades_of(options.sea.sea); ++tile) {
        if (options.displacement) names.push_back(displacement_name(options, tile, frame));
        for (int level = 0; level < gradient_levels(options); ++level)
            names.push_back(gradient_name(options, tile, frame, level));
        for (int level = 0; level < foam_levels(options); ++level)
            names.push_back(foam_name(options, tile, frame, level));
    }
    return names;
}

// Tiles to 3, frames to 999999 in four digits or more, and the levels of N = 2048.
bool is_image_name(std::string_view name) {
    constexpr std::size_t longest = 40;  // std::regex takes stack by the length of the text
    static const std::regex pattern(
        "displacement_(c[1-3]_)?([0-9]{4}|[1-9][0-9]{4,5})\\.(exr|tif)|"
        "(gradient|foam)_(c[1-3]_)?([0-9]{4}|[1-9][0-9]{4,5})(_mip([1-9]|1[01]))?\\.(png|tif)");
    return name.size() <= longest && std::regex_match(name.begin(), name.end(), pattern);
}

bool is_export_name(std::string_view name) {
    constexpr std::string_view end = ".part";
    if (name.starts_with('.') && name.ends_with(end) && name.size() > end.size())
        name = name.substr(1, name.size() - 1 - end.size());
    return name == sea_json_name || name == journal_name || name == lock_name || is_image_name(name);
}

}  // namespace pelagic::tools
