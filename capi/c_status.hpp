// Conversion of exceptions to status codes, with the message stored for the calling thread.
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/pelagic.h"

namespace pelagic::capi {

/// Stores the message for pelagic_last_error() as one line, calls the application's error callback
/// and returns `status`. Allocates nothing, so it also works when memory is exhausted.
pelagic_status failure(pelagic_status status, const char* reason) noexcept;

/// As failure(), with the names and ranges of C for those of C++: "OceanOptions::foam" becomes
/// "pelagic_ocean_options.foam".
pelagic_status rejected(const char* reason) noexcept;

/// Throws std::invalid_argument: "ocean is NULL, expected an ocean".
[[noreturn]] void reject(const std::string& reason);

/// A call that the object's state does not allow.
struct WrongOrder : std::logic_error {
    using std::logic_error::logic_error;
};

/// Runs the body of a C function, whose checks may throw, and converts exceptions to a status.
template <class Body>
pelagic_status guarded(Body body) noexcept {
    try {
        body();
        return PELAGIC_OK;
    } catch (const WrongOrder& error) {
        return failure(PELAGIC_WRONG_ORDER, error.what());
    } catch (const ApplicationJobsError& error) {
        return failure(PELAGIC_APPLICATION_ERROR, error.what());
    } catch (const std::invalid_argument& error) {
        return rejected(error.what());
    } catch (const std::bad_alloc&) {
        return failure(PELAGIC_OUT_OF_MEMORY, "out of memory");
    } catch (const std::system_error& error) {
        return failure(PELAGIC_SYSTEM_ERROR, error.what());
    } catch (const std::exception& error) {
        return failure(PELAGIC_INTERNAL_ERROR, error.what());
    } catch (...) {
        return failure(PELAGIC_INTERNAL_ERROR, "unknown exception");
    }
}

/// Dereferences a pointer. Throws std::invalid_argument for null.
template <class T>
T& needed(T* pointer, const char* name) {
    if (!pointer) reject(std::string(name) + " is NULL, expected a pointer");
    return *pointer;
}

}  // namespace pelagic::capi
