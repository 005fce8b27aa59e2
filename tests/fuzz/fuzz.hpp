// What several fuzzers share: invariants, errors of one line, and the input as a source of values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace pelagic {

inline void must(bool holds) {
    if (!holds) std::abort();
}

/// The message of an error in a file begins with its name and says what is accepted.
inline void must_be_a_line_about(std::string_view file, std::string_view message) {
    must(message.starts_with(file) && message.size() < 300 && message.find('\n') == message.npos);
    must(message.find("expected") != message.npos || message.find("out of range") != message.npos);
}

/// The input as a source of values; 0 after its end.
class FuzzBytes {
   public:
    FuzzBytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
    bool is_empty() const { return size_ == 0; }

    template <class T>
    T take() {
        T value{};
        const std::size_t count = size_ < sizeof(T) ? size_ : sizeof(T);
        if (count > 0) std::memcpy(&value, data_, count);
        data_ += count;
        size_ -= count;
        return value;
    }

    /// Returns mostly a value in [min, max], sometimes any bits.
    double number(double min, double max) {
        const auto byte = take<std::uint8_t>();
        return byte == 255 ? take<double>() : min + (max - min) * byte / 254;
    }

   private:
    const std::uint8_t* data_;
    std::size_t size_;
};

}  // namespace pelagic
