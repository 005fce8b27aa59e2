#include "pelagic/tools/preview/film.hpp"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

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

void append(const Descriptor& file, std::span<const unsigned char> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.get(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) throw FileError(std::string("can't keep a film: ") + std::strerror(errno));
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
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

/// Runs a program in PATH with these files as standard input, output and error. Returns 0 on
/// success, an errno if the program could not be started, and -1 if it failed.
int run(const std::vector<std::string>& arguments, const std::array<const Descriptor*, 3>& standard) {
    std::vector<char*> texts;
    for (const std::string& argument : arguments) texts.push_back(const_cast<char*>(argument.c_str()));
    texts.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    for (int number = 0; number < 3; ++number)
        ::posix_spawn_file_actions_adddup2(&actions, standard[static_cast<std::size_t>(number)]->get(), number);
    pid_t process = 0;
    const int failure = ::posix_spawnp(&process, texts[0], &actions, nullptr, texts.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) return failure;
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0 ? 0 : -1;
}

}  // namespace

bool can_make_films() {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
    return false;
}

Film::Film(int width, int height, double frames_per_second)
    : width_(width), height_(height), frames_per_second_(frames_per_second), frames_(unnamed_file()) {}

void Film::add(std::span<const std::uint8_t> rgba) {
    std::vector<unsigned char> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    append(frames_, rgb);
}

Film::Encoded Film::encode() const {
    const Descriptor film = unnamed_file(), errors = unnamed_file();
    // ffmpeg reopens the standard files by these names, so that it can seek in its output, as MP4
    // requires.
    const std::vector<std::string> arguments = {program,
                                                "-nostdin",
                                                "-v",
                                                "error",
                                                "-y",
                                                "-f",
                                                "rawvideo",
                                                "-pix_fmt",
                                                "rgb24",
                                                "-s",
                                                number_text(width_) + "x" + number_text(height_),
                                                "-r",
                                                number_text(frames_per_second_),
                                                "-i",
                                                "/proc/self/fd/0",
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
    const int failure = run(arguments, {&frames_, &film, &errors});
    if (failure > 0) return {{}, std::string("can't run ffmpeg: ") + std::strerror(failure)};
    Encoded encoded{content_of(film), ""};
    if (failure == 0 && !encoded.mp4.empty()) return encoded;
    const std::vector<unsigned char> content = content_of(errors);
    std::string message(content.begin(), content.end());
    message.resize(message.find_last_not_of(" \n") + 1);
    return {{}, "ffmpeg failed: " + one_line(message)};
}

}  // namespace pelagic::tools
