#include "pelagic/capi/status.hpp"

#include "pelagic/message/one_line.hpp"

namespace pelagic::capi {
namespace {
thread_local char last_error[most_line_bytes + 1] = "";
}

pelagic_status failure(pelagic_status status, const char* reason) noexcept {
    last_error[write_one_line(reason, last_error)] = 0;
    return status;
}

void refuse(const std::string& reason) { throw std::invalid_argument(reason); }

}  // namespace pelagic::capi

uint32_t pelagic_version() {
    return PELAGIC_VERSION_MAJOR * 10000 + PELAGIC_VERSION_MINOR * 100 + PELAGIC_VERSION_PATCH;
}

const char* pelagic_last_error() { return pelagic::capi::last_error; }
