// Names of an export's files. Names in a record are accepted only if they match one of these.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

/// Map, cascade and mip level of an image, which its name contains.
struct ImageMark {
    MapKind map;
    int cascade = 0;  ///< 0 is the coarsest
    int level = 0;
};

/// Returns the name of an image: "displacement_0007.exr" for the coarsest cascade;
/// "gradient_c1_0007_mip2.png" for level 2 of the next one. With a pattern:
/// "wave.gradient_c1_mip2.0007.png".
/// \param is_alone  the frame has no other image, so a name by a pattern omits map and cascade
std::string image_name(const MapOptions& options, const ImageMark& mark, int frame, bool is_alone);

/// Returns "mesh_0007.obj", or with a pattern "wave.mesh.0007.obj".
std::string mesh_name(const std::optional<NamePattern>& pattern, int frame, const char* extension);

/// Meshes of all frames: morph targets as glTF, and a point cache.
inline constexpr const char* mesh_animation_name = "mesh.glb";
inline constexpr const char* point_cache_name = "mesh.mdd";

/// Name of the copy of the events file, which contains the commands for dynamic waves.
inline constexpr const char* events_copy_name = "sea_events.csv";

/// Returns the name of a file with all maps of a frame: "sea_0007.exr", or with a pattern
/// "wave.0007.exr".
std::string packed_name(const MapOptions& options, int frame);

/// Returns "exr" or "png" depending on the value type of the map, or the extension of the format.
const char* extension_of(MapKind map, const MapOptions& options);

/// Returns true for names that image_name() and packed_name() can return, with any options, without
/// a pattern or with this one.
bool is_image_name(std::string_view name, const std::optional<NamePattern>& pattern);

/// Returns the name of a flipbook: "flipbook_foam.png" for the coarsest cascade,
/// "flipbook_foam_c1.png" for the next one.
std::string flipbook_name(const MapOptions& options, MapKind map, int cascade);
inline constexpr const char* flipbook_json_name = "flipbook.json";

/// Returns true for names that flipbook_name() can return with any options, and for
/// flipbook_json_name.
bool is_flipbook_name(std::string_view name);

/// Returns true for names that mesh_name() can return, without a pattern or with this one, and for
/// the meshes of all frames.
bool is_mesh_name(std::string_view name, const std::optional<NamePattern>& pattern);

/// Returns true for every name that an export can create: images, meshes, flipbooks, records,
/// journals, locks, and their temporary files.
bool is_export_name(std::string_view name, const std::optional<NamePattern>& pattern);

/// Returns true for the temporary file of such a name, which a killed export can leave behind.
bool is_export_part(std::string_view name, const std::optional<NamePattern>& pattern);

}  // namespace pelagic::tools
