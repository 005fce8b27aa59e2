#include "pelagic/tools/encode/exr_codec.hpp"

#include "pelagic/tools/encode/codec_library.hpp"

namespace pelagic::tools {
namespace {

// OpenEXR and its dependencies map 8 MiB on Debian 12.
constexpr CodecLibrary exr_library = {.file = "pelagic_exr.so",
                                      .use = "writes EXR files",
                                      .table = "pelagic_exr_codec",
                                      .threads = 0,
                                      .address_space = std::size_t{16} << 20};

}  // namespace

const ExrCodec& exr_codec() {
    static const auto& codec = *static_cast<const ExrCodec*>(load_table(exr_library));
    return codec;
}

}  // namespace pelagic::tools
