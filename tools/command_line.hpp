// Entry point of the command line: subcommands, help texts and one-line error messages.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pelagic::tools {

/// Runs `pelagic` and returns its exit code: 0 on success, 1 if a file cannot be written, 2 for
/// invalid input, 128 + signal after a signal. Prints each error as one line on stderr.
int run_command_line(int argc, const char* const* argv);

/// Calls `take` with the parser: all commands and options.
void describe_command_line(const std::function<void(const CLI::App&)>& take);

}  // namespace pelagic::tools
