#include "pelagic/tools/atomic_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <utility>

#include "pelagic/tools/errors.hpp"

namespace pelagic::tools {
namespace {

constexpr int part_flags = O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC;

FileError write_error(const std::filesystem::path& file, int reason) {
    return FileError("can't write " + file.string() + ": " + std::strerror(reason));
}

/// An open file; writes everything or reports why not.
class Output {
   public:
    Output(const std::filesystem::path& file, int flags) : descriptor_(::open(file.c_str(), flags, 0666)) {}
    ~Output() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;

    /// 0 or an errno. A full disk may only show when the file is closed.
    int write_and_close(std::span<const std::byte> bytes) {
        if (descriptor_ < 0) return errno;
        while (!bytes.empty()) {
            const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) return errno;
            bytes = bytes.subspan(static_cast<std::size_t>(written));
        }
        return ::close(std::exchange(descriptor_, -1)) == 0 ? 0 : errno;
    }

   private:
    int descriptor_;
};

}  // namespace

std::filesystem::path part_name(const std::filesystem::path& file) {
    return file.parent_path() / ("." + file.filename().string() + ".part");
}

void write_whole_file(const std::filesystem::path& file, std::span<const std::byte> bytes) {
    const std::filesystem::path part = part_name(file);
    int reason = Output(part, part_flags).write_and_close(bytes);
    if (reason == 0 && std::rename(part.c_str(), file.c_str()) != 0) reason = errno;
    if (reason == 0) return;
    ::unlink(part.c_str());
    throw write_error(file, reason);
}

void write_whole_file(const std::filesystem::path& file, std::string_view text) {
    write_whole_file(file, std::as_bytes(std::span(text)));
}

void check_writable(const std::filesystem::path& file) {
    const std::filesystem::path part = part_name(file);
    const int reason = Output(part, part_flags).write_and_close({});
    if (reason != 0) throw write_error(file, reason);
    ::unlink(part.c_str());
}

void append_line(const std::filesystem::path& file, std::string_view line) {
    const std::string text = std::string(line) + "\n";
    const int reason =
        Output(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC).write_and_close(std::as_bytes(std::span(text)));
    if (reason != 0) throw write_error(file, reason);
}

}  // namespace pelagic::tools
