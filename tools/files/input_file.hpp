// Files that are read: a read that fails is an error with its reason, never an early end.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace pelagic::tools {

/// An open file, pipe or standard input.
class InputFile {
   public:
    /// \param option    that named the file, for messages
    /// \param file      "-" is standard input if `dash_is_stdin`
    /// \param accepted  what the option needs, for messages
    /// Throws InputError: "--points is FILE, which can't be read, needs ACCEPTED (No such file or directory)".
    InputFile(std::string option, const std::filesystem::path& file, std::string accepted,
              bool dash_is_stdin = false);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    /// Bytes read, 0 only at the end. Throws InputError likewise.
    std::size_t read(std::span<char> bytes);

    /// Everything that is left. Throws InputError if that is more than `max_bytes`.
    std::string read_all(std::size_t max_bytes);

    /// The file's name, or "standard input".
    const std::string& name() const { return name_; }

   private:
    [[noreturn]] void reject(const std::string& what, int reason) const;

    std::string option_, name_, accepted_;
    int descriptor_ = -1;
    bool is_ours_ = true;
};

}  // namespace pelagic::tools
