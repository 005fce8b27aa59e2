// GL buffers of the patch mesh, its wireframe, the skirt mesh and the instances of a draw list.
#pragma once

#include <array>
#include <cstddef>

#include "pelagic/gl/objects.hpp"
#include "pelagic/quadtree/draw_list.hpp"
#include "pelagic/quadtree/patch_mesh.hpp"

namespace pelagic::gl {

class PatchBuffers {
   public:
    PatchBuffers(const Functions& gl, int vertices);

    /// Uploads the instances of a list and returns their size in bytes. Buffers rotate, so the call
    /// does not wait for the GPU.
    std::size_t upload(const DrawList& list);

    struct Counts {
        int calls = 0;
        std::uint64_t triangles = 0;
        double driver_ms = 0;  ///< time spent in GL draw calls
    };
    /// Draws the patches as triangles or, for the wireframe, as lines.
    /// \pre upload(list) has been called and the patch program is in use
    Counts draw_patches(const DrawList& list, bool as_lines);
    /// Draws the skirt.
    /// \pre upload(list) has been called and the skirt program is in use
    Counts draw_skirt(const DrawList& list);

   private:
    struct Lists {
        VertexArray patches, lines, skirt;
        Buffer instances;
        std::size_t capacity = 0, skirt_offset = 0;
    };
    void describe_patches(const Buffer& indices);

    const Functions& gl_;
    PatchMesh mesh_;
    std::array<PatchMesh::Range, 16> line_ranges_{};
    std::size_t skirt_indices_ = 0;
    Buffer vertices_, triangles_, lines_, skirt_;
    std::array<Lists, 3> ring_;
    std::size_t current_ = 0;
};

}  // namespace pelagic::gl
