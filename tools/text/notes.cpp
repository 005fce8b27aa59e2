#include "pelagic/tools/text/notes.hpp"

#include <atomic>
#include <cstdio>

#include "pelagic/message/one_line.hpp"

namespace pelagic::tools {
namespace {

std::atomic<bool> quiet_process = false;

}  // namespace

void set_quiet(bool quiet) { quiet_process = quiet; }
bool is_quiet() { return quiet_process; }

void print_note(const std::string& text) {
    if (!is_quiet()) std::fprintf(stderr, "note: %s\n", escaped(text).c_str());
}

}  // namespace pelagic::tools
