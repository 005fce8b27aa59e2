// Interface of a subcommand of `pelagic`, and a factory function for each subcommand.
#pragma once

#include <CLI/App.hpp>
#include <memory>

namespace pelagic::tools {

class Command {
   public:
    virtual ~Command() = default;
    /// Adds the command's options to the parser. The command must outlive the parser.
    virtual void add_options(CLI::App& app) = 0;
    /// Runs with the parsed options. Throws InputError for an invalid option or input, FileError if
    /// output cannot be written, and Stopped after a signal.
    virtual void run() = 0;
};

using MakeCommand = std::unique_ptr<Command> (*)();

std::unique_ptr<Command> make_bench_command();
std::unique_ptr<Command> make_info_command();
std::unique_ptr<Command> make_quadtree_command();
std::unique_ptr<Command> make_query_command();

// Null in a build without the required library.
#if defined(PELAGIC_HAS_IMAGES)
std::unique_ptr<Command> make_export_command();
std::unique_ptr<Command> make_merge_command();
std::unique_ptr<Command> make_verify_command();
#else
inline constexpr MakeCommand make_export_command = nullptr, make_merge_command = nullptr,
                             make_verify_command = nullptr;
#endif
#if defined(PELAGIC_HAS_GL)
std::unique_ptr<Command> make_render_command();
std::unique_ptr<Command> make_view_command();
#else
inline constexpr MakeCommand make_render_command = nullptr, make_view_command = nullptr;
#endif

}  // namespace pelagic::tools
