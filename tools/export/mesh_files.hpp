// The mesh files of a frame.
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

/// The frame's square of sea in the axes and the unit that were asked for, with texture coordinates for images of these rows.
Mesh exported_mesh(const Frame& frame, const ExportOptions& options);

/// All of a frame, in the order in which records list them, behind its images.
std::vector<MeshFile> mesh_files(const ExportOptions& options, int frame);

Bytes encode_mesh_file(MeshFormat format, const Mesh& mesh);

}  // namespace pelagic::tools
