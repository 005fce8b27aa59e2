#include "pelagic/tools/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "pelagic/tools/bench_command.hpp"
#include "pelagic/tools/info_command.hpp"
#include "pelagic/tools/quadtree_command.hpp"
#include "pelagic/tools/query_command.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"
#if defined(PELAGIC_HAS_GL)
#include "pelagic/tools/render_command.hpp"
#include "pelagic/tools/view_command.hpp"
#endif
#if defined(PELAGIC_HAS_IMAGES)
#include "pelagic/tools/export_command.hpp"
#include "pelagic/tools/merge_command.hpp"
#include "pelagic/tools/verify_command.hpp"
#endif
#include "pelagic/tools/text/stop_signal.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* commands_text = "bench, export, info, merge, quadtree, query, render, verify or view";

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options())
        if (!option->get_lnames().empty()) names.push_back("--" + option->get_lnames().front());
    return names;
}

/// What CLI11 says, as one line of ours.
InputError from_cli(const CLI::ParseError& error, const CLI::App& app, const std::vector<std::string>& words) {
    const auto commands = app.get_subcommands();
    const CLI::App& used = commands.empty() ? app : *commands.front();
    const std::vector<std::string> options = option_names(used);

    // `--wind-speed --seed 3`: CLI11 takes --seed for the wind and complains of the 3.
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        const CLI::Option* option = used.get_option_no_throw(words[i]);
        if (option && option->get_items_expected_min() > 0 && used.get_option_no_throw(words[i + 1]))
            return InputError(words[i] + " has no value, needs one");
    }
    // CLI11 meets an unknown option before it looks at the values of others.
    if (dynamic_cast<const CLI::ExtrasError*>(&error)) {
        const std::vector<std::string> extras = used.remaining(true);
        const std::string word = extras.empty() ? "" : extras.front();
        const std::string name = word.substr(0, word.find('='));
        if (commands.empty())
            return InputError((name.starts_with('-') ? "unknown option " : "unknown command ") + word + ", needs " +
                              commands_text);
        const std::string help = "; pelagic " + used.get_name() + " --help lists all";
        if (!name.starts_with('-'))
            return InputError("unexpected word " + word + ", needs options such as " + options.back() + help);
        const auto nearest = near_name(name, options);
        return InputError("unknown option " + name + (nearest ? ", the nearest known one is " + *nearest : "") +
                          help);
    }
    // The others name the option first: "--seed: ..." or "--seed requires an argument".
    for (const std::string& option : options) {
        const auto times = std::count_if(words.begin(), words.end(), [&](const std::string& word) {
            return word == option || word.starts_with(option + "=");
        });
        const std::string what = error.what();
        if (what.find(option + ":") == std::string::npos && what.find(option + " ") == std::string::npos) continue;
        if (times > 1)
            return InputError(option + " is given " + number_text(times) + " times, needs to be given once");
        if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
            return InputError(option + " has no value, needs one");
    }
    std::string line = error.what();
    std::replace(line.begin(), line.end(), '\n', ' ');
    return InputError(line);
}

/// A command that this build lacks for want of an option of CMake's: it takes all words, and says so when it runs.
struct AbsentCommand {
    CLI::App& app;
    std::string option;

    AbsentCommand(CLI::App& parent, const std::string& name, std::string needed)
        : app(*parent.add_subcommand(name, "not in this build, which was configured with " + needed + "=OFF")),
          option(std::move(needed)) {
        app.allow_extras();
    }
    void run() const {
        throw InputError(app.get_name() + " is not in this build, needs one configured with -D" + option + "=ON");
    }
};

/// Output that a full disk swallowed is a failure, not a success without words.
void check_standard_output() {
    if (std::cout.flush() && std::fflush(stdout) == 0 && !std::ferror(stdout)) return;
    throw FileError(std::string("can't write standard output: ") + std::strerror(errno));
}

/// `help export` is `export --help`, and `help` alone `--help`.
std::vector<std::string> without_help_command(std::vector<std::string> words) {
    if (words.empty() || words.front() != "help") return words;
    words.erase(words.begin());
    words.push_back("--help");
    return words;
}

