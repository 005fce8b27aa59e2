// --mesh: which meshes an export has, and of which square of sea.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/tools/export/frame_times.hpp"
#include "pelagic/tools/meshes/sea_mesh.hpp"
#include "pelagic/tools/options/sea_options.hpp"

namespace pelagic::tools {

enum class MeshFormat {
    obj,
    ply,
    gltf,
    gltf_animation,  ///< all frames in one file
    mdd,             ///< likewise
};

std::string_view name_of(MeshFormat format);

struct MeshOptions {
    std::vector<MeshFormat> formats;  ///< each once; empty: no meshes
    SeaPatch patch;

    bool any() const { return !formats.empty(); }
    bool has(MeshFormat format) const;
};

/// Declares and checks --mesh, --mesh-size and --mesh-steps.
class MeshFlags {
   public:
    void add_to(CLI::App& app);
    MeshOptions resolve(const ResolvedSea& sea, const FrameTimes& times) const;  ///< throws InputError

   private:
    std::optional<std::string> formats_, size_, steps_;
};

}  // namespace pelagic::tools
