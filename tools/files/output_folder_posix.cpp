// POSIX implementation: an open folder descriptor, and system calls relative to it.
#include "pelagic/tools/files/output_folder.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

/// O_NOFOLLOW: links are not followed. O_NONBLOCK: opening does not block if a FIFO has taken the
/// name in the meantime.
constexpr int careful = O_NOFOLLOW | O_NONBLOCK | O_NOCTTY | O_CLOEXEC;

constexpr const char* can_not_write = "can't write ";
constexpr const char* can_not_read = "can't read ";

FileError file_error(const char* doing, const std::filesystem::path& file, const std::string& reason) {
    return FileError(doing + file.string() + ": " + reason);
}

FileError file_error(const char* doing, const std::filesystem::path& file, int reason) {
    return file_error(doing, file, std::strerror(reason));
}

const char* type_text(mode_t mode) {
    if (S_ISLNK(mode)) return "a symbolic link";
    if (S_ISDIR(mode)) return "a folder";
    if (S_ISFIFO(mode)) return "a FIFO";
    if (S_ISSOCK(mode)) return "a socket";
    return "a device";
}

FileError not_regular(const char* doing, const std::filesystem::path& file, mode_t mode) {
    return file_error(doing, file,
                      std::string("it is ") + type_text(mode) + ", expected a regular file or a free name");
}

/// Throws FileError unless the open file is regular. Checks the descriptor because the name may
/// refer to another file by now.
void require_regular(const Descriptor& file, const char* doing, const std::filesystem::path& path) {
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) throw file_error(doing, path, errno);
    if (!S_ISREG(status.st_mode)) throw not_regular(doing, path, status.st_mode);
}

