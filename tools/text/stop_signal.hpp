// Ctrl-C and SIGTERM as a question that long work asks between two frames, so that it leaves nothing half done.
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

}  // namespace pelagic::tools
