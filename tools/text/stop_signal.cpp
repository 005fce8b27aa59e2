#include "pelagic/tools/text/stop_signal.hpp"

#include <unistd.h>

#include <csignal>
#include <cstring>
#include <initializer_list>

namespace pelagic::tools {
namespace {

volatile std::sig_atomic_t caught = 0;

extern "C" void note_signal(int signal) {
    std::signal(signal, SIG_DFL);  // a second one ends the program
    caught = signal;
}

volatile std::sig_atomic_t is_held = 0;
const char* closing_line = "";
const char* clear_progress = "";

/// Ends the program. Async-signal-safe: called from a signal handler.
void end_now() {
    for (const char* text : {clear_progress, closing_line})
        if (::write(STDERR_FILENO, text, static_cast<unsigned>(std::strlen(text))) < 0) break;
    ::_exit(128 + caught);
}

extern "C" void end_at_signal(int signal) {
    std::signal(signal, SIG_DFL);
    caught = signal;
    if (!is_held) end_now();
}

void handle_stop_signals(void (*handler)(int)) {
    constexpr int stops[] = {
        SIGINT, SIGTERM,
#if defined(SIGBREAK)  // Ctrl-Break on Windows
        SIGBREAK,
#endif
    };
    for (const int signal : stops)
        // set by nohup and for background jobs of a script
        if (std::signal(signal, handler) == SIG_IGN) std::signal(signal, SIG_IGN);
#if defined(SIGXFSZ)
    std::signal(SIGXFSZ, SIG_IGN);
#endif
}

}  // namespace

void catch_stop_signals() { handle_stop_signals(note_signal); }

int stop_signal() { return caught; }

void end_on_stop_signals(const char* line) {
    closing_line = line;
    if (::isatty(STDERR_FILENO) == 1) clear_progress = "\r\033[K";
    handle_stop_signals(end_at_signal);
}

HeldStop::HeldStop() { is_held = 1; }

HeldStop::~HeldStop() {
    is_held = 0;
    if (caught != 0) end_now();
}

}  // namespace pelagic::tools
