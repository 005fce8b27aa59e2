#include "pelagic/capi/status.hpp"

#include <algorithm>
#include <cstddef>
#include <mutex>

namespace pelagic::capi {
namespace {

constexpr std::size_t most_bytes = 300;
thread_local char last_error[most_bytes] = "";

struct ErrorCallback {
    pelagic_error_callback function = nullptr;
    void* user = nullptr;
};
std::mutex callback_mutex;
ErrorCallback callback;

/// Bytes of the character of UTF-8 that `text` begins with; 0 if it begins with none.
std::size_t character_bytes(std::string_view text) {
    const auto first = static_cast<unsigned char>(text.front());
    const std::size_t bytes = first < 0x80              ? 1
                              : (first & 0xE0u) == 0xC0 ? 2
                              : (first & 0xF0u) == 0xE0 ? 3
                              : (first & 0xF8u) == 0xF0 ? 4
                                                        : 0;
    if (bytes > text.size()) return 0;
    for (std::size_t i = 1; i < bytes; ++i)
        if ((static_cast<unsigned char>(text[i]) & 0xC0u) != 0x80) return 0;
    return bytes;
}

/// U+0000 to U+001F and U+007F to U+009F.
bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character.front());
    return first < 0x20 || first == 0x7F || (first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0);
}

void keep_as_last_error(std::string_view reason) {
    std::size_t length = 0;
    while (!reason.empty()) {
        const std::size_t bytes = character_bytes(reason);
        const std::string_view character = reason.substr(0, std::max<std::size_t>(bytes, 1));
        const std::string_view kept = bytes == 0 ? "?" : is_control(character) ? " " : character;
        if (length + kept.size() >= most_bytes) break;
        length += kept.copy(last_error + length, kept.size());
        reason.remove_prefix(character.size());
    }
    last_error[length] = 0;
}

}  // namespace

pelagic_status failure(pelagic_status status, std::string_view reason) noexcept {
    keep_as_last_error(reason);
    try {
        // Called outside the lock: it may set another one.
        const ErrorCallback current = [] {
            const std::lock_guard lock(callback_mutex);
            return callback;
        }();
        if (current.function) current.function(current.user, status, last_error);
    } catch (...) {  // nobody to tell: the status says it all
    }
    return status;
}

void refuse(const std::string& reason) { throw std::invalid_argument(reason); }

}  // namespace pelagic::capi

uint32_t pelagic_version() {
    return PELAGIC_VERSION_MAJOR * 10000 + PELAGIC_VERSION_MINOR * 100 + PELAGIC_VERSION_PATCH;
}

const char* pelagic_last_error() { return pelagic::capi::last_error; }

void pelagic_set_error_callback(pelagic_error_callback callback, void* user) {
    const std::lock_guard lock(pelagic::capi::callback_mutex);
    pelagic::capi::callback = {callback, user};
}
