// Windows implementation: a handle keeps the folder open, so that it cannot be renamed or removed;
// file functions take full paths.
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <system_error>
#include <thread>

#include "pelagic/tools/files/open_file.hpp"
#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/files/windows_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/path_text.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* can_not_write = "can't write ";
constexpr const char* can_not_read = "can't read ";

FileError file_error(const char* doing, const std::filesystem::path& file, const std::string& reason) {
    return FileError(doing + file.string() + ": " + reason);
}

FileError file_error(const char* doing, const std::filesystem::path& file, int reason) {
    return file_error(doing, file, std::strerror(reason));
}

const char* type_text(std::filesystem::file_type type) {
    if (type == std::filesystem::file_type::symlink) return "a symbolic link";
    if (type == std::filesystem::file_type::directory) return "a folder";
    return "a device";
}

/// Returns 0 or an errno.
int write_all(const Descriptor& file, std::string_view bytes) {
    constexpr std::size_t max_at_once = std::size_t{1} << 30;
    while (!bytes.empty()) {
        const int written =
            ::_write(file.get(), bytes.data(), static_cast<unsigned>(std::min(bytes.size(), max_at_once)));
        if (written < 0) return errno;
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

std::filesystem::file_type type_of(const std::filesystem::path& file, std::error_code& reason) {
    return std::filesystem::symlink_status(any_length(file), reason).type();
}

/// Calls a function of Windows that returns whether it has renamed or removed a file. Returns 0 or an
/// errno. Tries for a second, because a program that reads the file, such as a virus scanner, prevents
/// it.
template <class Change>
int try_for_a_second(const Change& change) {
    constexpr int max_tries = 45;
    for (int tries = 1;; ++tries) {
        if (change()) return 0;
        const int reason = errno_of_last_error();
        if (reason != EACCES || tries == max_tries) return reason;
        std::this_thread::sleep_for(std::chrono::milliseconds(tries));
    }
}

void remove_file(const std::filesystem::path& file) {
    try_for_a_second([&] { return ::DeleteFileW(any_length(file).c_str()); });
}

/// A file with a temporary name. The destructor removes it unless it was renamed. Windows does not
/// let another file take the name while this one is open.
class PartFile {
   public:
    explicit PartFile(std::filesystem::path path) : path_(std::move(path)) {}
    ~PartFile() {
        if (!is_ours_) return;
        file_ = {};
        remove_file(path_);
    }
    PartFile(const PartFile&) = delete;
    PartFile& operator=(const PartFile&) = delete;

    const Descriptor& file() const { return file_; }

    /// Creates the file. Returns 0 or an errno. A file of a killed run is removed unread.
    /// \param check  checks the existing file of that name, if any; throws if it must not be
    ///     removed
    int create(const std::function<void()>& check) {
        if (const int reason = create_new(); reason != EEXIST) return reason;
        check();
        remove_file(path_);
        return create_new();
    }
    /// Closes the file, since an open file cannot be renamed, then renames it. Returns 0 or an errno.
    int rename_to(const std::filesystem::path& path) {
        if (::_close(file_.release()) != 0) return errno;
        const int reason = try_for_a_second([&] {
            return ::MoveFileExW(any_length(path_).c_str(), any_length(path).c_str(), MOVEFILE_REPLACE_EXISTING);
        });
        is_ours_ = reason != 0;
        return reason;
    }

   private:
    int create_new() {
        file_ = open_binary(path_, _O_WRONLY | _O_CREAT | _O_EXCL);
        is_ours_ = file_.is_open();
        return is_ours_ ? 0 : errno;
    }

    std::filesystem::path path_;
    Descriptor file_;
    bool is_ours_ = false;
};

}  // namespace

OutputFolder::OutputFolder(std::filesystem::path path, Sync sync, const std::filesystem::path& wanted)
    : path_(std::move(path)), sync_(sync) {
    const std::filesystem::path folder = any_length(path_.empty() ? path_of(".") : path_);
    std::error_code reason;
    if (!std::filesystem::is_directory(folder, reason))
        throw file_error(can_not_write, wanted, std::filesystem::exists(folder, reason) ? ENOTDIR : ENOENT);
    // Other processes may read and write in the folder, but not remove it.
    const HANDLE held = ::CreateFileW(folder.c_str(), FILE_LIST_DIRECTORY, FILE_SHARE_READ | FILE_SHARE_WRITE,
                                      nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    if (held == INVALID_HANDLE_VALUE) throw file_error(can_not_write, wanted, EACCES);
    folder_ = Descriptor(::_open_osfhandle(reinterpret_cast<std::intptr_t>(held), _O_RDONLY));
    if (!folder_.is_open()) {
        ::CloseHandle(held);
        throw file_error(can_not_write, wanted, EMFILE);
    }
}

bool OutputFolder::has_regular_file(const std::string& name, const char* doing) const {
    assert(name.find('/') == std::string::npos);
    std::error_code reason;
    const std::filesystem::file_type type = type_of(path_ / name, reason);
    if (type == std::filesystem::file_type::not_found) return false;
    if (type == std::filesystem::file_type::none) throw file_error(doing, path_ / name, reason.message());
    if (type != std::filesystem::file_type::regular)
        throw file_error(doing, path_ / name,
                         std::string("it is ") + type_text(type) + ", expected a regular file or a free name");
    return true;
}

int OutputFolder::sync_file(const Descriptor& file) const {
    return sync_ == Sync::no || ::_commit(file.get()) == 0 ? 0 : errno;
}

int OutputFolder::write_and_sync(const Descriptor& file, std::string_view bytes) const {
    const int reason = write_all(file, bytes);
    return reason != 0 ? reason : sync_file(file);
}

void OutputFolder::write(const std::string& name, const std::function<void(const Take&)>& make) const {
    PartFile part(path_ / part_name(name));
    int reason = part.create([&] { has_regular_file(part_name(name), can_not_write); });
    const auto take = [&](std::string_view piece) {
        if (reason == 0) reason = write_all(part.file(), piece);
        if (reason != 0) throw file_error(can_not_write, path_ / name, reason);
    };
    if (reason == 0) make(take);
    if (reason == 0) reason = sync_file(part.file());
    if (reason == 0) has_regular_file(name, can_not_write);
    if (reason == 0) reason = part.rename_to(path_ / name);
    if (reason != 0) throw file_error(can_not_write, path_ / name, reason);
}

void OutputFolder::check_writable(const std::string& name) const {
    has_regular_file(name, can_not_write);
    const auto check_part = [&] { has_regular_file(part_name(name), can_not_write); };
    if (const int reason = PartFile(path_ / part_name(name)).create(check_part); reason != 0)
        throw file_error(can_not_write, path_ / name, reason);
}

void OutputFolder::sync() const {}  // NTFS journals changes of names

Descriptor OutputFolder::open_for_lines(const std::string& name) const {
    has_regular_file(name, can_not_write);
    Descriptor file = open_binary(path_ / name, _O_WRONLY | _O_APPEND);
    if (!file.is_open()) throw file_error(can_not_write, path_ / name, errno);
    return file;
}

void OutputFolder::append_line(const std::string& name, const Descriptor& file, std::string_view line) const {
    const int reason = write_and_sync(file, std::string(line) + "\n");
    if (reason != 0) throw file_error(can_not_write, path_ / name, reason);
}

Descriptor OutputFolder::open_for_reading(const std::string& name) const {
    if (!has_regular_file(name, can_not_read)) return {};
    Descriptor file = open_binary(path_ / name, _O_RDONLY);
    if (!file.is_open()) throw file_error(can_not_read, path_ / name, errno);
    return file;
}

std::size_t OutputFolder::read_some(const std::string& name, const Descriptor& file, std::span<char> bytes) const {
    const int got = ::_read(file.get(), bytes.data(), static_cast<unsigned>(bytes.size()));
    if (got < 0) throw file_error(can_not_read, path_ / name, errno);
    return static_cast<std::size_t>(got);
}

void OutputFolder::for_each_name(const std::function<void(const std::string&)>& take) const {
    std::error_code reason;
    for (std::filesystem::directory_iterator entry(any_length(path_.empty() ? path_of(".") : path_), reason), end; !reason && entry != end;
         entry.increment(reason))
        take(entry->path().filename().string());
    if (reason) throw file_error(can_not_read, path_, reason.message());
}

void OutputFolder::remove(const std::string& name) const {
    std::error_code reason;
    if (type_of(path_ / name, reason) == std::filesystem::file_type::regular)
        remove_file(path_ / name);
}

Descriptor OutputFolder::open_for_lock(const std::string& name) const {
    has_regular_file(name, can_not_write);
    Descriptor file = open_binary(path_ / name, _O_RDWR | _O_CREAT);
    if (!file.is_open()) throw file_error(can_not_write, path_ / name, errno);
    return file;
}

}  // namespace pelagic::tools
