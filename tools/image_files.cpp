#include "pelagic/tools/image_files.hpp"

#include "pelagic/tools/export_names.hpp"
#include "pelagic/tools/image_codec.hpp"

namespace pelagic::tools {
namespace {

/// Levels of a map that have files.
int levels_of(const ExportOptions& options, MapKind map) {
    if (!options.maps.mips || !(has_chain(map) || is_texture(options.maps.format))) return 1;
    return mip_levels(resolution_of(options.sea.sea));
}

int levels_a_file(const ExportOptions& options, MapKind map) {
    return is_texture(options.maps.format) ? levels_of(options, map) : 1;
}

ImageDescription description_of(MapKind map, const TextureImage& image, const MapOptions& options) {
    const bool is_png = extension_of(map, options) == std::string_view("png");
    return {.extension = extension_of(map, options),
            .width = image.width,
            .height = image.height,
            .channels = image.channels,
            .sample = image.sample,
            .colour_space = image.sample == Sample::uint8 ? "Raw" : "Linear",
            .compression = is_png ? nullptr : "zip",
            // zlib's default for PNG, 6, takes four times as long for files 6 % smaller (512 x 512, jonswap).
            .png_level = is_png ? 2 : 0,
            // A smoothness, not a coverage: else OpenImageIO would divide the normals by it.
            .has_unassociated_alpha = map == MapKind::gradient};
}

TextureImage square(MapImage image) {
    return {image.side, image.side, image.channels, image.sample, std::move(image.pixels)};
}

}  // namespace

std::vector<ImageFile> image_files(const ExportOptions& options, int frame) {
    std::vector<ImageMark> marks;
    for (int tile = 0; tile < cascades_of(options.sea.sea); ++tile)
        for (const MapKind map : options.maps.maps)
            for (int level = 0; level < levels_of(options, map); level += levels_a_file(options, map))
                marks.push_back({map, tile, level});
    std::vector<ImageFile> files;
    for (const ImageMark& mark : marks)
        files.push_back({.name = image_name(options.maps, mark, frame, marks.size() == 1),
                         .parts = {{.map = mark.map,
                                    .tile = mark.tile,
                                    .first_level = mark.level,
                                    .levels = levels_a_file(options, mark.map)}}});
    return files;
}

std::vector<unsigned char> encode_pixels(MapKind map, const std::vector<TextureImage>& levels,
                                         const MapOptions& options) {
    if (is_texture(options.format)) return encode_texture(levels, options);
    return image_codec().encode(description_of(map, levels.front(), options), levels.front().pixels.data());
}

std::vector<unsigned char> encode_image_file(const ImageFile& file, const Frame& frame, const MapOptions& options) {
    const ImagePart& part = file.parts.front();
    const Tile& tile = frame.tiles[static_cast<std::size_t>(part.tile)];
    const Sample sample = options.sample_of(part.map);
    std::vector<TextureImage> levels;
    if (is_texture(options.format))
        for (MapImage& level : map_levels(tile, part.map, part.levels, sample))
            levels.push_back(square(std::move(level)));
    else
        levels.push_back(square(map_image(tile, part.map, part.first_level, sample)));
    return encode_pixels(part.map, levels, options);
}

}  // namespace pelagic::tools
