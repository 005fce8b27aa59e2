// Writes the manual page or the bash completion of `pelagic`, for the build.

#include <CLI/App.hpp>
#include <cstdio>
#include <fstream>
#include <string>

#include "pelagic/tools/command_line.hpp"
#include "pelagic/tools/manual/bash_completion.hpp"
#include "pelagic/tools/manual/man_page.hpp"

int main(int argc, char** argv) {
    using namespace pelagic::tools;
    const std::string kind = argc == 3 ? argv[1] : "";
    if (kind != "man" && kind != "bash") {
        std::fputs("usage: pelagic_manual man|bash FILE\n", stderr);
        return 2;
    }
    std::ofstream file(argv[2]);
    describe_command_line(
        [&](const CLI::App& app) { file << (kind == "man" ? man_page(app) : bash_completion(app)); });
    return file.flush() ? 0 : 1;
}
