#include "pelagic/tools/text/progress.hpp"

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <utility>

#include "pelagic/message/one_line.hpp"

namespace pelagic::tools {
namespace {

std::atomic<bool> quiet_process = false;

}  // namespace

Progress::Progress(std::string item, std::size_t total, std::chrono::milliseconds delay)
    : item_(std::move(item)),
      total_(total),
      on_terminal_(!is_quiet() && ::isatty(STDERR_FILENO) == 1),
      delay_(delay) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
    if (on_terminal_ && last_shown_ >= start_) std::fputs("\r\033[K", stderr);
}

void Progress::note(const std::string& text) {
    clear();
    print_note(text);
}

void Progress::show(std::size_t done) {
    show(item_ + " " + std::to_string(done) + " of " + std::to_string(total_),
         static_cast<double>(done) / static_cast<double>(total_));
}

void Progress::show(const std::string& doing, double fraction) {
    const auto now = Clock::now();
    const bool is_recent = now - last_shown_ < std::chrono::milliseconds(100) && fraction < 1;
    if (!on_terminal_ || now - start_ < delay_ || is_recent) return;
    last_shown_ = now;
    std::fprintf(stderr, "\r\033[K%s", doing.c_str());
    if (fraction > 0) {
        const double elapsed = std::chrono::duration<double>(now - start_).count();
        std::fprintf(stderr, ", %.0f %%, %.0f s left", std::floor(100 * fraction), elapsed * (1 - fraction) / fraction);
    }
    std::fflush(stderr);
}

void set_quiet(bool quiet) { quiet_process = quiet; }
bool is_quiet() { return quiet_process; }

void print_note(const std::string& text) {
    if (!is_quiet()) std::fprintf(stderr, "note: %s\n", escaped(text).c_str());
}

}  // namespace pelagic::tools
