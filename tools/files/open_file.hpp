// Operating-system functions for files and streams, implemented in open_file_posix.cpp and
// open_file_windows.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "pelagic/tools/files/descriptor.hpp"

namespace pelagic::tools {

/// Returns the path in a form that the system accepts at any length. Windows limits others to 260
/// characters.
std::filesystem::path any_length(const std::filesystem::path& path);

/// Returns 0, or the errno of the reason why files of the folder cannot be read.
int reason_against_reading(const std::filesystem::path& folder);

enum class LockKind { shared, exclusive };

/// Locks an open file until it is closed or the process ends. Does not wait. Returns 0, or an errno:
/// EWOULDBLOCK if another process holds the lock.
int try_lock(const Descriptor& file, LockKind kind);

/// Opens the file for reading. On failure the descriptor is not open and errno holds the reason.
/// For a directory, EISDIR may be reported only when it is read.
Descriptor open_to_read(const std::filesystem::path& file);

/// Calls read(): returns the number of bytes read, 0 at the end, or -1 with errno set.
std::ptrdiff_t read_some(int descriptor, std::span<char> bytes);

/// Discards what is printed to stderr until its destruction: libraries print there beside the error
/// that they return. \pre no other thread prints
class SilentStderr {
   public:
    SilentStderr();
    ~SilentStderr();
    SilentStderr(const SilentStderr&) = delete;
    SilentStderr& operator=(const SilentStderr&) = delete;

   private:
    Descriptor kept_;
};

/// Switches standard input and output to binary mode, so that a line ends with "\n" on every
/// system, and a console to UTF-8.
void keep_bytes_as_they_are();

}  // namespace pelagic::tools
