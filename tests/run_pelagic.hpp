// Runs the real `pelagic` as a user's shell would, and looks at what it leaves.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace pelagic {

struct Outcome {
    int exit_code = -1;  ///< or 128 + signal
    std::string out, err;
};

/// Starts it with stdout and stderr in files, runs `in_child` before exec (limits, users), returns its process.
pid_t start_pelagic(const std::vector<std::string>& arguments, const std::filesystem::path& out,
                    const std::filesystem::path& err, const std::function<void()>& in_child = {});

/// 0 to 255, or 128 + signal.
int wait_for(pid_t process);

Outcome run_pelagic(const std::vector<std::string>& arguments, const std::function<void()>& in_child = {});

/// For `in_child`: root gives up what lets it pass over permissions, for good. It stays root, so that it reaches its own
/// folders wherever they are, which another user might not.
void obey_permissions();

/// A folder that is empty at first and gone at the end.
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

/// Every file in a folder, hidden ones too, and its bytes.
std::map<std::string, std::string> files_in(const std::filesystem::path& folder);

}  // namespace pelagic
