// Reading of input files. A failed read throws an error with its reason; it is never treated as the
// end of the file.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace pelagic::tools {

/// An open file, pipe or standard input.
class InputFile {
   public:
    /// \param option    option that named the file, for error messages
    /// \param file      path; "-" is standard input if `dash_is_stdin`
    /// \param accepted  what the option accepts, for error messages
    /// \throws InputError  "--points is FILE, which can't be read, expected ACCEPTED (No such file
    ///     or directory)"
    InputFile(std::string option, const std::filesystem::path& file, std::string accepted,
              bool dash_is_stdin = false);
    ~InputFile();
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;

    /// Reads into `bytes` and returns the number of bytes read; 0 only at the end. Throws
    /// InputError if the read fails.
    std::size_t read(std::span<char> bytes);

    /// Reads the remaining bytes. Throws InputError if there are more than `max_bytes`.
    std::string read_all(std::size_t max_bytes);

    /// Returns the file's name, or "standard input".
    const std::string& name() const { return name_; }

   private:
    [[noreturn]] void reject(const std::string& what, int reason) const;

    std::string option_, name_, accepted_;
    int descriptor_ = -1;
    bool is_ours_ = true;
};

}  // namespace pelagic::tools
