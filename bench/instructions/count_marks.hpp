// Where a count of instructions begins and ends. Both functions do nothing; the tool that counts knows them by name:
// valgrind by --zero-before and --dump-before, the plug-in of qemu by the symbol. See instructions.py.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

extern "C" {
void pelagic_count_begin();
void pelagic_count_end();
}

namespace pelagic::bench {

/// Prints, on one line, of what the last count was, for how many items, and in how many blocks, which may run side by side.
void print_counted(const std::string& name, double items, std::size_t blocks);

/// Runs `work` between the marks.
template <class Work>
void counted(const std::string& name, double items, Work&& work, std::size_t blocks = 1) {
    pelagic_count_begin();
    std::forward<Work>(work)();
    pelagic_count_end();
    print_counted(name, items, blocks);
}

}  // namespace pelagic::bench
