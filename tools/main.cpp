#include "pelagic/tools/command_line.hpp"
#include "pelagic/tools/files/open_file.hpp"

int main(int argc, char** argv) {
    pelagic::tools::keep_bytes_as_they_are();
    return pelagic::tools::run_command_line(argc, argv);
}
