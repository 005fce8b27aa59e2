// Lines and surfaces of the cascades of a frame without planes (OceanOptions::planes).
#pragma once

#include <array>
#include <atomic>
#include <cassert>
#include <cstddef>

#include "pelagic/sim/buffers/buffer_pool.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// A cascade holds a buffer from its first stage to its last. Cascades that are computed one after
/// another have the same buffer, which therefore stays in the cache. Thread-safe.
class WorkingSurfaces {
   public:
    WorkingSurfaces(std::size_t cascades, std::size_t floats, const Allocator& memory)
        : buffers_(cascades, floats, memory) {
        for (std::atomic<std::size_t>& number : held_) number = none;
    }

    /// Returns the cascade's buffer, and takes one if the cascade has none.
    float* of(std::size_t cascade) {
        std::size_t number = held_[cascade].load(std::memory_order_acquire);
        while (number == none) {
            // Several jobs of a cascade may take a buffer at once. One of them succeeds, and the
            // others give theirs back, for which a job of another cascade may have to wait.
            if (const auto taken = buffers_.take()) {
                if (held_[cascade].compare_exchange_strong(number, *taken, std::memory_order_acq_rel))
                    return buffers_[*taken];
                buffers_.give_back(*taken);
            } else {
                number = held_[cascade].load(std::memory_order_acquire);
            }
        }
        return buffers_[number];
    }
    /// Makes the cascade's buffer available to other cascades. \pre no job uses the buffer
    void release(std::size_t cascade) {
        const std::size_t number = held_[cascade].exchange(none, std::memory_order_acq_rel);
        if (number != none) buffers_.give_back(number);
    }

    std::size_t bytes() const { return buffers_.bytes(); }

   private:
    static constexpr std::size_t none = ~std::size_t{0};

    BufferPool buffers_;
    std::array<std::atomic<std::size_t>, max_cascades> held_;
};

}  // namespace pelagic
