#include "pelagic/capi/c_status.hpp"

#include <mutex>
#include <string>
#include <string_view>
#include <utility>

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

pelagic_status rejected(const char* reason) noexcept {
    constexpr std::pair<std::string_view, std::string_view> names[] = {
        {"OceanOptions::", "pelagic_ocean_options."},
        {"WaterFrame::", "pelagic_water_frame."},
        {"[0, 30], or -1: chosen", "(0, 30], or 0: derived"},     // wave_height_m
        {"[0, 10], or -1: derived", "(0, 10], or 0: derived"}};  // swash_m
    try {
        std::string text = reason;
        for (const auto& [ours, of_c] : names)
            for (std::size_t at = 0; (at = text.find(ours, at)) != std::string::npos; at += of_c.size())
                text.replace(at, ours.size(), of_c);
        return failure(PELAGIC_INVALID_ARGUMENT, text.c_str());
    } catch (...) {
        return failure(PELAGIC_INVALID_ARGUMENT, reason);
    }
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
