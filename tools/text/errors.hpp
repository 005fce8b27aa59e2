// Exceptions for failed commands. run_command_line() prints the message and returns the exit code.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic::tools {

/// Invalid input: an option, a value or an input file. Exit code 2; nothing has been written.
struct InputError : std::runtime_error {
    explicit InputError(const std::string& what) : std::runtime_error(one_line(what)) {}
};

/// A file cannot be written or read. Exit code 1.
struct FileError : std::runtime_error {
    explicit FileError(const std::string& what) : std::runtime_error(one_line(what)) {}
};

/// Makes the error "--wind-speed -3 is out of range (0, 60]".
inline InputError bad_value(std::string_view option, std::string_view value, std::string_view accepted) {
    return InputError(invalid_value_message(option, value, accepted));
}

}  // namespace pelagic::tools
