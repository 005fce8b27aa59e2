// A mesh as binary glTF 2.0 (Khronos, ISO/IEC 12113), alone or as an animation of morph targets. glTF is in metres with y up.
//
// Attributes: POSITION, NORMAL, TEXCOORD_0 and, with foam, COLOR_0, a grey by which viewers multiply the base colour, so that foam is
// white and water dark, and _FOAM, the same as a float. Squares become two triangles.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "pelagic/tools/files/byte_order.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// Frames of one mesh, at equal distances in time. The first is the mesh itself; each other one is a morph target, which holds how far
/// its positions, normals and colours are from the first's. Their weights are animated so that frame k is shown exactly at k / fps,
/// and blended between two frames.
class GlbFile {
   public:
    /// WebGL 2 has 256 layers of a texture for certain, and three.js keeps a target in each.
    static constexpr std::size_t max_frames = 256;

    /// \param frames  how many there will be, for memory
    explicit GlbFile(const Mesh& first, std::size_t frames = 1);

    /// The next frame, a vertex for each of the first's and foam where that has it (asserted).
    void add(const Mesh& mesh);

    /// The file, without an animation if it has one frame.
    /// \param closes  whether the first frame follows after the last one
    Bytes finish(double fps, bool closes);

    /// How large a buffer so many frames with foam take. The JSON before it takes some kilobytes.
    static std::size_t buffer_bytes(std::size_t vertices, std::size_t triangles, std::size_t frames);

   private:
    enum class Bounds { none, min_and_max };

    /// These add an accessor and its part of the buffer, and return its number.
    std::size_t add_floats(std::span<const float> numbers, std::size_t width, Bounds bounds);
    std::size_t add_triangles();
    template <class Byte>
    std::size_t add_greys(std::span<const Byte> greys);
    std::size_t add_accessor(std::size_t begin, std::size_t count, const char* type, int component);
    nlohmann::ordered_json animation(double fps, bool closes);

    Mesh first_;
    Bytes buffer_;
    nlohmann::ordered_json accessors_, views_, attributes_, targets_ = nlohmann::ordered_json::array();
};

}  // namespace pelagic::tools
