// Streams of OpenEXR in memory, for the codecs.
#pragma once

#include <ImfIO.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

namespace pelagic::tools {

class ExrOutput final : public Imf::OStream {
   public:
    explicit ExrOutput(std::size_t capacity) : OStream("memory") { bytes_.reserve(capacity); }

    void write(const char bytes[], int count) override {
        const std::size_t end = place_ + static_cast<std::size_t>(count);
        const std::size_t over = std::min(static_cast<std::size_t>(count), bytes_.size() - place_);
        std::memcpy(bytes_.data() + place_, bytes, over);
        bytes_.insert(bytes_.end(), bytes + over, bytes + count);
        place_ = end;
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t place) override {
        if (place > bytes_.size()) bytes_.resize(place);
        place_ = place;
    }

    std::vector<unsigned char> taken() { return std::move(bytes_); }

   private:
    std::vector<unsigned char> bytes_;
    std::size_t place_ = 0;
};

/// \param bytes  must outlive the stream
class ExrInput final : public Imf::IStream {
   public:
    explicit ExrInput(std::span<const unsigned char> bytes) : IStream("memory"), bytes_(bytes) {}

    bool read(char bytes[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        if (place_ > bytes_.size() || size > bytes_.size() - place_)
            throw std::runtime_error("it ends before its pixels");
        std::memcpy(bytes, bytes_.data() + place_, size);
        place_ += size;
        return place_ < bytes_.size();
    }
    std::uint64_t tellg() override { return place_; }
    void seekg(std::uint64_t place) override { place_ = place; }

   private:
    std::span<const unsigned char> bytes_;
    std::size_t place_ = 0;
};

}  // namespace pelagic::tools
