// Application-defined allocation of large buffers. Plain functions, so that C code can supply them.
#pragma once

#include <cstddef>

namespace pelagic {

/// Allocation functions of the application. Set both functions or neither; if both are null,
/// buffers use operator new. They are called on the thread that constructs, destroys or changes an
/// ocean's sea, never while a frame is computed.
struct Allocator {
    void* user = nullptr;  ///< passed to both functions; must outlive the allocated memory

    /// Allocates memory. A null result or an exception is reported as std::bad_alloc.
    /// \param bytes      size, more than 0
    /// \param alignment  a power of two; the address must be a multiple of it
    void* (*allocate)(void* user, std::size_t bytes, std::size_t alignment) = nullptr;

    /// Frees memory that allocate() returned for this size and alignment. Must not throw.
    void (*release)(void* user, void* memory, std::size_t bytes, std::size_t alignment) = nullptr;
};

}  // namespace pelagic
