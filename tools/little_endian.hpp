// Files of numbers with the lowest byte first.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace pelagic::tools {

class LittleEndianBytes {
   public:
    std::size_t size() const { return bytes_.size(); }
    std::vector<unsigned char> take() { return std::move(bytes_); }

    void add_u32(std::uint32_t value) { add_number(value, 4); }
    void add_u64(std::uint64_t value) { add_number(value, 8); }
    void add(std::span<const unsigned char> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }
    /// With the zero that ends it.
    void add_text(std::string_view text) {
        bytes_.insert(bytes_.end(), text.begin(), text.end());
        bytes_.push_back(0);
    }
    /// Zeros, until the size is a multiple of `alignment`.
    void pad_to(std::size_t alignment) { bytes_.resize((bytes_.size() + alignment - 1) / alignment * alignment); }

   private:
    void add_number(std::uint64_t value, int bytes) {
        for (int byte = 0; byte < bytes; ++byte) bytes_.push_back(static_cast<unsigned char>(value >> (8 * byte)));
    }

    std::vector<unsigned char> bytes_;
};

}  // namespace pelagic::tools
