// The names of an export's files, and no others: what a record names is believed only if it is one of these.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

/// What an image shows, as names have it.
struct ImageMark {
    MapKind map;
    int cascade = 0;  ///< 0 is the coarsest
    int level = 0;
};

/// "displacement_0007.exr" of the coarsest cascade; "gradient_c1_0007_mip2.png" for level 2 of the next one. By a pattern:
/// "wave.gradient_c1_mip2.0007.png". \param is_alone  the frame has no other image, which a pattern needs no mark for then
std::string image_name(const MapOptions& options, const ImageMark& mark, int frame, bool is_alone);

/// "mesh_0007.obj", by a pattern "wave.mesh.0007.obj".
std::string mesh_name(const std::optional<NamePattern>& pattern, int frame, const char* extension);

/// Of all frames together: morph targets as glTF, and a point cache.
inline constexpr const char* mesh_animation_name = "mesh.glb";
inline constexpr const char* point_cache_name = "mesh.mdd";

/// The copy of the events that pushed at the water.
inline constexpr const char* events_copy_name = "sea_events.csv";

/// "sea_0007.exr", or by the pattern "wave.0007.exr": all maps of a frame.
std::string packed_name(const MapOptions& options, int frame);

/// "exr" or "png" by the type of the map's values, or the format's own.
const char* extension_of(MapKind map, const MapOptions& options);

/// True for what image_name() and packed_name() can give, without a pattern or with this one, and with any other options.
bool is_image_name(std::string_view name, const std::optional<NamePattern>& pattern);

/// Of all frames: "flipbook_foam.png" of the coarsest cascade, "flipbook_foam_c1.png" of the next one.
std::string flipbook_name(const MapOptions& options, MapKind map, int cascade);
inline constexpr const char* flipbook_json_name = "flipbook.json";

/// True for what flipbook_name() can give, with any options, and for the JSON.
bool is_flipbook_name(std::string_view name);

/// True for what mesh_name() can give, likewise, and for the two of all frames.
bool is_mesh_name(std::string_view name, const std::optional<NamePattern>& pattern);

/// True for names that an export gives to files of its own: images, meshes, flipbooks, records, journals, locks, and their parts.
bool is_export_name(std::string_view name, const std::optional<NamePattern>& pattern);

/// True for the part of such a file, which a killed export has left.
bool is_export_part(std::string_view name, const std::optional<NamePattern>& pattern);

}  // namespace pelagic::tools
