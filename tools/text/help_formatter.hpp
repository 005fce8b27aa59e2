// Layout of help texts: headings of options, and lines of at most 100 columns.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Formatter.hpp>
#include <string>

namespace pelagic::tools {

/// Headings of options. Help texts print them in this order.
namespace help_group {
inline constexpr const char *output = "Output", *input = "Input", *frames = "Frames", *maps = "Maps",
                            *meshes = "Meshes", *view = "View", *light = "Light and camera", *water = "Water",
                            *floor = "Sea floor", *sea = "Sea", *swell = "Swell", *analytic = "Analytic waves",
                            *regular = "Regular wave",
                            *dynamic_waves = "Dynamic waves", *hull = "Hull",
                            *performance = "Performance (results are bit-identical for all values)",
                            *other = "Other options";
}  // namespace help_group

/// Prints options under their headings. A line has at most 100 columns.
class HelpFormatter final : public CLI::Formatter {
   public:
    HelpFormatter();

    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_subcommand(const CLI::App* command) const override;
    std::string make_option(const CLI::Option* option, bool is_positional) const override;
};

}  // namespace pelagic::tools
