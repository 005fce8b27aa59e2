// A list of few values without heap memory, so that structs with lists are copied in every frame.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <vector>

namespace pelagic {

/// A list of at most `Max` values, with the names of std::vector.
template <class Value, std::size_t Max>
class FixedList {
   public:
    constexpr FixedList() = default;
    /// \throws std::length_error  more than Max values
    constexpr FixedList(std::initializer_list<Value> values) {
        for (const Value& value : values) push_back(value);
    }

    /// \throws std::length_error  more than Max values
    constexpr FixedList(const std::vector<Value>& values) {
        for (const Value& value : values) push_back(value);
    }
    bool operator==(const FixedList&) const = default;

    /// \throws std::length_error  the list is full
    constexpr void push_back(const Value& value) {
        if (size_ == Max) throw std::length_error("a list holds more values than it accepts");
        values_[size_++] = value;
    }
    /// Removes all values.
    constexpr void clear() { *this = {}; }

    /// Returns Max.
    static constexpr std::size_t max_size() { return Max; }
    /// Returns the number of values.
    constexpr std::size_t size() const { return size_; }
    /// Returns whether there are no values.
    constexpr bool empty() const { return size_ == 0; }
    /// Returns a value. \pre i < size()
    constexpr const Value& operator[](std::size_t i) const { return values_[i]; }
    /// Returns a value. \pre i < size()
    constexpr Value& operator[](std::size_t i) { return values_[i]; }
    /// Returns the first value, or end().
    constexpr const Value* begin() const { return values_.data(); }
    /// Returns the end of the values.
    constexpr const Value* end() const { return values_.data() + size_; }
    /// Returns the first value, or end().
    constexpr Value* begin() { return values_.data(); }
    /// Returns the end of the values.
    constexpr Value* end() { return values_.data() + size_; }

   private:
    std::array<Value, Max> values_{};
    std::size_t size_ = 0;
};

}  // namespace pelagic
