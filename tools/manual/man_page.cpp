#include "pelagic/tools/manual/man_page.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "pelagic/tools/text/help_formatter.hpp"

namespace pelagic::tools {
namespace {

/// Headings whose options mean the same in all commands.
constexpr std::array shared_groups = {help_group::light,         help_group::water,       help_group::floor,
                                      help_group::sea,           help_group::swell,       help_group::analytic,
                                      help_group::dynamic_waves, help_group::performance, help_group::other};

bool is_shared(std::string_view group) { return std::ranges::find(shared_groups, group) != shared_groups.end(); }

/// Escapes what troff would read as a request, an escape or a hyphen.
std::string escaped(std::string_view text) {
    std::string result;
    bool is_line_start = true;
    for (const char c : text) {
        if (is_line_start && (c == '.' || c == '\'')) result += "\\&";
        if (c == '\\')
            result += "\\e";
        else if (c == '-')
            result += "\\-";
        else
            result += c;
        is_line_start = c == '\n';
    }
    return result;
}

std::string section(std::string_view title) { return ".SH " + std::string(title) + "\n"; }
std::string subsection(std::string_view title) { return ".SS \"" + escaped(title) + "\"\n"; }
std::string preformatted(std::string_view text) { return ".PP\n.nf\n" + escaped(text) + "\n.fi\n"; }

std::string entry(const CLI::Option& option) {
    std::string names;
    for (const std::string& letter : option.get_snames()) names += "\\fB" + escaped("-" + letter) + "\\fR, ";
    for (const std::string& word : option.get_lnames()) names += "\\fB" + escaped("--" + word) + "\\fR";
    if (option.get_type_size() != 0) names += " \\fI" + escaped(option.get_type_name()) + "\\fR";
    return ".TP\n" + names + "\n" + escaped(option.get_description()) + "\n";
}

/// Returns "pelagic export [OPTIONS] [DIR]".
std::string usage(const CLI::App& command) {
    std::string text = "pelagic " + command.get_name() + " [OPTIONS]";
    for (const CLI::Option* option : command.get_options())
        if (option->get_positional()) text += " [" + option->get_name(true, false) + "]";
    return text;
}

std::string command_section(const CLI::App& command) {
    std::string text = subsection(usage(command)) + escaped(command.get_description()) + ".\n", shared;
    for (const std::string& group : help_groups_of(command)) {
        if (is_shared(group)) {
            shared += (shared.empty() ? "" : ", ") + group.substr(0, group.find(" ("));
            continue;
        }
        for (const CLI::Option* option : options_in(command, group)) text += entry(*option);
    }
    if (!shared.empty()) text += ".PP\nShared options: " + shared + ".\n";
    if (const std::string footer = command.get_footer(); !footer.empty()) text += preformatted(footer);
    return text;
}

/// Returns the options of a heading in any command, each once.
std::string shared_section(const std::vector<const CLI::App*>& commands, const std::string& group) {
    std::string text = subsection(group);
    std::vector<std::string> known;
    for (const CLI::App* command : commands)
        for (const CLI::Option* option : options_in(*command, group)) {
            if (std::ranges::find(known, option->get_name()) != known.end()) continue;
            known.push_back(option->get_name());
            text += entry(*option);
        }
    return known.empty() ? "" : text;
}

}  // namespace

std::string man_page(const CLI::App& app) {
    const std::vector<const CLI::App*> commands = app.get_subcommands({});
    std::string text = ".TH PELAGIC 1 \"\" \"Pelagic " PELAGIC_VERSION "\" \"User Commands\"\n";
    text += section("NAME") + "pelagic \\- simulate ocean waves and export them as maps, meshes and images\n";
    text += section("SYNOPSIS") + ".B pelagic\n.I COMMAND\n[\\fIOPTIONS\\fR]\n";
    text += section("DESCRIPTION") + escaped(app.get_description()) + "\n";
    text += section("COMMANDS");
    for (const CLI::App* command : commands) text += command_section(*command);
    text += section("SHARED OPTIONS");
    for (const char* const group : shared_groups) text += shared_section(commands, group);
    text += section("EXIT STATUS") +
            ".TP\n0\nSuccess.\n.TP\n1\nA file cannot be read or written.\n.TP\n2\nAn option, a value or an input "
            "file is invalid.\n.TP\n128 + signal\nA signal stopped the command.\n";
    text += section("ENVIRONMENT") + ".TP\n.B PELAGIC_ISA\nInstruction set without \\fB\\-\\-isa\\fR.\n";
    return text + section("EXAMPLES") + preformatted(app.get_footer());
}

}  // namespace pelagic::tools
