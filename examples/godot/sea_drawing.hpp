// The sea in the engine's own scene: patches of the quadtree as instances of meshes, and a frame's cascades as textures of a material.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "pelagic/examples/godot/engine.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic::godot {

class SeaDrawing {
   public:
    /// \param node      in the tree, of whose world and camera it draws
    /// \param material  its shader is addons/pelagic/sea.shader, or has its uniforms
    /// \param frame     all frames have as many cascades and texels
    SeaDrawing(Object* node, Rid material, const QuadtreeOptions& options, const Frame& frame);
    ~SeaDrawing();
    SeaDrawing(const SeaDrawing&) = delete;
    SeaDrawing& operator=(const SeaDrawing&) = delete;

    /// From the node's viewport's current camera; nothing without one.
    void draw(const Frame& frame);

   private:
    /// A mesh, its instances, and what stands in the scene for them.
    struct Batch {
        Rid mesh{}, multimesh{}, instance{};
        std::size_t room = 0;       ///< instances that the engine has memory for
        std::vector<float> floats;  ///< of the instances, as the engine takes them
    };

    Batch batch_of(std::span<const Vector3> vertices, std::span<const std::uint16_t> indices);
    void add_instance(Batch& batch, float x, float y, float z, std::array<float, 4> colour,
                      std::array<float, 4> custom);
    void show(Batch& batch, bool is_visible);
    void upload(const Frame& frame);
    void set(const char* parameter, const Value& value);
    void set_uniforms(const Frame& frame, const QuadtreeGrid& grid, glm::dvec3 viewer_m);

    Object *node_, *server_;
    Rid material_;
    Selection selection_;
    std::array<Batch, 16> patches_;  ///< by stitch configuration
    Batch skirt_;
    Rid displacement_, slopes_, moments_;
    Held image_;
};

}  // namespace pelagic::godot
