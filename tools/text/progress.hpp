// Notes and progress on standard error, which --quiet suppresses.
#pragma once

#include <chrono>
#include <cstddef>
#include <string>

namespace pelagic::tools {

/// Rewrites one line on stderr: "frame 12 of 64, 18 %, 5 s left". The destructor clears the line.
class Progress {
   public:
    /// \param delay  shows nothing before this time has passed
    Progress(std::string item, std::size_t total, std::chrono::milliseconds delay = {});
    Progress() : Progress("", 1) {}  ///< for work without a count of items
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(std::size_t done);
    /// Shows a description and a percentage.
    /// \param fraction  completed fraction of the work, 0 to 1; 0 shows no percentage
    void show(const std::string& doing, double fraction);
    /// Clears the line, for other output on the terminal.
    void clear();
    /// Prints a note, see print_note().
    void note(const std::string& text);

   private:
    using Clock = std::chrono::steady_clock;

    std::string item_;
    std::size_t total_;
    bool on_terminal_;
    std::chrono::milliseconds delay_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_shown_ = start_ - std::chrono::hours(1);
};

/// Suppresses notes, progress and summaries for the rest of the process, or prints them again.
void set_quiet(bool quiet);
bool is_quiet();

/// Prints "note: TEXT" on stderr, unless the command is quiet.
/// \param text  one line without its line break
void print_note(const std::string& text);

}  // namespace pelagic::tools
