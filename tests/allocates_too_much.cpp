// Allocates and touches memory, to check that the tests' memory limit binds.
//
// usage: allocates_too_much MIB    exits with 0 if the whole amount was allocated
#include <cstdio>
#include <cstdlib>
#include <new>
#include <vector>

int main(int argc, char** argv) {
    constexpr long step = 16;
    const long mib = argc > 1 ? std::atol(argv[1]) : 0;
    std::vector<std::vector<char>> taken;
    try {
        for (long i = 0; i < mib; i += step) taken.emplace_back(step * 1024 * 1024, static_cast<char>(1));
    } catch (const std::bad_alloc&) {
        std::printf("bad_alloc after %zu MiB\n", taken.size() * step);
        return 1;
    }
    std::printf("nobody stopped it\n");
}
