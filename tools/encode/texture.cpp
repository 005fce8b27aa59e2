#include "pelagic/tools/encode/texture.hpp"

#include <algorithm>
#include <bit>

namespace pelagic::tools {

std::size_t bytes_of_texel(const Texture& texture) {
    return static_cast<std::size_t>(texture.channels) * bytes_of(texture.sample);
}

std::size_t bytes_of_level(const Texture& texture, int level) {
    const auto width = static_cast<std::size_t>(std::max(1, texture.width >> level));
    const auto height = static_cast<std::size_t>(std::max(1, texture.height >> level));
    return width * height * bytes_of_texel(texture);
}

std::string check(const Texture& texture) {
    const auto reject = [](const std::string& what, std::size_t found, const std::string& needed) {
        return what + " " + std::to_string(found) + ", expected " + needed;
    };
    if (texture.width < 1) return "width is " + std::to_string(texture.width) + ", expected at least 1";
    if (texture.height < 1) return "height is " + std::to_string(texture.height) + ", expected at least 1";
    if (texture.channels != 1 && texture.channels != 2 && texture.channels != 4)
        return "channels are " + std::to_string(texture.channels) + ", expected 1, 2 or 4";
    const auto max =
        static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(std::max(texture.width, texture.height))));
    if (texture.levels.empty() || texture.levels.size() > max)
        return reject("levels are", texture.levels.size(), "1 to " + std::to_string(max));
    for (std::size_t level = 0; level < texture.levels.size(); ++level)
        if (const std::size_t needed = bytes_of_level(texture, static_cast<int>(level));
            texture.levels[level].size() != needed)
            return reject("the bytes of level " + std::to_string(level) + " are", texture.levels[level].size(),
                          std::to_string(needed));
    return {};
}

}  // namespace pelagic::tools
