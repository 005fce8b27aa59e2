// Fixed-size, zeroed buffers aligned to 64 bytes, for aligned loads of every instruction set.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "pelagic/simd/allocator.hpp"

namespace pelagic {

template <class T>
class AlignedBuffer {
    static_assert(std::is_trivially_copyable_v<T>);

   public:
    static constexpr std::size_t alignment = 64;

    AlignedBuffer() = default;
    /// Allocates `size` zeroed elements.
    /// \throws std::bad_alloc         if the allocation fails
    /// \throws std::invalid_argument  if the application's allocator returns unaligned memory
    explicit AlignedBuffer(std::size_t size, const Allocator& memory = {}) : memory_(memory), size_(size) {
        if (size == 0) return;
        data_ = static_cast<T*>(allocated());
        std::memset(static_cast<void*>(data_), 0, bytes());
    }
    AlignedBuffer(AlignedBuffer&& other) noexcept : AlignedBuffer() { swap(other); }
    AlignedBuffer& operator=(AlignedBuffer&& other) noexcept {
        swap(other);
        return *this;
    }
    ~AlignedBuffer() {
        if (!data_) return;
        if (memory_.release)
            memory_.release(memory_.user, data_, bytes(), alignment);
        else
            ::operator delete (data_, std::align_val_t{alignment});
    }

    T* data() { return data_; }
    const T* data() const { return data_; }
    std::size_t size() const { return size_; }
    std::size_t bytes() const { return size_ * sizeof(T); }
    T& operator[](std::size_t i) { return data_[i]; }
    const T& operator[](std::size_t i) const { return data_[i]; }

   private:
    void* allocated() const {
        if (!memory_.allocate) return ::operator new (bytes(), std::align_val_t{alignment});
        void* given = nullptr;
        try {
            given = memory_.allocate(memory_.user, bytes(), alignment);
        } catch (...) {
            throw std::bad_alloc();
        }
        if (!given) throw std::bad_alloc();
        if (reinterpret_cast<std::uintptr_t>(given) % alignment == 0) return given;
        memory_.release(memory_.user, given, bytes(), alignment);
        throw std::invalid_argument("the application's memory is not aligned, expected multiples of 64");
    }

    void swap(AlignedBuffer& other) noexcept {
        std::swap(memory_, other.memory_);
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
    }

    Allocator memory_;
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace pelagic
