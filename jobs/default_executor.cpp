#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/platform.hpp"

namespace pelagic {

int default_thread_count() { return usable_cpus(); }

std::shared_ptr<Executor> make_default_executor(int threads) {
#if defined(PELAGIC_HAS_TBB)
    return make_tbb_executor(threads);
#else
    return make_thread_executor(threads);
#endif
}

}  // namespace pelagic
