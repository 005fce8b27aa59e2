#include "pelagic/tools/files/open_file.hpp"

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <system_error>

#include "pelagic/tools/files/windows_file.hpp"

namespace pelagic::tools {

int errno_of_last_error() {
    switch (::GetLastError()) {
        case ERROR_FILE_NOT_FOUND:
        case ERROR_PATH_NOT_FOUND:
        case ERROR_INVALID_DRIVE:
        case ERROR_BAD_NETPATH:
        case ERROR_BAD_NET_NAME: return ENOENT;
        case ERROR_ACCESS_DENIED:
        case ERROR_SHARING_VIOLATION:
        case ERROR_WRITE_PROTECT: return EACCES;
        case ERROR_LOCK_VIOLATION: return EWOULDBLOCK;
        case ERROR_FILE_EXISTS:
        case ERROR_ALREADY_EXISTS: return EEXIST;
        case ERROR_INVALID_NAME:
        case ERROR_BAD_PATHNAME: return EINVAL;
        case ERROR_DIRECTORY: return ENOTDIR;
        case ERROR_FILENAME_EXCED_RANGE: return ENAMETOOLONG;
        case ERROR_TOO_MANY_OPEN_FILES: return EMFILE;
        case ERROR_HANDLE_DISK_FULL:
        case ERROR_DISK_FULL: return ENOSPC;
        case ERROR_NOT_SUPPORTED:
        case ERROR_INVALID_FUNCTION: return ENOSYS;
        default: return EIO;
    }
}

std::filesystem::path any_length(const std::filesystem::path& path) {
    const DWORD size = ::GetFullPathNameW(path.c_str(), 0, nullptr, nullptr);
    // a folder's limit is that of a file in it with a short name
    constexpr DWORD max_of_folders = MAX_PATH - 12;
    if (path.empty() || size < max_of_folders) return path;
    std::wstring whole(size, L'\0');
    whole.resize(::GetFullPathNameW(path.c_str(), size, whole.data(), nullptr));
    if (whole.starts_with(LR"(\\?\)") || whole.starts_with(LR"(\\.\)")) return whole;
    if (whole.starts_with(LR"(\\)")) return LR"(\\?\UNC\)" + whole.substr(2);
    return LR"(\\?\)" + whole;
}

Descriptor open_binary(const std::filesystem::path& file, int how) {
    const int access = how & (_O_RDONLY | _O_WRONLY | _O_RDWR);
    const DWORD wanted =
        access == _O_RDONLY ? GENERIC_READ : access == _O_WRONLY ? GENERIC_WRITE : GENERIC_READ | GENERIC_WRITE;
    const DWORD creation = (how & _O_EXCL) ? CREATE_NEW : (how & _O_CREAT) ? OPEN_ALWAYS : OPEN_EXISTING;
    const HANDLE handle =
        ::CreateFileW(any_length(file).c_str(), wanted, FILE_SHARE_READ | FILE_SHARE_WRITE, nullptr, creation,
                      FILE_ATTRIBUTE_NORMAL, nullptr);
    if (handle == INVALID_HANDLE_VALUE) {
        errno = errno_of_last_error();
        return {};
    }
    Descriptor opened(::_open_osfhandle(reinterpret_cast<std::intptr_t>(handle),
                                        access | (how & _O_APPEND) | _O_BINARY | _O_NOINHERIT));
    if (!opened.is_open()) {
        ::CloseHandle(handle);
        errno = EMFILE;
    }
    return opened;
}

int reason_against_reading(const std::filesystem::path&) { return 0; }  // opening reports it

int try_lock(const Descriptor& file, LockKind kind) {
    const auto handle = reinterpret_cast<HANDLE>(::_get_osfhandle(file.get()));
    OVERLAPPED first_byte{};
    const DWORD how = LOCKFILE_FAIL_IMMEDIATELY | (kind == LockKind::exclusive ? LOCKFILE_EXCLUSIVE_LOCK : 0);
    return ::LockFileEx(handle, how, 0, 1, 0, &first_byte) ? 0 : errno_of_last_error();
}

Descriptor open_to_read(const std::filesystem::path& file) {
    Descriptor opened = open_binary(file, _O_RDONLY);
    std::error_code unknown;
    if (!opened.is_open() && std::filesystem::is_directory(any_length(file), unknown)) errno = EISDIR;
    return opened;
}

std::ptrdiff_t read_some(int descriptor, std::span<char> bytes) {
    constexpr std::size_t max_at_once = std::size_t{1} << 30;
    return ::_read(descriptor, bytes.data(), static_cast<unsigned>(std::min(bytes.size(), max_at_once)));
}

SilentStderr::SilentStderr() : kept_(::_dup(::_fileno(stderr))) {
    const Descriptor nowhere(::_wopen(L"NUL", _O_WRONLY | _O_NOINHERIT));
    if (kept_.is_open() && nowhere.is_open()) ::_dup2(nowhere.get(), ::_fileno(stderr));
}

SilentStderr::~SilentStderr() {
    if (kept_.is_open()) ::_dup2(kept_.get(), ::_fileno(stderr));
}

std::string utf8_of(const wchar_t* text) {
    const int size = ::WideCharToMultiByte(CP_UTF8, 0, text, -1, nullptr, 0, nullptr, nullptr);  // with the null
    std::string utf8(static_cast<std::size_t>(size), '\0');
    ::WideCharToMultiByte(CP_UTF8, 0, text, -1, utf8.data(), size, nullptr, nullptr);
    utf8.resize(utf8.size() - 1);
    return utf8;
}

void keep_bytes_as_they_are() {
    for (std::FILE* const stream : {stdin, stdout}) ::_setmode(::_fileno(stream), _O_BINARY);
    static const UINT earlier = ::GetConsoleOutputCP();
    if (earlier == 0 || !::SetConsoleOutputCP(CP_UTF8)) return;  // there is no console
    std::atexit([] { ::SetConsoleOutputCP(earlier); });
}

}  // namespace pelagic::tools
