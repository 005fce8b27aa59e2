// The mesh files of a frame.
#pragma once

#include <string>
#include <vector>

#include "pelagic/tools/byte_order.hpp"
#include "pelagic/tools/mesh_options.hpp"

namespace pelagic::tools {

struct MeshFile {
    std::string name;
    MeshFormat format;
};

/// All of a frame, in the order in which records list them, behind its images.
std::vector<MeshFile> mesh_files(const MeshOptions& options, int frame);

Bytes encode_mesh_file(MeshFormat format, const Mesh& mesh);

}  // namespace pelagic::tools
