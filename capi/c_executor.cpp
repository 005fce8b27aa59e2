#include "pelagic/capi/c_executor.hpp"

#include "pelagic/capi/c_status.hpp"
#include "pelagic/capi/sized_struct.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic::capi {
namespace {

std::shared_ptr<Executor> make_executor(const pelagic_executor_options& options) {
    if (options.cpu_mask != 0 && options.kind != PELAGIC_EXECUTOR_THREADS)
        reject("cpu_mask is set, expected PELAGIC_EXECUTOR_THREADS");
    switch (options.kind) {
        case PELAGIC_EXECUTOR_DEFAULT: return make_default_executor(options.threads);
        case PELAGIC_EXECUTOR_SERIAL: return make_serial_executor();
        case PELAGIC_EXECUTOR_THREADS: return make_thread_executor_on(options.cpu_mask, options.threads);
        case PELAGIC_EXECUTOR_TBB:
#if defined(PELAGIC_HAS_TBB)
            return make_tbb_executor(options.threads);
#else
            reject("kind is PELAGIC_EXECUTOR_TBB, expected a library built with PELAGIC_TBB");
#endif
        case PELAGIC_EXECUTOR_APPLICATION:
            return make_callback_executor({.user = options.user,
                                           .parallel_for = options.parallel_for,
                                           .submit = options.submit,
                                           .threads = options.threads == 0 ? 1 : options.threads});
        default: reject(invalid_value_message("kind", options.kind, "0 to 4"));
    }
}

}  // namespace
}  // namespace pelagic::capi

using namespace pelagic::capi;

pelagic_status pelagic_executor_create(const pelagic_executor_options* options, pelagic_executor** executor) {
    return guarded([&] {
        pelagic_executor*& out = needed(executor, "executor");
        out = nullptr;
        out = new pelagic_executor{make_executor(read_struct(options, "options"))};
    });
}

void pelagic_executor_destroy(pelagic_executor* executor) { delete executor; }

pelagic_status pelagic_executor_set_spin_us(pelagic_executor* executor, int32_t us) {
    return guarded([&] { needed(executor, "executor").executor->set_spin_us(us); });
}
