// Rendering of the sea in the engine's scene: quadtree patches as mesh instances, cascades as
// textures of a material.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/contrib/godot3/engine.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic::godot {

class SeaDrawing {
   public:
    /// \param node      a node in the scene tree, which defines the world and the camera
    /// \param material  a material with addons/pelagic/sea.shader or a shader with its uniforms
    /// \param frame     any frame of the ocean; all frames are of this ocean
    SeaDrawing(Object* node, Rid material, const QuadtreeOptions& options, const Frame& frame);
    ~SeaDrawing();
    SeaDrawing(const SeaDrawing&) = delete;
    SeaDrawing& operator=(const SeaDrawing&) = delete;

    /// Draws for the current camera of the node's viewport. Draws nothing without a camera.
    void draw(const Frame& frame);

   private:
    /// A mesh, its instances, and their objects in the scene.
    struct Batch {
        Rid mesh{}, multimesh{}, instance{};
        std::size_t room = 0;       ///< capacity of the engine's buffer in instances
        std::vector<float> floats;  ///< instance data in the engine's layout
    };

    Batch batch_of(std::span<const Vector3> vertices, std::span<const std::uint16_t> indices);
    void add_instance(Batch& batch, float x, float y, float z, std::array<float, 4> colour,
                      std::array<float, 4> custom);
    void show(Batch& batch, bool is_visible);
    void upload(const Frame& frame);
    void upload_snapshots(const Frame& frame);
    void upload_dynamic_waves(const DynamicWavesView& waves);
    void upload_shore(const ShoreSurface& shore);
    /// Copies an image to a layer of a texture. The engine generates mips if the image has none.
    void upload_image(const Rid& texture, int layer, int columns, int rows, int format, bool has_mips,
                      std::span<const std::uint8_t> bytes);
    void set(const char* parameter, const Value& value);
    void set_uniforms(const Frame& frame, const QuadtreeGrid& grid, glm::dvec3 viewer_m);
    void place_dynamic_waves(const DynamicWavesView& waves, glm::dvec2 viewer);
    void place_shore(const ShoreSurface& shore, glm::dvec2 viewer);

    Object *node_, *server_;
    Rid material_;
    Selection selection_;
    std::array<Batch, 16> patches_;  ///< by stitch configuration
    Batch skirt_;
    /// A texture and the name of its uniform.
    struct Texture {
        const char* uniform;
        Rid rid;
    };
    std::vector<Texture> textures_;
    Rid displacement_{}, slopes_{}, moments_{};
    Rid snapshots_{};                               ///< without foam: no texture
    std::vector<std::uint64_t> snapshot_versions_;  ///< of the texture's layers
    Rid dynamic_waves_{};                           ///< height, slopes along x and z, foam
    Rid shore_weights_{}, shore_water_{};           ///< weights of the cascades; as dynamic_waves_
    std::vector<float> texels_;
    Held image_;
};

}  // namespace pelagic::godot
