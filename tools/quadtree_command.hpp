// `pelagic quadtree`: which patches of sea a view draws, as figures, a mesh and a plan.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/quadtree/quadtree_options.hpp"
#include "pelagic/tools/options/camera_options.hpp"
#include "pelagic/tools/options/compute_options.hpp"
#include "pelagic/tools/options/sea_options.hpp"

namespace pelagic::tools {

/// --size and --quality, which `render` has too.
class QuadtreeFlags {
   public:
    /// \param size_option  the name of the option that takes S
    void add_to(CLI::App& app, const std::string& size_option);
    QuadtreeOptions resolve() const;  ///< throws InputError

   private:
    std::string size_option_;
    std::optional<std::string> size_, quality_;
};

class QuadtreeCommandFlags {
   public:
    void add_to(CLI::App& app);
    /// Prints the figures and writes the files that options name. Throws InputError and FileError.
    void run() const;

   private:
    SeaOptions sea_;
    ComputeFlags compute_;
    CameraFlags camera_;
    QuadtreeFlags quadtree_;
    std::optional<std::string> time_, stereo_, obj_, ply_, gltf_, json_, svg_;
    bool all_ = false, foam_ = false;
};

}  // namespace pelagic::tools
