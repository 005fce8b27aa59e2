// Executors as test parameters: every kind, with several numbers of threads; and what results must
// not depend on.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#if defined(PELAGIC_HAS_TBB)
#include <oneapi/tbb/global_control.h>
#endif

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/sliced_executor.hpp"
#include "pelagic/jobs/thread_count.hpp"
#include "pelagic/simd/isa.hpp"
#include "pelagic/tests/emulated.hpp"

namespace pelagic {

/// Lets executors of this program have more threads than CPUs.
inline const bool has_more_threads_than_cpus = [] {
    min_assumed_cpus = 1024;
    return true;
}();
#if defined(PELAGIC_HAS_TBB)
inline const tbb::global_control more_threads_of_tbb(tbb::global_control::max_allowed_parallelism, 8);
#endif

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

/// What results must not depend on.
struct Computing {
    std::string name;
    Isa isa;
    ExecutorKind kind;

    std::shared_ptr<Executor> executor() const { return kind.make(kind.threads); }
};

inline void PrintTo(const Computing& computing, std::ostream* out) { *out << computing.name; }

/// Returns each instruction set on one thread, then each executor.
inline std::vector<Computing> computings() {
    std::vector<Computing> all;
    for (const Isa isa : isas_here()) all.push_back({std::string(name_of(isa)), isa, executor_kinds().front()});
    if (is_emulated) return all;
    for (const ExecutorKind& kind : executor_kinds()) all.push_back({kind.name, choose_isa(), kind});
    return all;
}

}  // namespace pelagic
