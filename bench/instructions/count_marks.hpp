// Marks of the beginning and the end of an instruction count. The functions do nothing. The
// counting tool finds them by name: valgrind with --zero-before and --dump-before, the plug-in of
// qemu by the symbol. See instructions.py.
#pragma once

#include <cstddef>
#include <string>
#include <utility>

extern "C" {
void pelagic_count_begin();
void pelagic_count_end();
}

namespace pelagic::bench {

/// Prints one line with the name of the last count, its number of items, and its number of blocks,
/// which may run in parallel.
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
