// Where the tool's files go: a folder that is opened once, and nothing but regular files in it.
//
// A file is written as ".NAME.part", which is always created new, then synced and renamed: it is whole or not there. What
// is no regular file (a link, FIFO, device, folder) is never followed, read, replaced or removed, under any of these
// names: it is an error in one line. A part that a killed run left behind is a regular file, and is removed unread.
// Calls work on the opened folder, wherever its path may lead later, and may come from several threads for different names.
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

/// Whether a file counts as written only once it is on the disk, so that no power cut takes it back.
enum class Sync { yes, no };

/// The name that a file has while it is written: ".NAME.part".
std::string part_name(const std::string& name);

/// Names are plain: of a file in this folder, without a slash (asserted).
class OutputFolder {
   public:
    /// Throws FileError, "can't write PATH: reason", if there is no such folder or it can't be opened.
    explicit OutputFolder(const std::filesystem::path& path, Sync sync = Sync::yes)
        : OutputFolder(path, sync, path) {}

    /// The folder of a file that is to be written. Throws FileError, "can't write FILE: reason".
    static OutputFolder of(const std::filesystem::path& file) { return {file.parent_path(), Sync::yes, file}; }

    const std::filesystem::path& path() const { return path_; }

    /// Writes a whole file. Throws FileError, "can't write FILE: reason", and then leaves no part behind. The file itself
    /// is synced; that its name is there after a power cut needs sync().
    void write(const std::string& name, std::span<const std::byte> bytes) const;
    void write(const std::string& name, std::string_view text) const;

    using Take = std::function<void(std::string_view)>;
    /// The same of a file that comes piece by piece: `make` is given what takes the pieces.
    void write(const std::string& name, const std::function<void(const Take&)>& make) const;

    /// Throws what write() would for want of a permission or because of what has the name, without touching the file: for
    /// what is only written after long work.
    void check_writable(const std::string& name) const;

    /// Names that came and went so far are on the disk, unless the folder is not to be synced. Throws FileError.
    void sync() const;

    /// A regular file that is there, open for adding lines to it with append_line(). Throws FileError.
    Descriptor open_for_lines(const std::string& name) const;
    /// Adds a line, and syncs it. Throws FileError.
    void append_line(const std::string& name, const Descriptor& file, std::string_view line) const;

    /// Hands over the file's bytes piece by piece until `take` says no; false if nothing has the name. Throws FileError,
    /// "can't read FILE: reason". Never waits for a writer, as opening a FIFO would.
    bool read(const std::string& name, const std::function<bool(std::string_view)>& take) const;
    /// The same by pieces that the caller asks for; a descriptor that is not open if nothing has the name.
    Descriptor open_for_reading(const std::string& name) const;
    /// Bytes read, 0 only at the end.
    std::size_t read_some(const std::string& name, const Descriptor& file, std::span<char> bytes) const;
    /// The whole file, or its first `most` + 1 bytes if it has more than `most`.
    std::optional<std::string> read_text(const std::string& name, std::size_t max) const;

    /// Hands over the name of all that is in the folder, in no order. Throws FileError.
    void for_each_name(const std::function<void(const std::string&)>& take) const;

    /// Removes a regular file; does nothing if the name is that of something else or of nothing.
    void remove(const std::string& name) const;

    /// A file for a lock: created empty if it is missing, otherwise left as it is. Throws FileError.
    Descriptor open_for_lock(const std::string& name) const;

   private:
    /// \param wanted  what the error names: the folder, or the file that is to be written there
    OutputFolder(std::filesystem::path path, Sync sync, const std::filesystem::path& wanted);

    bool has_regular_file(const std::string& name, const char* doing) const;
    int write_and_sync(const Descriptor& file, std::string_view bytes) const;
    int sync_file(const Descriptor& file) const;

    std::filesystem::path path_;
    Sync sync_;
    Descriptor folder_;
};

/// One file somewhere, named on the command line: its folder is opened and its name is checked before the work begins.
class OutputFile {
   public:
    /// Throws FileError as OutputFolder and check_writable() do.
    explicit OutputFile(const std::filesystem::path& file);
    void write(std::span<const std::byte> bytes) const;
    void write(std::string_view text) const;

   private:
    OutputFolder folder_;
    std::string name_;
};

/// What an option names; none without the option. Throws InputError if it names nothing, and FileError as OutputFile does.
std::optional<OutputFile> file_for(const char* option, const std::optional<std::string>& file);

}  // namespace pelagic::tools
