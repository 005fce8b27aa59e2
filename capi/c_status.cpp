#include "pelagic/capi/c_status.hpp"

#include <mutex>

#include "pelagic/message/one_line.hpp"

namespace pelagic::capi {
namespace {

thread_local char last_error[max_line_bytes + 1] = "";

struct ErrorCallback {
    pelagic_error_callback function = nullptr;
    void* user = nullptr;
};
std::mutex callback_mutex;
ErrorCallback error_callback;

}  // namespace

pelagic_status failure(pelagic_status status, const char* reason) noexcept {
    last_error[write_one_line(reason, last_error)] = 0;
    try {
        // Called without the lock, because the callback may set another callback.
        const ErrorCallback current = [] {
            const std::lock_guard lock(callback_mutex);
            return error_callback;
        }();
        if (current.function) current.function(current.user, status, last_error);
    } catch (...) {  // the status reports the error
    }
    return status;
}

void reject(const std::string& reason) { throw std::invalid_argument(reason); }

}  // namespace pelagic::capi

uint32_t pelagic_version() {
    return PELAGIC_VERSION_MAJOR * 10000 + PELAGIC_VERSION_MINOR * 100 + PELAGIC_VERSION_PATCH;
}

const char* pelagic_last_error() { return pelagic::capi::last_error; }

void pelagic_set_error_callback(pelagic_error_callback callback, void* user) {
    const std::lock_guard lock(pelagic::capi::callback_mutex);
    pelagic::capi::error_callback = {callback, user};
}
