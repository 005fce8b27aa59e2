// The tool for Windows contains its codecs: their libraries are static.
#include "pelagic/tools/encode/codec_library.hpp"

#include "pelagic/tools/encode/exr_codec.hpp"
#include "pelagic/tools/encode/image_codec.hpp"

extern "C" const pelagic::tools::ImageCodec pelagic_image_codec;
extern "C" const pelagic::tools::ExrCodec pelagic_exr_codec;

namespace pelagic::tools {

const ImageCodec& image_codec() { return pelagic_image_codec; }

const ExrCodec& exr_codec() { return pelagic_exr_codec; }

void keep_dependencies_single_threaded() {}  // it has no such dependencies

}  // namespace pelagic::tools
