// Layout of help texts: headings of options, and lines of at most 100 columns.
#pragma once

#include <CLI/App.hpp>
#include <CLI/Formatter.hpp>
#include <string>
#include <vector>

namespace pelagic::tools {

/// Headings of options. Help texts print them in this order.
namespace help_group {
inline constexpr const char *output = "Output", *input = "Input", *frames = "Frames", *maps = "Maps",
                            *meshes = "Meshes", *view = "View", *light = "Light and camera", *water = "Water",
                            *floor = "Sea floor", *sea = "Sea", *swell = "Swell", *analytic = "Analytic waves",
                            *dynamic_waves = "Dynamic waves", *hull = "Hull",
                            *performance = "Performance (results are bit-identical for all values)",
                            *other = "Other options";
}  // namespace help_group

/// Returns the headings of an application's options in the order of help_group.
std::vector<std::string> help_groups_of(const CLI::App& app);

/// Returns the visible options with a heading, except pure positionals.
std::vector<const CLI::Option*> options_in(const CLI::App& app, const std::string& group);

/// Prints options under their headings. A line has at most 100 columns.
class HelpFormatter final : public CLI::Formatter {
   public:
    HelpFormatter();

    std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override;
    std::string make_subcommand(const CLI::App* command) const override;
    std::string make_option(const CLI::Option* option, bool is_positional) const override;
};

}  // namespace pelagic::tools
