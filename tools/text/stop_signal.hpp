// Ctrl-C and SIGTERM as a question that long work asks between two frames, or as an end with a line, so that it leaves nothing
// half done.
#pragma once

namespace pelagic::tools {

/// Thrown by work that was asked to stop: main exits with 128 + signal, as a shell expects.
struct Stopped {
    int signal;
    int done, total;  ///< frames
};

/// From here on SIGINT and SIGTERM are noted, the first of each; a second one ends the program at once. A file that
/// grows over the user's limit becomes a write error (EFBIG) instead of a SIGXFSZ that ends the program.
void catch_stop_signals();

/// The signal that came, or 0.
int stop_signal();

/// From here on SIGINT and SIGTERM write `line` to standard error and end the program with 128 + signal, for work that has long
/// steps and keeps nothing for later. \param line  with its end of line; outlives the program's work
void end_on_stop_signals(const char* line);

/// While one is alive such a signal waits for its end, so that a file is written whole. One at a time, on one thread.
class HeldStop {
   public:
    HeldStop();
    ~HeldStop();
    HeldStop(const HeldStop&) = delete;
    HeldStop& operator=(const HeldStop&) = delete;
};

}  // namespace pelagic::tools
