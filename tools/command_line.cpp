#include "pelagic/tools/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/encode/codec_library.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/progress.hpp"
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
    {"info", "Print sea-state statistics, stages and memory", make_info_command},
    {"export", "Export frames as images or meshes, and sea.json", make_export_command, "PELAGIC_IMAGES"},
    {"merge", "Check and join the shards of an export", make_merge_command, "PELAGIC_IMAGES"},
    {"verify", "Check every file of an export, and recompute some frames", make_verify_command, "PELAGIC_IMAGES"},
    {"query", "Print height, normal and velocity of the water at points", make_query_command},
    {"render", "Render images or a film of a sea offscreen", make_render_command, "PELAGIC_GL"},
    {"view", "Show a sea in a window, with controls", make_view_command, "PELAGIC_GL"},
    {"quadtree", "Select the mesh patches of a view; print statistics, write meshes", make_quadtree_command},
    {"bench", "Measure frame times", make_bench_command}};

constexpr const char* examples = R"(Examples:
  pelagic info storm                           heights, periods and wavelengths of a preset
  pelagic export waves --frames loop --fps 8   a loop of maps in the folder waves
  pelagic render sea.png --preset rough        an image
"pelagic COMMAND --help" lists the options of a command.)";

std::vector<std::string> command_names() {
    std::vector<std::string> names;
    for (const CommandEntry& command : command_table) names.emplace_back(command.name);
    return names;
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
    return names;
}

/// Throws if the word after an option that requires a value is an option, too. CLI11 reads
/// `--wind-speed --seed 3` as the wind speed "--seed".
void require_values(const CLI::App& used, const std::vector<std::string>& words) {
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        const CLI::Option* option = used.get_option_no_throw(words[i]);
        if (option && words[i].starts_with('-') && option->get_items_expected_min() > 0 &&
            words[i + 1].starts_with('-') && used.get_option_no_throw(words[i + 1]))
            throw InputError(words[i] + " requires a value");
    }
}

/// Converts an error of CLI11 to a one-line InputError.
InputError from_cli(const CLI::ParseError& error, const CLI::App& app, const std::vector<std::string>& words) {
    const auto commands = app.get_subcommands();
    const CLI::App& used = commands.empty() ? app : *commands.front();
    const std::vector<std::string> options = option_names(used);
    require_values(used, words);
    // CLI11 reports an unknown option before it checks the values of other options.
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const std::vector<std::string> extras = used.remaining(true);
        const std::string word = extras.empty() ? "" : extras.front();
        const std::string name = word.substr(0, word.find('='));
        if (commands.empty())
            return InputError((name.starts_with('-') ? "unknown option " : "unknown command ") + word +
                              ", expected " + list_of(command_names()));
        const std::string help = "; pelagic " + used.get_name() + " --help lists all";
        if (!name.starts_with('-')) return InputError("unexpected word " + word + help);
        const auto nearest = near_name(name, options);
        return InputError("unknown option " + name + (nearest ? ", the nearest known one is " + *nearest : "") +
                          help);
    }
    // Other messages of CLI11 begin with the option: "--seed: ..." or "--seed requires an
    // argument".
    for (const std::string& option : options) {
        const std::string what = error.what();
        if (what.find(option + ":") == std::string::npos && what.find(option + " ") == std::string::npos) continue;
        if (const std::size_t times = used.get_option(option)->count(); times > 1)
            return InputError(option + " is given " + number_text(times) + " times; give it once");
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
#if defined(_WIN32)
        throw InputError(std::string(entry_.name) + " is not in builds for Windows; use Linux");
#else
        throw InputError(std::string(entry_.name) + " is not in this build: configure with -D" + entry_.option +
                         "=ON");
#endif
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

/// The parser of `pelagic`, and its commands.
class CommandLine {
   public:
    /// \param words  Only commands among these words get their options. Those of all
    ///               take 9 million instructions.
    explicit CommandLine(const std::vector<std::string>& words)
        : app_("Simulate ocean waves, and export them as looping maps, meshes and images.", "pelagic") {
        app_.formatter(std::make_shared<HelpFormatter>());
        app_.require_subcommand(0, 1);
        app_.allow_windows_style_options(false);  // "/waves" is a path on every system
        app_.footer(examples);
        add_common_options(app_);
        for (const CommandEntry& entry : command_table) {
            CLI::App* const parser = app_.add_subcommand(entry.name, entry.help)->group("Commands")->footer("");
            commands_.emplace_back(parser, entry.make ? entry.make() : std::make_unique<AbsentCommand>(entry));
            // the description of a command that this build lacks is among its options
            if (entry.make && std::find(words.begin(), words.end(), entry.name) == words.end()) continue;
            commands_.back().second->add_options(*parser);
            add_common_options(*parser);
            parser->add_flag("-q,--quiet", is_quiet_, "print no progress, notes or summaries")
                ->group(help_group::other);
        }
    }

    const CLI::App& app() const { return app_; }

    int run(const std::vector<std::string>& words) {
        try {
            // CLI11 expects the words in reverse order
            app_.parse(std::vector<std::string>(words.rbegin(), words.rend()));
        } catch (const CLI::Success& help_or_version) {
            // CLI11 handles --help before it reports unknown words.
            if (app_.get_subcommands().empty() && !app_.remaining().empty())
                throw from_cli(CLI::ExtrasError(app_.remaining()), app_, words);
            const int code = app_.exit(help_or_version);
            check_standard_output();
            return code;
        } catch (const CLI::ParseError& error) {
            throw from_cli(error, app_, words);
        }
        const auto used =
            std::find_if(commands_.begin(), commands_.end(), [](const auto& each) { return each.first->parsed(); });
        if (used == commands_.end())
            throw InputError("no command, expected " + list_of(command_names()) + "; see pelagic --help");
        require_values(*used->first, words);
        set_quiet(is_quiet_);
        used->second->run();
        check_standard_output();
        return 0;
    }

   private:
    static void add_common_options(CLI::App& app) {
        app.set_help_flag("-h,--help", "print this help and exit")->group(help_group::other);
        app.set_version_flag("--version", "pelagic " PELAGIC_VERSION, "print the version and exit")
            ->group(help_group::other);
    }

    CLI::App app_;
    std::vector<std::pair<CLI::App*, std::unique_ptr<Command>>> commands_;
    bool is_quiet_ = false;
};

}  // namespace

void describe_command_line(const std::function<void(const CLI::App&)>& take) {
    take(CommandLine(command_names()).app());
}

int run_command_line(int argc, const char* const* argv) {
#if defined(PELAGIC_HAS_IMAGES)
    keep_dependencies_single_threaded();
#endif
    try {
        const std::vector<std::string> words = without_help_command({argv + 1, argv + argc});
        return CommandLine(words).run(words);
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
