// Throws for options that a check() rejects.
#pragma once

#include <stdexcept>
#include <string>

namespace pelagic {

/// Throws std::invalid_argument(reason) unless `reason` is empty, which is what check() returns for usable options.
inline void require(const std::string& reason) {
    if (!reason.empty()) throw std::invalid_argument(reason);
}

}  // namespace pelagic
