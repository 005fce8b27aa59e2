// How C++ turns into C: exceptions into codes, reasons into one line of the calling thread.
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

/// Keeps the reason for pelagic_last_error() as one_line() does, and tells the application's callback: no memory is needed to say
/// that there is none.
pelagic_status failure(pelagic_status status, const char* reason) noexcept;

/// "ocean is NULL, needs an ocean".
[[noreturn]] void reject(const std::string& reason);

/// What the application asked for at the wrong moment.
struct WrongOrder : std::logic_error {
    using std::logic_error::logic_error;
};

/// Runs a function's body. Its checks throw as the C++ interface does; none of it gets out.
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
        return failure(PELAGIC_INVALID_ARGUMENT, error.what());
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

/// The thing behind a pointer that has to be there.
template <class T>
T& needed(T* pointer, const char* name) {
    if (!pointer) reject(std::string(name) + " is NULL, needs a pointer");
    return *pointer;
}

}  // namespace pelagic::capi
