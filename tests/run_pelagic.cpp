#include "pelagic/tests/run_pelagic.hpp"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace pelagic {

pid_t start_pelagic(const std::vector<std::string>& arguments, const std::filesystem::path& out,
                    const std::filesystem::path& err, const std::function<void()>& in_child) {
    std::vector<const char*> words = {PELAGIC_BINARY};
    for (const std::string& argument : arguments) words.push_back(argument.c_str());
    words.push_back(nullptr);
    const pid_t process = ::fork();
    if (process < 0) throw std::runtime_error("fork failed");
    if (process > 0) return process;

    ::dup2(::open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDOUT_FILENO);
    ::dup2(::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666), STDERR_FILENO);
    if (in_child) in_child();
    ::execv(PELAGIC_BINARY, const_cast<char* const*>(words.data()));
    std::_Exit(127);
}

int wait_for(pid_t process) {
    int status = 0;
    ::waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

Outcome run_pelagic(const std::vector<std::string>& arguments, const std::function<void()>& in_child) {
    const TemporaryFolder folder;
    Outcome outcome;
    outcome.exit_code = wait_for(start_pelagic(arguments, folder / "out", folder / "err", in_child));
    outcome.out = read_file(folder / "out");
    outcome.err = read_file(folder / "err");
    return outcome;
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "pelagic_test_XXXXXX").string();
    if (!::mkdtemp(name.data())) throw std::runtime_error("can't make " + name);
    path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string read_file(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

void write_file(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file, std::ios::binary) << text;
}

void obey_permissions() {
    if (::getuid() != 0) return;
    for (const int power : {CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH})
        if (::prctl(PR_CAPBSET_DROP, power) != 0) std::_Exit(126);
}

std::map<std::string, std::string> files_in(const std::filesystem::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        files[entry.path().filename().string()] = read_file(entry.path());
    return files;
}

}  // namespace pelagic