/// Returns 0 or an errno.
int write_all(const Descriptor& file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

/// A file with a temporary name. The destructor removes it unless it was renamed.
class PartFile {
   public:
    PartFile(const Descriptor& folder, std::string name) : folder_(folder), name_(std::move(name)) {}
    ~PartFile() {
        if (!is_renamed_ && has_its_name()) ::unlinkat(folder_.get(), name_.c_str(), 0);
    }
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    const Descriptor& file() const { return file_; }

    /// Creates the file. Returns 0 or an errno. A file of a killed run is removed unread: it may be
    /// a hard link to a file of the user.
    /// \param check  checks the existing file of that name, if any; throws if it must not be
    ///     removed
    int create(const std::function<void()>& check) {
        if (const int reason = create_new(); reason != EEXIST) return reason;
        check();
        ::unlinkat(folder_.get(), name_.c_str(), 0);
        return create_new();
    }
    /// Returns 0, or an errno that the system reports only on close, such as a full disk over NFS.
    /// Closes a duplicate, since the number of a closed descriptor may be reused.
    int flush() {
        const int copy = ::fcntl(file_.get(), F_DUPFD_CLOEXEC, 0);
        return copy >= 0 && ::close(copy) == 0 ? 0 : errno;
    }
    /// Renames the file. Returns 0 or an errno; EBUSY if another process has started to write a
    /// file of that name.
    int rename_to(const std::string& name) {
        if (!has_its_name()) return EBUSY;
        is_renamed_ = ::renameat(folder_.get(), name_.c_str(), folder_.get(), name.c_str()) == 0;
        return is_renamed_ ? 0 : errno;
    }

   private:
    int create_new() {
        file_ = Descriptor(::openat(folder_.get(), name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | careful, 0666));
        return file_.is_open() && ::fstat(file_.get(), &created_) == 0 ? 0 : errno;
    }
    bool has_its_name() const {
        struct stat status {};
        return created_.st_ino != 0 && ::fstatat(folder_.get(), name_.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 &&
               status.st_dev == created_.st_dev && status.st_ino == created_.st_ino;
    }

    const Descriptor& folder_;
    std::string name_;
    Descriptor file_;
    struct stat created_ {};
    bool is_renamed_ = false;
};

}  // namespace

OutputFolder::OutputFolder(std::filesystem::path path, Sync sync, const std::filesystem::path& wanted)
    : path_(std::move(path)),
      sync_(sync),
      folder_(::open(path_.empty() ? "." : path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (!folder_.is_open()) throw file_error(can_not_write, wanted, errno);
}

bool OutputFolder::has_regular_file(const std::string& name, const char* doing) const {
    assert(name.find('/') == std::string::npos);
    struct stat status {};
    if (::fstatat(folder_.get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
        if (errno == ENOENT) return false;
        throw file_error(doing, path_ / name, errno);
    }
    if (!S_ISREG(status.st_mode)) throw not_regular(doing, path_ / name, status.st_mode);
    return true;
}

int OutputFolder::sync_file(const Descriptor& file) const {
    return sync_ == Sync::no || ::fdatasync(file.get()) == 0 ? 0 : errno;
}

int OutputFolder::write_and_sync(const Descriptor& file, std::string_view bytes) const {
    const int reason = write_all(file, bytes);
    return reason != 0 ? reason : sync_file(file);
}

void OutputFolder::write(const std::string& name, const std::function<void(const Take&)>& make) const {
    PartFile part(folder_, part_name(name));
    int reason = part.create([&] { has_regular_file(part_name(name), can_not_write); });
    const auto take = [&](std::string_view piece) {
        if (reason == 0) reason = write_all(part.file(), piece);
        if (reason != 0) throw file_error(can_not_write, path_ / name, reason);
    };
    if (reason == 0) make(take);
    if (reason == 0) reason = sync_file(part.file());
    if (reason == 0) reason = part.flush();
    if (reason == 0) has_regular_file(name, can_not_write);
    if (reason == 0) reason = part.rename_to(name);
    if (reason != 0) throw file_error(can_not_write, path_ / name, reason);
}

void OutputFolder::check_writable(const std::string& name) const {
    has_regular_file(name, can_not_write);
    const auto check_part = [&] { has_regular_file(part_name(name), can_not_write); };
    if (const int reason = PartFile(folder_, part_name(name)).create(check_part); reason != 0)
        throw file_error(can_not_write, path_ / name, reason);
}

void OutputFolder::sync() const {
    if (sync_ == Sync::yes && ::fsync(folder_.get()) != 0) throw file_error(can_not_write, path_, errno);
}

Descriptor OutputFolder::open_for_lines(const std::string& name) const {
    has_regular_file(name, can_not_write);
    Descriptor file(::openat(folder_.get(), name.c_str(), O_WRONLY | O_APPEND | careful));
    if (!file.is_open()) throw file_error(can_not_write, path_ / name, errno);
    require_regular(file, can_not_write, path_ / name);
    return file;
}

void OutputFolder::append_line(const std::string& name, const Descriptor& file, std::string_view line) const {
    const int reason = write_and_sync(file, std::string(line) + "\n");
    if (reason != 0) throw file_error(can_not_write, path_ / name, reason);
}

Descriptor OutputFolder::open_for_reading(const std::string& name) const {
    if (!has_regular_file(name, can_not_read)) return {};
    Descriptor file(::openat(folder_.get(), name.c_str(), O_RDONLY | careful));
    if (!file.is_open()) throw file_error(can_not_read, path_ / name, errno);
    require_regular(file, can_not_read, path_ / name);
    return file;
}

std::size_t OutputFolder::read_some(const std::string& name, const Descriptor& file, std::span<char> bytes) const {
    for (;;) {
        const ssize_t got = ::read(file.get(), bytes.data(), bytes.size());
        if (got >= 0) return static_cast<std::size_t>(got);
        if (errno != EINTR) throw file_error(can_not_read, path_ / name, errno);
    }
}

void OutputFolder::for_each_name(const std::function<void(const std::string&)>& take) const {
    Descriptor again(::openat(folder_.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    const auto close = [](DIR* folder) { ::closedir(folder); };
    const std::unique_ptr<DIR, decltype(close)> folder(again.is_open() ? ::fdopendir(again.get()) : nullptr, close);
    if (!folder) throw file_error(can_not_read, path_, errno);
    again.release();  // closedir() closes the descriptor
    for (;;) {
        errno = 0;
        const dirent* const entry = ::readdir(folder.get());
        if (!entry && errno != 0) throw file_error(can_not_read, path_, errno);
        if (!entry) return;
        take(entry->d_name);
    }
}

void OutputFolder::remove(const std::string& name) const {
    struct stat status {};
    if (::fstatat(folder_.get(), name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(status.st_mode))
        ::unlinkat(folder_.get(), name.c_str(), 0);
}

Descriptor OutputFolder::open_for_lock(const std::string& name) const {
    has_regular_file(name, can_not_write);
    // A lock over NFS needs a file open for writing. A file of another user can still be locked
    // read-only.
    Descriptor file(::openat(folder_.get(), name.c_str(), O_RDWR | O_CREAT | careful, 0666));
    const int reason = errno;
    if (!file.is_open()) file = Descriptor(::openat(folder_.get(), name.c_str(), O_RDONLY | careful));
    if (!file.is_open()) throw file_error(can_not_write, path_ / name, reason);
    require_regular(file, can_not_write, path_ / name);
    return file;
}

}  // namespace pelagic::tools
