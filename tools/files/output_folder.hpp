// A folder for output files. It is opened once, and only regular files in it are written.
//
// A file is written as ".NAME.part", which is always newly created, then synced and renamed, so no
// partial file ever has the final name. Anything that is not a regular file (link, FIFO, device,
// folder) is never followed, read, replaced or removed; it causes a one-line error. A ".NAME.part"
// file of a killed run is a regular file and is removed unread.
// Functions operate on the opened folder, even if its path is later changed to another folder. They
// may be called from several threads for different names.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "pelagic/tools/files/descriptor.hpp"

namespace pelagic::tools {

/// Whether write() waits until the file is on the disk, so that a power failure cannot lose it.
enum class Sync { yes, no };

/// Returns the temporary name that a file has while it is written: ".NAME.part".
std::string part_name(const std::string& name);

/// File names are relative to the folder and contain no slash (asserted).
class OutputFolder {
   public:
    /// Opens the folder. Throws FileError "can't write PATH: reason" if the folder does not exist
    /// or cannot be opened.
    explicit OutputFolder(const std::filesystem::path& path, Sync sync = Sync::yes)
        : OutputFolder(path, sync, path) {}

    /// Opens the folder of a file that will be written. Throws FileError "can't write FILE:
    /// reason".
    static OutputFolder of(const std::filesystem::path& file) { return {file.parent_path(), Sync::yes, file}; }

    const std::filesystem::path& path() const { return path_; }

    /// Writes a whole file. Throws FileError "can't write FILE: reason" and removes the temporary
    /// file. The contents are synced; a call of sync() is needed to make the name survive a power
    /// failure.
    void write(const std::string& name, std::span<const std::byte> bytes) const;
    void write(const std::string& name, std::string_view text) const;

    using Take = std::function<void(std::string_view)>;
    /// Writes a file piece by piece: calls `make` with a function that appends a piece. Otherwise
    /// as the overloads above.
    void write(const std::string& name, const std::function<void(const Take&)>& make) const;

    /// Throws the FileError that write() would throw for a missing permission or an unsuitable file
    /// of that name, without changing the file. Call it before long computations.
    void check_writable(const std::string& name) const;

    /// Syncs created, renamed and removed names to the disk; does nothing with Sync::no. Throws
    /// FileError.
    void sync() const;

    /// Opens an existing regular file for append_line(). Throws FileError.
    Descriptor open_for_lines(const std::string& name) const;
    /// Appends a line to the file and syncs it. Throws FileError.
    void append_line(const std::string& name, const Descriptor& file, std::string_view line) const;

    /// Calls `take` with the file's bytes piece by piece until it returns false. Returns false if
    /// no file has the name. Throws FileError "can't read FILE: reason". Never blocks on a FIFO.
    bool read(const std::string& name, const std::function<bool(std::string_view)>& take) const;
    /// Opens a file for read_some(). The descriptor is not open if no file has the name. Throws
    /// FileError as read() does.
    Descriptor open_for_reading(const std::string& name) const;
    /// Reads into `bytes` and returns the number of bytes read; 0 only at the end. Throws
    /// FileError.
    std::size_t read_some(const std::string& name, const Descriptor& file, std::span<char> bytes) const;
    /// Returns the whole file, or its first `max` + 1 bytes if it is larger than `max` bytes; none
    /// if no file has the name. Throws FileError.
    std::optional<std::string> read_text(const std::string& name, std::size_t max) const;

    /// Calls `take` with the name of every entry of the folder, in unspecified order. Throws
    /// FileError.
    void for_each_name(const std::function<void(const std::string&)>& take) const;

    /// Removes a regular file. Does nothing if the name does not exist or is not a regular file.
    void remove(const std::string& name) const;

    /// Opens a file for locking. Creates an empty file if there is none; otherwise leaves the
    /// contents unchanged. Throws FileError.
    Descriptor open_for_lock(const std::string& name) const;

   private:
    /// \param wanted  path for error messages: the folder, or the file that will be written there
    OutputFolder(std::filesystem::path path, Sync sync, const std::filesystem::path& wanted);

    bool has_regular_file(const std::string& name, const char* doing) const;
    int write_and_sync(const Descriptor& file, std::string_view bytes) const;
    int sync_file(const Descriptor& file) const;

    std::filesystem::path path_;
    Sync sync_;
    Descriptor folder_;
};

/// One output file named on the command line. The constructor opens its folder and checks its name,
/// before any computation.
class OutputFile {
   public:
    /// \throws FileError  as OutputFolder and check_writable() do
    explicit OutputFile(const std::filesystem::path& file);
    void write(std::span<const std::byte> bytes) const;
    void write(std::string_view text) const;

   private:
    OutputFolder folder_;
    std::string name_;
};

/// Returns the output file of an option; none if the option is not given. Throws InputError if the
/// value is empty, and FileError as OutputFile does.
std::optional<OutputFile> file_for(const char* option, const std::optional<std::string>& file);

}  // namespace pelagic::tools
