// The node PelagicMesh: draws a PelagicOcean around the camera, with sea.gdshader as its material_override.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pelagic/contrib/godot4/ocean.hpp"

namespace pelagic::godot4 {

class SeaMesh final : public Node {
   public:
    explicit SeaMesh(Object* self) : Node(self, "PelagicMesh"), ocean_(Value::path("..")) {}
    static NodeClass& description();
    void enter_tree() override;
    /// Moves the mesh to the camera and uploads the ocean's frame. Reports a reason for which it cannot once.
    void process(double seconds) override;

   private:
    /// Rings of square cells, each twice as large as those of the ring within, and a flat skirt. The arrays of Mesh.
    Value surface_arrays() const;
    int cells() const;
    double finest_m() const { return size_m_ / cells() / (1 << (rings - 1)); }
    void draw();
    void upload(const pelagic_ocean* ocean, const pelagic_frame& frame, const Value& material);
    /// Creates a texture array, or updates one of its layers.
    void upload_layer(Value& texture, std::vector<Value>& images, std::size_t layer, int side, bool has_mips,
                      int format, std::span<const std::uint8_t> bytes);

    static constexpr int rings = 6;
    Value ocean_, displacement_, slopes_, moments_, snapshots_;
    std::string quality_ = "medium";
    double size_m_ = 2048;
    bool has_mesh_ = false;
    std::uint64_t drawn_ = 0;              ///< number of the frame
    const void* drawn_ocean_ = nullptr;    ///< whose textures these are
    std::vector<std::uint64_t> versions_;  ///< of the images of foam
};

}  // namespace pelagic::godot4
