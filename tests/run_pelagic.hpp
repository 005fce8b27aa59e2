// Runs the `pelagic` command as a shell would, and reads the files that it writes.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

namespace pelagic {

using Arguments = std::vector<std::string>;
using Files = std::map<std::string, std::string>;  ///< bytes by name

struct Outcome {
    int exit_code = -1;  ///< or 128 + signal
    std::string out, err;
};

/// Starts `pelagic` with stdout and stderr redirected to files and returns its process. Before
/// exec, the child calls `in_child` (limits, users).
pid_t start_pelagic(const std::vector<std::string>& arguments, const std::filesystem::path& out,
                    const std::filesystem::path& err, const std::function<void()>& in_child = {});

/// Returns the exit code, 0 to 255, or 128 + signal.
int wait_for(pid_t process);

Outcome run_pelagic(const std::vector<std::string>& arguments, const std::function<void()>& in_child = {});

/// Expects the exit code, and one line on stderr that contains `expected`.
void expect_one_line(const Outcome& outcome, int exit_code, const std::string& expected);

/// Returns the first arguments, then the others.
Arguments joined(Arguments first, const Arguments& more);

/// Two maps for --maps, so that a frame has several files: EXR only, or with PNG, which takes much
/// more time.
inline const std::string two_exr_maps = "displacement,compression", maps_with_png = "displacement,gradient";

/// Returns the arguments of an export of one small cascade. Without --maps among `more` it writes
/// EXR files of displacements only: for PNG and TIFF the command loads the image library, which
/// takes much more time than such an export.
Arguments small_export(const std::filesystem::path& folder, const Arguments& more = {});

/// For `in_child`: permanently drops root's capabilities to bypass file permissions. The process
/// stays root, because another user might not reach the temporary folders.
void obey_permissions();

/// A folder that is empty at first and is removed by the destructor.
class TemporaryFolder {
   public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

   private:
    std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& file);
void write_file(const std::filesystem::path& file, const std::string& text);
std::vector<std::string> lines_of(const std::string& text);

/// Returns every file of a folder, including hidden files, and its bytes.
Files files_in(const std::filesystem::path& folder);

/// Waits until the condition holds. Returns false after two minutes.
template <class Condition>
bool comes_true(Condition condition) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (!condition()) {
        if (std::chrono::steady_clock::now() > deadline) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return true;
}

}  // namespace pelagic
