#include "pelagic/tools/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/stop_signal.hpp"

namespace pelagic::tools {
namespace {

struct CommandEntry {
    const char* name;
    const char* help;
    MakeCommand make;              ///< null if this build does not contain the command
    const char* option = nullptr;  ///< CMake option that enables the command; null: always built
};

constexpr CommandEntry command_table[] = {
    {"bench", "measure frame times on this machine, beside stored results", make_bench_command},
    {"export", "export frames of a sea as images or meshes, and sea.json", make_export_command, "PELAGIC_IMAGES"},
    {"info", "print sea-state statistics, stages and memory", make_info_command},
    {"merge", "join the shards of an export after checking every file", make_merge_command, "PELAGIC_IMAGES"},
    {"quadtree", "select the mesh patches for a view; print statistics, write meshes", make_quadtree_command},
    {"query", "print height, normal and velocity of the water at given points", make_query_command},
    {"render", "render images of a sea offscreen", make_render_command, "PELAGIC_GL"},
    {"verify", "check every file of an export, and recompute some frames", make_verify_command, "PELAGIC_IMAGES"},
    {"view", "show a sea in a window, with controls", make_view_command, "PELAGIC_GL"}};

/// Returns "bench, export ... or view".
std::string command_names() {
    std::vector<std::string> names;
    for (const CommandEntry& command : command_table) names.emplace_back(command.name);
    return list_of(names);
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
    return names;
}

/// Converts an error of CLI11 to a one-line InputError.
InputError from_cli(const CLI::ParseError& error, const CLI::App& app, const std::vector<std::string>& words) {
    const auto commands = app.get_subcommands();
    const CLI::App& used = commands.empty() ? app : *commands.front();
    const std::vector<std::string> options = option_names(used);

    // `--wind-speed --seed 3`: CLI11 reads --seed as the wind speed and reports the 3 as
    // unexpected.
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        const CLI::Option* option = used.get_option_no_throw(words[i]);
        if (option && option->get_items_expected_min() > 0 && used.get_option_no_throw(words[i + 1]))
            return InputError(words[i] + " requires a value");
    }
    // CLI11 reports an unknown option before it checks the values of other options.
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const std::vector<std::string> extras = used.remaining(true);
        const std::string word = extras.empty() ? "" : extras.front();
        const std::string name = word.substr(0, word.find('='));
        if (commands.empty())
            return InputError((name.starts_with('-') ? "unknown option " : "unknown command ") + word +
                              ", expected " + command_names());
        const std::string help = "; pelagic " + used.get_name() + " --help lists all";
        if (!name.starts_with('-'))
            return InputError("unexpected word " + word + ", expected options such as " + options.back() + help);
        const auto nearest = near_name(name, options);
        return InputError("unknown option " + name + (nearest ? ", the nearest known one is " + *nearest : "") +
                          help);
    }
    // Other messages of CLI11 begin with the option: "--seed: ..." or "--seed requires an
    // argument".
    for (const std::string& option : options) {
        const auto times = std::count_if(words.begin(), words.end(), [&](const std::string& word) {
            return word == option || word.starts_with(option + "=");
        });
        const std::string what = error.what();
        if (what.find(option + ":") == std::string::npos && what.find(option + " ") == std::string::npos) continue;
        if (times > 1) return InputError(option + " is given " + number_text(times) + " times; give it once");
        if (dynamic_cast<const CLI::ArgumentMismatch*>(&error)) return InputError(option + " requires a value");
    }
    std::string line = error.what();
    std::replace(line.begin(), line.end(), '\n', ' ');
    return InputError(line);
}

/// Stands in for a command that this build lacks: accepts all arguments and throws InputError in
/// run().
class AbsentCommand final : public Command {
   public:
    explicit AbsentCommand(const CommandEntry& entry) : entry_(entry) {}

    void add_options(CLI::App& app) override {
        app.description(std::string("not in this build, which was configured with ") + entry_.option + "=OFF");
        app.allow_extras();
    }
    void run() override {
        throw InputError(std::string(entry_.name) + " is not in this build: configure with -D" + entry_.option +
                         "=ON");
    }

   private:
    const CommandEntry& entry_;
};

/// Throws FileError if standard output could not be written, for example to a full disk.
void check_standard_output() {
    if (std::cout.flush() && std::fflush(stdout) == 0 && !std::ferror(stdout)) return;
    throw FileError(std::string("can't write standard output: ") + std::strerror(errno));
}

/// Converts `help export` to `export --help`, and `help` to `--help`.
std::vector<std::string> without_help_command(std::vector<std::string> words) {
    if (words.empty() || words.front() != "help") return words;
    words.erase(words.begin());
    words.push_back("--help");
    return words;
}

int run(int argc, const char* const* argv) {
    CLI::App app("Simulates FFT ocean waves on the CPU and exports seamlessly looping displacement and normal maps.",
                 "pelagic");
    app.set_version_flag("--version", "pelagic " PELAGIC_VERSION);
    app.get_formatter()->column_width(34);

    app.require_subcommand(0, 1);
    std::vector<std::pair<CLI::App*, std::unique_ptr<Command>>> parsers;
    for (const CommandEntry& entry : command_table) {
        CLI::App* const parser = app.add_subcommand(entry.name, entry.help);
        parsers.emplace_back(parser, entry.make ? entry.make() : std::make_unique<AbsentCommand>(entry));
        parsers.back().second->add_options(*parser);
        parser->set_version_flag("--version", "pelagic " PELAGIC_VERSION);
    }

    const std::vector<std::string> words = without_help_command({argv + 1, argv + argc});
    try {
        // CLI11 expects the words in reverse order
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    } catch (const CLI::Success& help_or_version) {
        // CLI11 handles --help before it reports unknown words.
        if (app.get_subcommands().empty() && !app.remaining().empty())
            throw from_cli(CLI::ExtrasError(app.remaining()), app, words);
        const int code = app.exit(help_or_version);
        check_standard_output();
        return code;
    } catch (const CLI::ParseError& error) {
        throw from_cli(error, app, words);
    }
    const auto used =
        std::find_if(parsers.begin(), parsers.end(), [](const auto& each) { return each.first->parsed(); });
    if (used == parsers.end()) throw InputError("no command, expected " + command_names() + "; see pelagic --help");
    used->second->run();
    check_standard_output();
    return 0;
}

}  // namespace

int run_command_line(int argc, const char* const* argv) {
    try {
        return run(argc, argv);
    } catch (const InputError& error) {
        std::fprintf(stderr, "pelagic: %s\n", error.what());
        return 2;
    } catch (const Stopped& stop) {
        std::fprintf(stderr,
                     "pelagic: stopped after %d of %d frames; the same command with --resume makes the rest\n",
                     stop.done, stop.total);
        return 128 + stop.signal;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "pelagic: out of memory, a smaller --resolution or fewer --threads need less\n");
        return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "pelagic: %s\n", one_line(error.what()).c_str());
        return 1;
    }
}

}  // namespace pelagic::tools
