// The message of a call that is rejected.
#pragma once

#include <stdexcept>
#include <string>

namespace pelagic {

/// Returns the message of the std::invalid_argument that a call throws, or an empty string.
template <class Call>
std::string message_of(Call&& call) {
    try {
        call();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

}  // namespace pelagic
