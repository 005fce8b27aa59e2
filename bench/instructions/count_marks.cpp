#include "pelagic/bench/instructions/count_marks.hpp"

#include <cstdio>

// Not inlined, and different, so that a linker that folds identical functions does not merge them.
extern "C" {
__attribute__((noinline)) void pelagic_count_begin() { __asm__ __volatile__("" : : "r"(1)); }
__attribute__((noinline)) void pelagic_count_end() { __asm__ __volatile__("" : : "r"(2)); }
}

namespace pelagic::bench {

void print_counted(const std::string& name, double items, std::size_t blocks) {
    std::printf("%s\t%.0f\t%zu\n", name.c_str(), items, blocks);
    std::fflush(stdout);
}

}  // namespace pelagic::bench
