#include "pelagic/tools/command_line.hpp"

int main(int argc, char** argv) { return pelagic::tools::run_command_line(argc, argv); }
