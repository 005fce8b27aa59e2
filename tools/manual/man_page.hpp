// The manual page of `pelagic`.
#pragma once

#include <CLI/App.hpp>
#include <string>

namespace pelagic::tools {

/// Returns a page for section 1 in the man macros of troff. Options that several commands share
/// stand once, under their heading.
/// \param app  the parser of the command line, with its commands
std::string man_page(const CLI::App& app);

}  // namespace pelagic::tools
