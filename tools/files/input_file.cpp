#include "pelagic/tools/files/input_file.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "pelagic/tools/files/open_file.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {

InputFile::InputFile(std::string option, const std::filesystem::path& file, std::string accepted, bool dash_is_stdin)
    : option_(std::move(option)), name_(file.string()), accepted_(std::move(accepted)) {
    if (dash_is_stdin && name_ == "-") {
        name_ = "standard input";
        descriptor_ = STDIN_FILENO;
        is_ours_ = false;
        return;
    }
    descriptor_ = open_to_read(file).release();
    if (descriptor_ < 0) reject(", which can't be read", errno);
}

InputFile::~InputFile() {
    if (is_ours_) ::close(descriptor_);
}

void InputFile::reject(const std::string& what, int reason) const {
    const std::string why = reason == 0 ? "" : std::string(" (") + std::strerror(reason) + ")";
    throw bad_value(option_, name_ + (reason == EISDIR ? ", a folder" : what), accepted_ + why);
}

std::size_t InputFile::read(std::span<char> bytes) {
    for (;;) {
        const std::ptrdiff_t got = read_some(descriptor_, bytes);
        if (got >= 0) return static_cast<std::size_t>(got);
        if (errno != EINTR) reject(", which can't be read", errno);
    }
}

std::string InputFile::read_all(std::size_t max_bytes) {
    constexpr std::size_t step = 1 << 16;
    std::string text;
    for (;;) {
        const std::size_t size = text.size();
        text.resize(size + step);
        const std::size_t got = read({text.data() + size, step});
        text.resize(size + got);
        if (got == 0) return text;
        if (text.size() > max_bytes) reject(", which has more than " + number_text(max_bytes >> 20) + " MiB", 0);
    }
}

}  // namespace pelagic::tools
