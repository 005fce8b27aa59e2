// Progress display on a terminal. If stderr is not a terminal, or with --quiet, show() prints
// nothing.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace pelagic::tools {

/// Rewrites one line on stderr: "frame 12 of 64, 18 %, 5 s left". The destructor clears the line.
class Progress {
   public:
    Progress(std::string item, std::size_t total);
    Progress() : Progress("", 1) {}  ///< for work without a count of items
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::size_t done);
    /// Shows a description and a percentage.
    /// \param fraction  completed fraction of the work, 0 to 1
    void show(const std::string& doing, double fraction);
    /// Prints a note, see print_note().
    void note(const std::string& text);

   private:
    using Clock = std::chrono::steady_clock;

    std::string item_;
    std::size_t total_;
    bool on_terminal_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_shown_ = start_ - std::chrono::hours(1);
};

}  // namespace pelagic::tools
