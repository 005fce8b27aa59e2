// Two sets of buffers, so that one frame is computed while the application uses another.
#pragma once

#include <array>
#include <cstddef>

namespace pelagic {

/// Stages write to the back value, which they look up when they run.
template <class T>
class DoubleBuffer {
   public:
    T& back() { return values_[back_]; }
    const T& back() const { return values_[back_]; }
    /// Returns the value that is not written.
    const T& front() const { return values_[1 - back_]; }
    /// Swaps the values: for the next frame, or to discard the last frame without overwriting the
    /// one before it.
    void swap() { back_ = 1 - back_; }

    auto begin() { return values_.begin(); }
    auto end() { return values_.end(); }
    auto begin() const { return values_.begin(); }
    auto end() const { return values_.end(); }

   private:
    std::array<T, 2> values_;
    std::size_t back_ = 0;
};

}  // namespace pelagic
