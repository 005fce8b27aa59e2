// Where large buffers come from, if not from operator new: an application's own heap, as plain functions so that C can give them.
#pragma once

#include <cstddef>

namespace pelagic {

/// Both functions or neither. They are called by whoever constructs, destroys or changes the sea of an ocean, never
/// while a frame is computed.
struct Allocator {
    void* user = nullptr;  ///< handed to both; outlives what was allocated

    /// `bytes`, which are more than 0, at a multiple of `alignment`, a power of two. Null or an exception means that there is
    /// no such memory, and becomes std::bad_alloc.
    void* (*allocate)(void* user, std::size_t bytes, std::size_t alignment) = nullptr;

    /// Takes back what allocate() gave, with the same figures. Must not throw.
    void (*release)(void* user, void* memory, std::size_t bytes, std::size_t alignment) = nullptr;
};

}  // namespace pelagic
