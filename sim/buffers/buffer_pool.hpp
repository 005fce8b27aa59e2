// Buffers that concurrent jobs take in turn. A job takes the free buffer with the lowest number, so
// that few buffers are in use and stay in the cache.
#pragma once

#include <atomic>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// Thread-safe and lock-free.
class BufferPool {
   public:
    static constexpr std::size_t max_buffers = 64;

    /// \param count  in [1, max_buffers]
    BufferPool(std::size_t count, std::size_t floats, const Allocator& memory)
        : free_(~std::uint64_t{0} >> (max_buffers - count)) {
        assert(count >= 1 && count <= max_buffers);
        for (std::size_t i = 0; i < count; ++i) buffers_.emplace_back(floats, memory);
    }

    /// Takes a buffer and returns its number; empty if all are taken.
    std::optional<std::size_t> take() {
        std::uint64_t free = free_.load(std::memory_order_relaxed);
        while (free != 0)
            if (free_.compare_exchange_weak(free, free & (free - 1), std::memory_order_acquire,
                                            std::memory_order_relaxed))
                return static_cast<std::size_t>(std::countr_zero(free));
        return {};
    }
    /// \pre the caller took the buffer
    void give_back(std::size_t number) { free_.fetch_or(std::uint64_t{1} << number, std::memory_order_release); }

    float* operator[](std::size_t number) { return buffers_[number].data(); }
    std::size_t bytes() const { return buffers_.size() * (sizeof(buffers_[0]) + buffers_[0].bytes()); }

   private:
    std::vector<AlignedBuffer<float>> buffers_;
    std::atomic<std::uint64_t> free_;
};

}  // namespace pelagic
