// --mesh, --mesh-size and --mesh-steps: formats of meshes, and the square of the sea that they
// show.
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
    gltf_animation,  ///< all frames in one file, as morph targets
    mdd,             ///< all frames in one file, as a point cache
};

struct MeshOptions {
    std::vector<MeshFormat> formats;  ///< distinct; empty: no meshes
    SeaPatch patch;

    bool any() const { return !formats.empty(); }
    bool has(MeshFormat format) const;
};

/// Declares and checks --mesh, --mesh-size and --mesh-steps.
class MeshFlags {
   public:
    void add_to(CLI::App& app);
    /// throws InputError
    MeshOptions resolve(const ResolvedSea& sea, const FrameTimes& times) const;

   private:
    std::optional<std::string> formats_, size_, steps_;
};

}  // namespace pelagic::tools

// Names in options and in records.
namespace pelagic {

template <>
struct EnumNames<tools::MeshFormat> {
    static constexpr std::array<std::string_view, 5> all = {"obj", "ply", "gltf", "gltf-animation", "mdd"};
};

}  // namespace pelagic
