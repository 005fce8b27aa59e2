// Exceptions of C++ as errors of JavaScript, whose message is the library's line.
#pragma once

#include <exception>
#include <string>
#include <utility>

namespace pelagic::web {

/// Throws a JavaScript Error.
[[noreturn]] void throw_error(const char* message);

/// Calls it; what it throws reaches JavaScript as an Error.
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
