#include "pelagic/tools/encode/flow_file.hpp"

#include <cmath>
#include <stdexcept>

#include "pelagic/tools/encode/image_codec.hpp"
#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

constexpr const char* accepted_flow_map =
    "a square PNG of 1 to 4096 pixels a side, RGB or RGBA with 8 bits a channel";

int big_endian_word_at(const std::string& bytes, std::size_t at) {
    int number = 0;
    for (std::size_t i = 0; i < 4; ++i) number = number << 8 | static_cast<unsigned char>(bytes[at + i]);
    return number;
}

}  // namespace

gl::FlowMap read_flow_map(const std::string& option, const std::string& file) {
    const std::string bytes =
        InputFile(option, file, accepted_flow_map).read_all(std::size_t{4096} * 4096 * 4 + 65536);
    // First chunk of a PNG: width, height, bit depth, colour type.
    if (bytes.size() < 33 || bytes.compare(1, 3, "PNG") != 0 || bytes.compare(12, 4, "IHDR") != 0)
        throw bad_value(option, file, accepted_flow_map);
    const int width = big_endian_word_at(bytes, 16), height = big_endian_word_at(bytes, 20), bits = bytes[24],
              kind = bytes[25];
    if (width != height || width < 1 || width > 4096 || bits != 8 || (kind != 2 && kind != 6))
        throw bad_value(option, file, accepted_flow_map);
    const int channels = kind == 2 ? 3 : 4;
    const ImageDescription image{.extension = "png",
                                 .width = width,
                                 .height = height,
                                 .channels = channels,
                                 .sample = Sample::uint8,
                                 .colour_space = "",
                                 .compression = "",
                                 .has_unassociated_alpha = true};
    gl::FlowMap map{.extent = {}, .side = width, .velocities = {}};
    try {
        const std::vector<float> pixels =
            image_codec().decode(image, {reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()});
        for (std::size_t i = 0; i < pixels.size(); i += static_cast<std::size_t>(channels))
            for (std::size_t c = 0; c < 2; ++c)
                map.velocities.push_back(static_cast<std::uint8_t>(std::lround(pixels[i + c] * 255)));
    } catch (const std::runtime_error& error) {
        throw InputError(option + " is " + file + ", expected " + accepted_flow_map + " (" + error.what() + ")");
    }
    return map;
}

}  // namespace pelagic::tools
