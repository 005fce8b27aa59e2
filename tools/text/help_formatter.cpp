#include "pelagic/tools/text/help_formatter.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

namespace pelagic::tools {
namespace {

constexpr std::size_t help_columns = 100, name_columns = 30;

constexpr std::array groups = {
    help_group::output,        help_group::input, help_group::frames,      help_group::maps,
    help_group::meshes,        help_group::view,  help_group::light,       help_group::water,
    help_group::floor,         help_group::sea,   help_group::swell,       help_group::analytic,
    help_group::regular,       help_group::dynamic_waves, help_group::hull, help_group::performance,
    help_group::other};

/// Returns a name, and its description from column `name_columns` on, broken into lines.
std::string entry(const std::string& name, const std::string& description) {
    const std::string indent(name_columns, ' ');
    std::string text = "  " + name;
    std::size_t column = text.size();
    const auto break_line = [&] {
        text += "\n" + indent;
        column = name_columns;
    };
    if (column + 2 > name_columns && !description.empty())
        break_line();
    else
        text.append(name_columns - column, ' '), column = name_columns;
    std::istringstream words(description);
    for (std::string word; words >> word;) {
        // Keep "[0, 1]" and "(default: 3" on one line.
        const bool opens = word.front() == '[' || word.front() == '(';
        if (std::string next; opens && (word.back() == ',' || word.back() == ':') && words >> next)
            word += " " + next;
        if (column > name_columns && column + 1 + word.size() > help_columns) break_line();
        if (column > name_columns) text += ' ', ++column;
        text += word;
        column += word.size();
    }
    return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

/// Returns the visible options with a heading, except pure positionals.
std::vector<const CLI::Option*> options_under(const CLI::App& app, const std::string& heading) {
    return app.get_options(
        [&](const CLI::Option* option) { return option->get_group() == heading && option->nonpositional(); });
}

}  // namespace

HelpFormatter::HelpFormatter() {
    column_width(name_columns);
    label("SUBCOMMAND", "COMMAND");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
    std::string text = make_description(app) + make_usage(app, name);
    std::string positionals;
    // A positional that is an option, too, is described with that option.
    for (const CLI::Option* const option : app->get_options())
        if (option->get_positional() && !option->nonpositional())
            positionals += entry(option->get_name(true, false), option->get_description());
    if (!positionals.empty()) text += "\n" + positionals;
    text += make_subcommands(app, mode);
    for (const char* const group : groups)
        if (const auto options = options_under(*app, group); !options.empty())
            text += make_group(group, false, options);
    const std::string footer = make_footer(app);
    return footer.empty() ? text : text + "\n" + footer;
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
    return entry(command->get_name(), command->get_description());
}

std::string HelpFormatter::make_option(const CLI::Option* option, bool is_positional) const {
    std::string name;
    for (const std::string& letter : option->get_snames()) name += "-" + letter + ", ";
    for (const std::string& word : option->get_lnames()) name += "--" + word;
    return entry(name + make_option_opts(option), is_positional ? "" : option->get_description());
}

}  // namespace pelagic::tools
