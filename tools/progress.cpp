#include "pelagic/tools/progress.hpp"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace pelagic::tools {

Progress::Progress(std::string item, std::size_t total)
    : item_(std::move(item)), total_(total), on_terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
    if (on_terminal_) std::fputs("\r\033[K", stderr);
}

void Progress::show(std::size_t done) {
    const auto now = Clock::now();
    if (!on_terminal_ || (now - last_shown_ < std::chrono::milliseconds(100) && done < total_)) return;
    last_shown_ = now;
    std::fprintf(stderr, "\r\033[K%s %zu of %zu, %zu %%", item_.c_str(), done, total_, 100 * done / total_);
    if (done > 0) {
        const double elapsed = std::chrono::duration<double>(now - start_).count();
        std::fprintf(stderr, ", %.0f s left",
                     elapsed * static_cast<double>(total_ - done) / static_cast<double>(done));
    }
    std::fflush(stderr);
}

}  // namespace pelagic::tools
