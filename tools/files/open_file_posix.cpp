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

void keep_bytes_as_they_are() {}  // POSIX streams are binary already

}  // namespace pelagic::tools
