// Notes on standard error, which --quiet suppresses.
#pragma once

#include <string>

namespace pelagic::tools {

/// Suppresses notes, progress and summaries for the rest of the process, or prints them again.
void set_quiet(bool quiet);
bool is_quiet();

/// Prints "note: TEXT" on stderr, unless the command is quiet.
/// \param text  one line without its line break
void print_note(const std::string& text);

}  // namespace pelagic::tools
