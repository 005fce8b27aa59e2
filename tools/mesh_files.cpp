#include "pelagic/tools/mesh_files.hpp"

#include "pelagic/tools/export_names.hpp"
#include "pelagic/tools/gltf_file.hpp"
#include "pelagic/tools/obj_file.hpp"
#include "pelagic/tools/ply_file.hpp"

namespace pelagic::tools {

std::vector<MeshFile> mesh_files(const MeshOptions& options, int frame) {
    std::vector<MeshFile> files;
    for (const auto& [format, extension] :
         {std::pair(MeshFormat::obj, "obj"), {MeshFormat::ply, "ply"}, {MeshFormat::gltf, "glb"}})
        if (options.has(format)) files.push_back({mesh_name(frame, extension), format});
    return files;
}

Bytes encode_mesh_file(MeshFormat format, const Mesh& mesh) {
    if (format == MeshFormat::ply) return mesh_as_ply(mesh);
    if (format == MeshFormat::gltf) return GlbFile(mesh).finish(1, false);
    const std::string text = mesh_as_obj(mesh, ObjDigits::of_floats);
    return {text.begin(), text.end()};
}

}  // namespace pelagic::tools
