#include "pelagic/tools/encode/image_codec.hpp"

#include "pelagic/tools/encode/codec_library.hpp"

namespace pelagic::tools {
namespace {

// Threads and address space are measured on Debian 12.
constexpr CodecLibrary image_library = {.file = "pelagic_images.so",
                                        .use = "writes and reads images",
                                        .table = "pelagic_image_codec",
                                        .threads = 4,
                                        .address_space = std::size_t{448} << 20};

}  // namespace

const ImageCodec& image_codec() {
    static const auto& codec = *static_cast<const ImageCodec*>(load_table(image_library));
    return codec;
}

}  // namespace pelagic::tools
