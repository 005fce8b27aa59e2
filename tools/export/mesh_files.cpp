#include "pelagic/tools/export/mesh_files.hpp"

#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/maps/axes.hpp"
#include "pelagic/tools/meshes/gltf_file.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

Mesh exported_mesh(const Frame& frame, const ExportOptions& options) {
    Mesh mesh = mesh_of(frame, options.meshes.patch);
    const auto scale = static_cast<double>(units_per_metre(options.maps.unit));
    for (glm::dvec3& position : mesh.positions) position = in_axes(position, options.maps.up_axis) * scale;
    for (glm::vec3& normal : mesh.normals) normal = in_axes(normal, options.maps.up_axis);
    if (options.maps.rows == FirstRow::bottom)
        for (glm::vec2& uv : mesh.texture_coordinates) uv.y = 1 - uv.y;
    return mesh;
}

std::vector<MeshFile> mesh_files(const ExportOptions& options, int frame) {
    std::vector<MeshFile> files;
    for (const auto& [format, extension] :
         {std::pair(MeshFormat::obj, "obj"), {MeshFormat::ply, "ply"}, {MeshFormat::gltf, "glb"}})
        if (options.meshes.has(format)) files.push_back({mesh_name(options.maps.names, frame, extension), format});
    return files;
}

Bytes encode_mesh_file(MeshFormat format, const Mesh& mesh) {
    if (format == MeshFormat::ply) return mesh_as_ply(mesh);
    if (format == MeshFormat::gltf) return GlbFile(mesh).finish(1, false);
    const std::string text = mesh_as_obj(mesh, ObjDigits::of_floats);
    return {text.begin(), text.end()};
}

OceanOptions ocean_options(const ExportOptions& options, const std::shared_ptr<ChromeTrace>& trace) {
    return {.executor = make_default_executor(options.compute.threads),
            .isa = options.compute.isa,
            .trace = trace,
            .velocities = options.maps.has(MapKind::velocity) ? Velocities::drawn : Velocities::none,
            .gradients = options.maps.has(MapKind::gradient) ? std::optional(true) : std::nullopt,
            .foam = options.has_foam()};
}

std::unique_ptr<EventPlayer> event_player(const ExportOptions& options, const OceanOptions& how) {
    return options.events ? std::make_unique<EventPlayer>(*options.events, how.executor, how.isa) : nullptr;
}

Frame exported_frame(const Frame& frame, EventPlayer* player) {
    Frame exported = frame;
    if (player) exported.dynamic_waves = player->at(frame.time_s);
    return exported;
}

}  // namespace pelagic::tools
