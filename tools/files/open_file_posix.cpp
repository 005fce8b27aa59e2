#include <fcntl.h>
#include <unistd.h>

#include "pelagic/tools/files/open_file.hpp"

namespace pelagic::tools {

Descriptor open_to_read(const std::filesystem::path& file) {
    return Descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
}

std::ptrdiff_t read_some(int descriptor, std::span<char> bytes) {
    return ::read(descriptor, bytes.data(), bytes.size());
}

SilentStderr::SilentStderr() : kept_(::fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)) {
    const Descriptor nowhere(::open("/dev/null", O_WRONLY | O_CLOEXEC));
    if (kept_.is_open() && nowhere.is_open()) ::dup2(nowhere.get(), STDERR_FILENO);
}

SilentStderr::~SilentStderr() {
    if (kept_.is_open()) ::dup2(kept_.get(), STDERR_FILENO);
}

void keep_bytes_as_they_are() {}  // POSIX streams are binary already

}  // namespace pelagic::tools
