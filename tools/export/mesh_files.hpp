// Mesh files of a frame.
#pragma once

#include <string>
#include <vector>

#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/files/byte_order.hpp"

namespace pelagic::tools {

struct MeshFile {
    std::string name;
    MeshFormat format;
};

/// Returns the square of the sea in the axes and the unit of the options, with texture coordinates
/// that match the row order of the images.
Mesh exported_mesh(const Frame& frame, const ExportOptions& options);

/// Returns the mesh files of a frame, in the order of records, where they follow the images.
std::vector<MeshFile> mesh_files(const ExportOptions& options, int frame);

Bytes encode_mesh_file(MeshFormat format, const Mesh& mesh);

}  // namespace pelagic::tools
