#include "pelagic/tools/image_files.hpp"

#include "pelagic/tools/export_names.hpp"
#include "pelagic/tools/exr_image.hpp"
#include "pelagic/tools/image_codec.hpp"

namespace pelagic::tools {
namespace {

/// Levels of a map that are stored: an EXR file of tiles has those of every map, other files those of maps with a chain.
int levels_of(const ExportOptions& options, MapKind map) {
    if (!options.maps.mips) return 1;
    const bool has_levels_within = options.maps.tiled && options.maps.is_exr(map);
    return has_levels_within || has_chain(map) ? mip_levels(resolution_of(options.sea.sea)) : 1;
}

ImageDescription description_of(const ImagePart& part, const MapImage& image, const MapOptions& options) {
    const bool is_png = extension_of(part.map, options) == std::string_view("png");
    return {.extension = extension_of(part.map, options),
            .width = image.side,
            .height = image.side,
            .channels = image.channels,
            .sample = image.sample,
            .colour_space = image.sample == Sample::uint8 ? "Raw" : "Linear",
            .compression = is_png ? nullptr : name_of(options.compression),
            // zlib's default for PNG, 6, takes four times as long for files 6 % smaller (512 x 512, jonswap).
            .png_level = is_png ? 2 : 0,
            // A smoothness, not a coverage: else OpenImageIO would divide the normals by it.
            .has_unassociated_alpha = part.map == MapKind::gradient};
}

}  // namespace

std::vector<ImageFile> image_files(const ExportOptions& options, int frame) {
    std::vector<ImagePart> parts;
    for (int tile = 0; tile < cascades_of(options.sea.sea); ++tile)
        for (const MapKind map : options.maps.maps) {
            const int levels = levels_of(options, map);
            const int levels_a_part = options.maps.tiled && options.maps.is_exr(map) ? levels : 1;
            for (int level = 0; level < levels; level += levels_a_part)
                parts.push_back({.map = map, .tile = tile, .first_level = level, .levels = levels_a_part});
        }
    if (options.maps.pack != Pack::files && !parts.empty())
        return {{.name = packed_name(options.maps, frame), .parts = parts}};
    std::vector<ImageFile> files;
    for (const ImagePart& part : parts) {
        const ImageMark mark{.map = part.map, .tile = part.tile, .level = part.first_level};
        files.push_back({.name = image_name(options.maps, mark, frame, parts.size() == 1), .parts = {part}});
    }
    return files;
}

std::vector<unsigned char> encode_image_file(const ImageFile& file, const Frame& frame, int number,
                                             const ExportOptions& options) {
    const ImagePart& part = file.parts.front();
    if (options.maps.is_exr(part.map)) return image_codec().encode_exr(exr_file(file, frame, number, options));
    const Tile& tile = frame.tiles[static_cast<std::size_t>(part.tile)];
    const MapImage image = map_image(tile, part.map, part.first_level, options.maps.sample_of(part.map));
    return image_codec().encode(description_of(part, image, options.maps), image.pixels.data());
}

}  // namespace pelagic::tools
