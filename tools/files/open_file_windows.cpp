#include <fcntl.h>
#include <io.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "pelagic/tools/files/open_file.hpp"

namespace pelagic::tools {

Descriptor open_to_read(const std::filesystem::path& file) {
    Descriptor opened(::_wopen(file.c_str(), _O_RDONLY | _O_BINARY | _O_NOINHERIT));
    std::error_code unknown;
    if (!opened.is_open() && std::filesystem::is_directory(file, unknown)) errno = EISDIR;
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

void keep_bytes_as_they_are() {
    for (std::FILE* const stream : {stdin, stdout}) ::_setmode(::_fileno(stream), _O_BINARY);
}

}  // namespace pelagic::tools
