// Binary glTF 2.0 files (Khronos, ISO/IEC 12113): a mesh, optionally animated by morph targets.
// glTF is in metres with y up.
//
// Attributes are POSITION, NORMAL, TEXCOORD_0 and, with foam, COLOR_0 and _FOAM. COLOR_0 is a grey
// by which viewers multiply the base colour, so that foam is white and water dark. _FOAM is the
// foam as a float. Squares are split into two triangles.
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "pelagic/tools/files/byte_order.hpp"
#include "pelagic/tools/meshes/mesh.hpp"

namespace pelagic::tools {

/// Frames of one mesh at equal time steps. The first frame is the mesh. Every other frame is a
/// morph target with the differences of positions, normals and colours to the first frame. The
/// animated weights show frame k exactly at k / fps and blend between frames.
class GlbFile {
   public:
    /// WebGL 2 guarantees 256 layers of a texture, and three.js stores one target per layer.
    static constexpr std::size_t max_frames = 256;

    /// \param frames  number of frames, for the reservation of memory
    explicit GlbFile(const Mesh& first, std::size_t frames = 1);

    /// Adds the next frame.
    /// \pre the frame has as many vertices and foam values as the first (asserted)
    void add(const Mesh& mesh);

    /// Returns the file. A file with one frame has no animation.
    /// \param closes  true if the first frame follows the last, so that the animation loops
    Bytes finish(double fps, bool closes);

    /// Returns the size of the binary buffer for frames with foam. The JSON chunk adds some
    /// kilobytes.
    static std::size_t buffer_bytes(std::size_t vertices, std::size_t triangles, std::size_t frames);

   private:
    enum class Bounds { none, min_and_max };

    /// The add functions append an accessor and its data to the buffer, and return the accessor's
    /// index.
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
