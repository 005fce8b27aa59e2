#include "pelagic/tools/export/image_files.hpp"

#include "pelagic/tools/encode/exr_codec.hpp"
#include "pelagic/tools/encode/image_codec.hpp"
#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/exr_image.hpp"
#include "pelagic/tools/maps/map_image.hpp"

namespace pelagic::tools {
namespace {

/// Returns true if a file of the map contains all of its mip levels.
bool has_levels_within(const ExportOptions& options, MapKind map) {
    return is_texture(options.maps.format) || (options.maps.tiled && options.maps.is_exr(map));
}

/// Returns the number of stored mip levels. Formats with levels in a file store those of every map;
/// other formats store levels of maps that have a mip chain.
int stored_levels(const ExportOptions& options, MapKind map) {
    if (!options.maps.mips) return 1;
    return has_levels_within(options, map) || has_chain(map) ? mip_levels(resolution_of(options.sea.sea)) : 1;
}

ImageDescription description_of(MapKind map, const TextureImage& image, const MapOptions& options) {
    const bool is_png = extension_of(map, options) == std::string_view("png");
    return {.extension = extension_of(map, options),
            .width = image.width,
            .height = image.height,
            .channels = image.channels,
            .sample = image.sample,
            .colour_space = is_floating(image.sample) ? "Linear" : "Raw",
            .compression = is_png ? nullptr : name_of(options.compression).data(),
            // The default level of zlib for PNG, 6, takes four times as long for files 6 % smaller
            // (512 x 512, jonswap).
            .png_level = is_png ? 2 : 0,
            // The alpha channel is smoothness, not coverage; otherwise OpenImageIO would divide the
            // normals by it.
            .has_unassociated_alpha = map == MapKind::gradient};
}

TextureImage as_texture_image(MapImage image) {
    return {image.side, image.side, image.channels, image.sample, std::move(image.pixels)};
}

/// Returns true for a map of the sea instead of one cascade, which has no smaller levels.
bool is_of_patch(MapKind map, const MapOptions& options) { return map == MapKind::foam && options.foam_patch; }

std::vector<ImageFile> cascade_files(const ExportOptions& options, int frame) {
    std::vector<ImagePart> parts;
    for (int cascade = 0; cascade < cascades_of(options.sea.sea); ++cascade)
        for (const MapKind map : options.maps.maps) {
            if (is_of_patch(map, options.maps)) continue;
            const int levels = stored_levels(options, map);
            const int levels_a_part = has_levels_within(options, map) ? levels : 1;
            for (int level = 0; level < levels; level += levels_a_part)
                parts.push_back({.map = map, .cascade = cascade, .first_level = level, .levels = levels_a_part});
        }
    if (options.maps.pack != Pack::files && !parts.empty())
        return {{.name = packed_name(options.maps, frame), .parts = parts}};
    std::vector<ImageFile> files;
    for (const ImagePart& part : parts) {
        const ImageMark mark{.map = part.map, .cascade = part.cascade, .level = part.first_level};
        files.push_back({.name = image_name(options.maps, mark, frame, parts.size() == 1), .parts = {part}});
    }
    return files;
}

}  // namespace

std::vector<ImageFile> image_files(const ExportOptions& options, int frame) {
    std::vector<ImageFile> files = cascade_files(options, frame);
    // The foam of several cascades and the dynamic-wave grid always have their own files, because
    // their sizes differ from those of cascades.
    if (options.maps.foam_patch)
        files.push_back({.name = image_name(options.maps, {.map = MapKind::foam, .cascade = 0, .level = 0}, frame,
                                            files.empty() && !options.events),
                         .parts = {{.map = MapKind::foam}}});
    if (options.events)
        files.push_back({.name = image_name(options.maps, {.map = MapKind::dynamic_waves, .cascade = 0, .level = 0},
                                            frame, false),
                         .parts = {{.map = MapKind::dynamic_waves}}});
    return files;
}

void load_codecs(const ExportOptions& options) {
    const bool is_texture = tools::is_texture(options.maps.format);
    bool has_exr = false, has_images = options.preview || (options.flipbook && !is_texture);
    for (const ImageFile& file : image_files(options, 0)) {
        const bool is_exr = options.maps.is_exr(file.parts.front().map);
        has_exr |= is_exr;
        has_images |= !is_exr && !is_texture;
    }
    if (has_exr) exr_codec();
    if (has_images) image_codec();
}

std::vector<unsigned char> encode_image_file(const ImageFile& file, const Frame& frame, int number,
                                             const ExportOptions& options) {
    const ImagePart& part = file.parts.front();
    if (options.maps.is_exr(part.map)) return exr_codec().encode(exr_file(file, frame, number, options));
    if (part.map == MapKind::dynamic_waves)
        return encode_pixels(part.map, {as_texture_image(dynamic_waves_map_image(frame.dynamic_waves, options.maps))},
                             options.maps);
    if (is_of_patch(part.map, options.maps))
        return encode_pixels(part.map, {as_texture_image(foam_patch_image(frame, options.maps))}, options.maps);
    std::vector<TextureImage> levels;
    if (is_texture(options.maps.format))
        for (MapImage& level : map_levels(frame, part.cascade, part.map, 0, part.levels, options.maps))
            levels.push_back(as_texture_image(std::move(level)));
    else
        levels.push_back(
            as_texture_image(map_image(frame, part.cascade, part.map, part.first_level, options.maps)));
    return encode_pixels(part.map, levels, options.maps);
}

std::vector<unsigned char> encode_pixels(MapKind map, const std::vector<TextureImage>& levels,
                                         const MapOptions& options) {
    if (is_texture(options.format)) return encode_texture(levels, options);
    return image_codec().encode(description_of(map, levels.front(), options), levels.front().pixels.data());
}

}  // namespace pelagic::tools
