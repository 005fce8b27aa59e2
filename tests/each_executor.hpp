// Executors as test parameters: every kind, with several numbers of threads.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/sliced_executor.hpp"

namespace pelagic {

struct ExecutorKind {
    std::string name;
    std::shared_ptr<Executor> (*make)(int threads);
    int threads;
};

inline void PrintTo(const ExecutorKind& kind, std::ostream* out) { *out << kind.name; }

inline std::vector<ExecutorKind> executor_kinds() {
    std::vector<ExecutorKind> all = {
        {"serial", [](int) { return make_serial_executor(); }, 1},
        {"sliced", [](int) -> std::shared_ptr<Executor> { return make_sliced_executor(); }, 1}};
    for (const int threads : {1, 2, 3, 8}) {
        all.push_back({"thread_" + std::to_string(threads), make_thread_executor, threads});
#if defined(PELAGIC_HAS_TBB)
        all.push_back({"tbb_" + std::to_string(threads), make_tbb_executor, threads});
#endif
    }
    return all;
}

}  // namespace pelagic
