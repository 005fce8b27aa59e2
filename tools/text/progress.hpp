// How far long work has come, on a terminal; nothing in a pipe.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace pelagic::tools {

/// One line on stderr that is written over: "frame 12 of 64, 18 %, 5 s left". Cleared when it goes out of scope.
class Progress {
   public:
    Progress(std::string item, std::size_t total);
    Progress() : Progress("", 1) {}  ///< for work that is no number of items
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::size_t done);
    /// \param part  what is done of the whole, 0 to 1
    void show(const std::string& doing, double part);
    /// Prints a line that stays, on stderr, also where it is no terminal. \param line  without its end of line
    void note(const std::string& line);

   private:
    using Clock = std::chrono::steady_clock;

    std::string item_;
    std::size_t total_;
    bool on_terminal_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_shown_ = start_ - std::chrono::hours(1);
};

}  // namespace pelagic::tools
