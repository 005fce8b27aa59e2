// Where a count of instructions begins and ends. Both functions do nothing; the tool that counts knows them by name:
// valgrind by --zero-before and --dump-before, the plug-in of qemu by the symbol. See instructions.py.
#pragma once

#include <string>
#include <utility>

extern "C" {
void pelagic_count_begin();
void pelagic_count_end();
}

namespace pelagic::bench {

/// Runs `work` between the marks and prints, on one line, of what and for how many items the next count is.
void print_counted(const std::string& name, double items);

template <class Work>
void counted(const std::string& name, double items, Work&& work) {
    pelagic_count_begin();
    std::forward<Work>(work)();
    pelagic_count_end();
    print_counted(name, items);
}

}  // namespace pelagic::bench
