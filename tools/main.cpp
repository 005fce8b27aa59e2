#include "pelagic/tools/command_line.hpp"
#include "pelagic/tools/files/open_file.hpp"

#if defined(_WIN32)

#include <string>
#include <vector>

#include "pelagic/tools/files/windows_file.hpp"

// The arguments of main() would be in the code page of the system.
int wmain(int argc, wchar_t** argv) {
    pelagic::tools::keep_bytes_as_they_are();
    std::vector<std::string> arguments;
    for (int i = 0; i < argc; ++i) arguments.push_back(pelagic::tools::utf8_of(argv[i]));
    std::vector<const char*> words;
    for (const std::string& argument : arguments) words.push_back(argument.c_str());
    return pelagic::tools::run_command_line(argc, words.data());
}

#else

int main(int argc, char** argv) {
    pelagic::tools::keep_bytes_as_they_are();
    return pelagic::tools::run_command_line(argc, argv);
}

#endif
