// GL buffers of the patch mesh, its wireframe, the skirt mesh and the instances of a draw list.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "pelagic/gl/objects.hpp"
#include "pelagic/quadtree/draw_list.hpp"
#include "pelagic/quadtree/patch_mesh.hpp"

namespace pelagic::gl {

class PatchBuffers {
   public:
    /// \param vertices  V of the draw lists
    PatchBuffers(const Functions& gl, int vertices);
    int vertices() const { return patch_vertices_; }

    /// Uploads the instances of a draw list and returns their size in bytes. Buffers rotate, so the
    /// call does not wait for the GPU.
    std::size_t upload(std::span<const PatchInstance> patches, std::span<const SkirtInstance> skirt);

    struct Counts {
        int calls = 0;
        std::uint64_t triangles = 0;
        double driver_ms = 0;  ///< time spent in GL draw calls
    };
    /// Draws patches as triangles or, for the wireframe, as lines.
    /// \pre their instances have been uploaded and the patch program is in use
    Counts draw_patches(std::span<const DrawBatch> batches, bool as_lines);
    /// Draws the skirt.
    /// \pre its instances have been uploaded and the skirt program is in use
    Counts draw_skirt(std::span<const SkirtInstance> skirt);

   private:
    struct Lists {
        VertexArray patches, lines, skirt;
        Buffer instances;
        std::size_t capacity = 0, skirt_offset = 0;
    };
    void describe_patches(const Buffer& indices);

    const Functions& gl_;
    int patch_vertices_;
    PatchMesh mesh_;
    std::array<PatchMesh::Range, 16> line_ranges_{};
    std::size_t skirt_indices_ = 0;
    Buffer vertices_, triangles_, lines_, skirt_;
    std::array<Lists, 3> ring_;
    std::size_t current_ = 0;
};

}  // namespace pelagic::gl
