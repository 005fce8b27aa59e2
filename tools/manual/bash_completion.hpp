// Bash completion of `pelagic`.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace pelagic::tools {

/// Returns a script for bash that completes commands, options, names of values, files and folders.
/// \param app  the parser of the command line, with its commands
std::string bash_completion(const CLI::App& app);

}  // namespace pelagic::tools
