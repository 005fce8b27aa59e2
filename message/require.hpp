// Conversion of the result of check() to an exception.
#pragma once

#include <stdexcept>
#include <string>

namespace pelagic {

/// Does nothing if `reason` is empty, the result of check() for valid options.
/// \throws std::invalid_argument(reason)  otherwise
inline void require(const std::string& reason) {
    if (!reason.empty()) throw std::invalid_argument(reason);
}

/// Returns `options` if check(options) is empty.
/// \throws std::invalid_argument(check(options))  otherwise
template <class Options>
const Options& checked(const Options& options) {
    require(check(options));
    return options;
}

}  // namespace pelagic
