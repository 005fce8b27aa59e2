// Conversion of C++ exceptions to JavaScript errors with the same message.
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace pelagic::web {

/// Throws a JavaScript Error.
[[noreturn]] void throw_error(const char* message);

/// Returns the result of `call`. Converts its exception to a JavaScript Error.
template <class Call>
auto or_throw_error(Call&& call) {
    std::string message;
    try {
        return std::forward<Call>(call)();
    } catch (const std::bad_alloc&) {
        message = "out of memory";
    } catch (const std::exception& error) {
        message = error.what();
    }
    throw_error(message.c_str());
}

}  // namespace pelagic::web
