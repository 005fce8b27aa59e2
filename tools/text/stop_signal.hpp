// Handling of SIGINT and SIGTERM. A command either polls stop_signal() between frames, or ends at
// once with a message; neither leaves a partial file.
#pragma once

namespace pelagic::tools {

/// Thrown after a stop signal. The process exits with 128 + signal, as shells expect.
struct Stopped {
    int signal;
    int done, total;  ///< frames
};

/// Installs handlers that store the first SIGINT or SIGTERM; a second signal ends the program at
/// once. Also ignores SIGXFSZ: a file that exceeds the user's size limit causes a write error
/// (EFBIG).
void catch_stop_signals();

/// Returns the signal that was received, or 0.
int stop_signal();

/// Installs handlers that write `line` to stderr and end the program with 128 + signal. For
/// commands with long steps and no state to resume from.
/// \param line  with its line break; must stay valid until the program ends
void end_on_stop_signals(const char* line);

/// Delays the end of the program while an object exists, so that a file is written completely. At
/// most one object, on one thread.
class HeldStop {
   public:
    HeldStop();
    ~HeldStop();
    HeldStop(const HeldStop&) = delete;
    HeldStop& operator=(const HeldStop&) = delete;
};

}  // namespace pelagic::tools
