#include "pelagic/tools/encode/film.hpp"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/text/errors.hpp"

extern char** environ;

namespace pelagic::tools {
namespace {

constexpr const char* program = "ffmpeg";

/// Creates an anonymous file in memory, which needs no name and no cleanup.
Descriptor unnamed_file() {
    Descriptor file(::memfd_create("pelagic", MFD_CLOEXEC));
    if (!file.is_open()) throw FileError(std::string("can't keep a film: ") + std::strerror(errno));
    return file;
}

std::vector<unsigned char> content_of(const Descriptor& file) {
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) return {};
    std::vector<unsigned char> bytes(static_cast<std::size_t>(status.st_size));
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t read = ::pread(file.get(), bytes.data() + done, bytes.size() - done, static_cast<off_t>(done));
        if (read < 0 && errno == EINTR) continue;
        if (read <= 0) return {};
        done += static_cast<std::size_t>(read);
    }
    return bytes;
}

/// Starts a program in PATH with these files as standard input, output and error, in a process
/// group of its own, so that Ctrl+C in a terminal does not stop it. Returns 0 on success, else an
/// errno.
int start(const std::vector<std::string>& arguments, const std::array<const Descriptor*, 3>& standard,
          pid_t& process) {
    std::vector<char*> texts;
    for (const std::string& argument : arguments) texts.push_back(const_cast<char*>(argument.c_str()));
    texts.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    for (int number = 0; number < 3; ++number)
        ::posix_spawn_file_actions_adddup2(&actions, standard[static_cast<std::size_t>(number)]->get(), number);
    posix_spawnattr_t attributes;
    ::posix_spawnattr_init(&attributes);
    ::posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    const int failure = ::posix_spawnp(&process, texts[0], &actions, &attributes, texts.data(), environ);
    ::posix_spawnattr_destroy(&attributes);
    ::posix_spawn_file_actions_destroy(&actions);
    return failure;
}

}  // namespace

bool can_make_films() {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
    return false;
}

Film::Film(int width, int height, double frames_per_second) : film_(unnamed_file()), errors_(unnamed_file()) {
    // A socket, unlike a pipe, returns an error for an encoder that has ended, and sends no signal.
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        throw FileError(std::string("can't make a film: ") + std::strerror(errno));
    frames_ = Descriptor(ends[0]);
    const Descriptor input(ends[1]);
    // ffmpeg reopens its output by this name, so that it can seek in it, as MP4 requires.
    const std::vector<std::string> arguments = {program,
                                                "-nostdin",
                                                "-v",
                                                "error",
                                                "-y",
                                                "-f",
                                                "rawvideo",
                                                "-pix_fmt",
                                                "rgb0",
                                                "-s",
                                                number_text(width) + "x" + number_text(height),
                                                "-r",
                                                number_text(frames_per_second),
                                                "-i",
                                                "pipe:0",
                                                "-c:v",
                                                "libx264",
                                                "-crf",
                                                "18",
                                                "-pix_fmt",
                                                "yuv420p",
                                                "-map_metadata",
                                                "-1",
                                                "-fflags",
                                                "+bitexact",
                                                "-movflags",
                                                "+faststart",
                                                "-f",
                                                "mp4",
                                                "/proc/self/fd/1"};
    failure_ = start(arguments, {&input, &film_, &errors_}, process_);
}

Film::~Film() { wait(); }

int Film::wait() {
    frames_ = Descriptor();  // the end of the input
    if (process_ <= 0) return -1;
    int status = 0;
    while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) continue;
    process_ = 0;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 0 : -1;
}

void Film::add(std::span<const std::uint8_t> rgba) {
    while (failure_ == 0 && !rgba.empty()) {
        const ssize_t sent = ::send(frames_.get(), rgba.data(), rgba.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) failure_ = -1;  // the encoder has ended; finish() returns its message
        rgba = rgba.subspan(static_cast<std::size_t>(std::max<ssize_t>(sent, 0)));
    }
}

Film::Encoded Film::finish() {
    if (failure_ > 0) return {{}, std::string("can't run ffmpeg: ") + std::strerror(failure_)};
    const bool is_complete = wait() == 0 && failure_ == 0;
    Encoded encoded{content_of(film_), ""};
    if (is_complete && !encoded.mp4.empty()) return encoded;
    const std::vector<unsigned char> content = content_of(errors_);
    std::string message(content.begin(), content.end());
    message.resize(message.find_last_not_of(" \n") + 1);
    return {{}, "ffmpeg failed: " + one_line(message)};
}

}  // namespace pelagic::tools