int run(int argc, const char* const* argv) {
    CLI::App app("An open sea on CPU jobs and SIMD: exports seamlessly looping displacement and normal maps.",
                 "pelagic");
    app.set_version_flag("--version", "pelagic " PELAGIC_VERSION);
    app.get_formatter()->column_width(34);

    app.require_subcommand(0, 1);
    CLI::App& bench_app = *app.add_subcommand("bench", "how long frames take on this machine, beside others");
    BenchFlags bench_flags;
    bench_flags.add_to(bench_app);
#if defined(PELAGIC_HAS_IMAGES)
    CLI::App& export_app = *app.add_subcommand("export", "write frames of a sea as images, and sea.json");
    ExportFlags export_flags;
    export_flags.add_to(export_app);
#else
    const AbsentCommand no_export(app, "export", "PELAGIC_IMAGES");
    CLI::App& export_app = no_export.app;
#endif
    CLI::App& info_app = *app.add_subcommand("info", "say what a sea is, before anything is written");
    InfoFlags info_flags;
    info_flags.add_to(info_app);
#if defined(PELAGIC_HAS_IMAGES)
    CLI::App& merge_app = *app.add_subcommand("merge", "join the shards of an export, and check every file");
    MergeFlags merge_flags;
    merge_flags.add_to(merge_app);
#else
    const AbsentCommand no_merge(app, "merge", "PELAGIC_IMAGES");
    CLI::App& merge_app = no_merge.app;
#endif
    CLI::App& quadtree_app = *app.add_subcommand("quadtree", "which patches a view draws: statistics, mesh, plan");
    QuadtreeCommandFlags quadtree_flags;
    quadtree_flags.add_to(quadtree_app);
    CLI::App& query_app = *app.add_subcommand("query", "say how high the water is at given points, and how it moves");
    QueryFlags query_flags;
    query_flags.add_to(query_app);
#if defined(PELAGIC_HAS_IMAGES)
    CLI::App& verify_app =
        *app.add_subcommand("verify", "check every file of an export, and compute some frames again");
    VerifyFlags verify_flags;
    verify_flags.add_to(verify_app);
#else
    const AbsentCommand no_verify(app, "verify", "PELAGIC_IMAGES");
    CLI::App& verify_app = no_verify.app;
#endif

#if defined(PELAGIC_HAS_GL)
    CLI::App& render_app = *app.add_subcommand("render", "draw images of a sea, without a window");
    RenderFlags render_flags;
    render_flags.add_to(render_app);
    CLI::App& view_app = *app.add_subcommand("view", "look at a sea in a window, and change it");
    ViewFlags view_flags;
    view_flags.add_to(view_app);
#else
    const AbsentCommand no_render(app, "render", "PELAGIC_GL"), no_view(app, "view", "PELAGIC_GL");
    CLI::App &render_app = no_render.app, &view_app = no_view.app;
#endif

    for (CLI::App* command : {&bench_app, &export_app, &info_app, &merge_app, &quadtree_app, &query_app, &render_app,
                              &verify_app, &view_app})
        command->set_version_flag("--version", "pelagic " PELAGIC_VERSION);

    const std::vector<std::string> words = without_help_command({argv + 1, argv + argc});
    try {
        app.parse(std::vector<std::string>(words.rbegin(), words.rend()));  // CLI11 takes the last word first
    } catch (const CLI::Success& help_or_version) {
        // CLI11 helps before it looks at what it does not know.
        if (app.get_subcommands().empty() && !app.remaining().empty())
            throw from_cli(CLI::ExtrasError(app.remaining()), app, words);
        const int code = app.exit(help_or_version);
        check_standard_output();
        return code;
    } catch (const CLI::ParseError& error) {
        throw from_cli(error, app, words);
    }
    if (bench_app.parsed())
        bench_flags.run();
    else if (info_app.parsed())
        info_flags.run();
    else if (quadtree_app.parsed())
        quadtree_flags.run();
    else if (query_app.parsed())
        query_flags.run();
#if defined(PELAGIC_HAS_IMAGES)
    else if (export_app.parsed())
        run_export(export_flags.resolve());
    else if (merge_app.parsed())
        merge_flags.run();
    else if (verify_app.parsed())
        verify_flags.run();
#else
    else if (export_app.parsed())
        no_export.run();
    else if (merge_app.parsed())
        no_merge.run();
    else if (verify_app.parsed())
        no_verify.run();
#endif
#if defined(PELAGIC_HAS_GL)
    else if (render_app.parsed())
        run_render(render_flags.resolve());
    else if (view_app.parsed())
        view_flags.run();
#else
    else if (render_app.parsed())
        no_render.run();
    else if (view_app.parsed())
        no_view.run();
#endif
    else
        throw InputError(std::string("no command, needs ") + commands_text + "; pelagic --help says more");
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
        std::fprintf(stderr, "pelagic: out of memory, a smaller --resolution or fewer --threads want less\n");
        return 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "pelagic: %s\n", one_line(error.what()).c_str());
        return 1;
    }
}

}  // namespace pelagic::tools
