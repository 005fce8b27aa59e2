// The whole command line: subcommands, help, and one clear line for whatever goes wrong.
#pragma once

namespace pelagic::tools {

/// Runs `pelagic` and returns its exit code: 0, 1 for a file that can't be written, 2 for bad input. Errors are one
/// line on stderr.
int run_command_line(int argc, const char* const* argv);

}  // namespace pelagic::tools
