#include "pelagic/tools/encode/exr_header.hpp"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pelagic::tools {
namespace {

constexpr std::uint32_t exr_magic = 20000630;
constexpr std::uint32_t several_parts = 0x1000;  // multi-part flag in the version field
constexpr std::size_t max_attributes = 4000;
constexpr std::size_t max_header_bytes = std::size_t{1} << 20;
constexpr std::size_t bytes_behind_channel = 16;  // type, linearity, steps in x and y

/// Reads values from the front. Throws std::runtime_error at the end of the bytes.
class HeaderReader {
   public:
    explicit HeaderReader(std::span<const unsigned char> bytes) : rest_(bytes) {}

    std::span<const unsigned char> bytes(std::size_t count) {
        if (count > rest_.size()) throw std::runtime_error("its EXR header has no end within the first 1 MiB");
        const auto taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }
    std::uint32_t number() {
        const auto four = bytes(4);
        return four[0] | std::uint32_t{four[1]} << 8 | std::uint32_t{four[2]} << 16 | std::uint32_t{four[3]} << 24;
    }
    std::string_view text() {
        const auto end = std::find(rest_.begin(), rest_.end(), 0);
        const auto taken = bytes(static_cast<std::size_t>(end - rest_.begin()) + 1);
        return {reinterpret_cast<const char*>(taken.data()), taken.size() - 1};
    }
    bool take_null() {
        if (rest_.empty() || rest_.front() != 0) return false;
        rest_ = rest_.subspan(1);
        return true;
    }

   private:
    std::span<const unsigned char> rest_;
};

std::size_t channels_in(std::span<const unsigned char> list) {
    HeaderReader reader(list);
    std::size_t channels = 0;
    for (; !reader.take_null(); ++channels) {
        reader.text();
        reader.bytes(bytes_behind_channel);
    }
    return channels;
}

}  // namespace

ExrHeaderSize read_exr_header(std::span<const unsigned char> file) {
    HeaderReader reader(file.first(std::min(file.size(), max_header_bytes)));
    if (reader.number() != exr_magic) throw std::runtime_error("it is no EXR file");
    const bool has_parts = (reader.number() & several_parts) != 0;
    ExrHeaderSize size;
    do {
        while (!reader.take_null()) {
            reader.text();
            const bool is_list_of_channels = reader.text() == "chlist";
            const std::uint32_t bytes = reader.number();
            const auto value = reader.bytes(bytes);
            if (is_list_of_channels) size.channels += channels_in(value);
            if (++size.attributes > max_attributes)
                throw std::runtime_error("its EXR header has more than " + std::to_string(max_attributes) +
                                         " attributes");
        }
    } while (has_parts && !reader.take_null());
    return size;
}

}  // namespace pelagic::tools
