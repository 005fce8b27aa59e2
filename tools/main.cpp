#include <string>
#include <vector>

#include "pelagic/tools/command_line.hpp"
#include "pelagic/tools/files/open_file.hpp"

int main(int argc, char** argv) {
    pelagic::tools::keep_bytes_as_they_are();
    const std::vector<std::string> arguments = pelagic::tools::utf8_arguments(argc, argv);
    std::vector<const char*> words;
    for (const std::string& argument : arguments) words.push_back(argument.c_str());
    return pelagic::tools::run_command_line(static_cast<int>(words.size()), words.data());
}
