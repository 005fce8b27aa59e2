#include "pelagic/gl/water/patch_buffers.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/quadtree/skirt.hpp"

namespace pelagic::gl {
namespace {

const void* offset_of(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

template <class Item>
Buffer make_buffer(const Functions& gl, GLenum target, const std::vector<Item>& items) {
    Buffer buffer(gl);
    gl.BindBuffer(target, buffer.name());
    gl.BufferData(target, static_cast<GLsizeiptr>(items.size() * sizeof(Item)), items.data(), GL_STATIC_DRAW);
    return buffer;
}

/// Returns the indices of each edge of a range's triangles once.
std::vector<std::uint16_t> edges_of(const PatchMesh& mesh, const PatchMesh::Range& range) {
    std::vector<std::uint32_t> edges;
    for (std::uint32_t i = range.first; i < range.first + range.count; i += 3)
        for (std::uint32_t side = 0; side < 3; ++side) {
            const std::uint32_t a = mesh.indices[i + side], b = mesh.indices[i + (side + 1) % 3];
            edges.push_back(std::min(a, b) << 16 | std::max(a, b));
        }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    std::vector<std::uint16_t> indices;
    for (const std::uint32_t edge : edges) {
        indices.push_back(static_cast<std::uint16_t>(edge >> 16));
        indices.push_back(static_cast<std::uint16_t>(edge & 0xffff));
    }
    return indices;
}

}  // namespace

PatchBuffers::PatchBuffers(const Functions& gl, int vertices) : gl_(gl), patch_vertices_(vertices), mesh_(vertices) {
    gl.BindVertexArray(0);  // index buffers are bound to the current vertex array
    vertices_ = make_buffer(gl, GL_ARRAY_BUFFER, mesh_.positions);
    triangles_ = make_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, mesh_.indices);
    const std::vector<std::uint16_t> skirt = SkirtMesh(vertices).indices;
    skirt_indices_ = skirt.size();
    skirt_ = make_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, skirt);
    std::vector<std::uint16_t> lines;
    for (std::size_t stitches = 0; stitches < line_ranges_.size(); ++stitches) {
        const std::vector<std::uint16_t> edges = edges_of(mesh_, mesh_.ranges[stitches]);
        line_ranges_[stitches] = {static_cast<std::uint32_t>(lines.size()), static_cast<std::uint32_t>(edges.size())};
        lines.insert(lines.end(), edges.begin(), edges.end());
    }
    lines_ = make_buffer(gl, GL_ELEMENT_ARRAY_BUFFER, lines);

    for (Lists& lists : ring_) {
        lists.instances = Buffer(gl);
        lists.patches = VertexArray(gl);
        lists.lines = VertexArray(gl);
        lists.skirt = VertexArray(gl);
        gl.BindVertexArray(lists.patches.name());
        describe_patches(triangles_);
        gl.BindVertexArray(lists.lines.name());
        describe_patches(lines_);
        gl.BindVertexArray(lists.skirt.name());
        gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, skirt_.name());
        for (const GLuint attribute : {1u, 2u}) {
            gl.EnableVertexAttribArray(attribute);
            gl.VertexAttribDivisor(attribute, 1);
        }
    }
    gl.BindVertexArray(0);
}

// Each draw call sets the pointers of the instance attributes, because ES 3.0 has no base instance.
void PatchBuffers::describe_patches(const Buffer& indices) {
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices.name());
    gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    gl_.VertexAttribIPointer(0, 2, GL_UNSIGNED_BYTE, sizeof(PatchMesh::Vertex), nullptr);
    gl_.EnableVertexAttribArray(0);
    for (const GLuint attribute : {1u, 2u, 3u, 4u}) {
        gl_.EnableVertexAttribArray(attribute);
        gl_.VertexAttribDivisor(attribute, 1);
    }
}

std::size_t PatchBuffers::upload(std::span<const PatchInstance> patches, std::span<const SkirtInstance> skirt) {
    current_ = (current_ + 1) % ring_.size();
    Lists& lists = ring_[current_];
    const std::size_t patch_bytes = patches.size_bytes(), skirt_bytes = skirt.size_bytes();
    gl_.BindBuffer(GL_ARRAY_BUFFER, lists.instances.name());
    lists.capacity = std::max(lists.capacity, 2 * (patch_bytes + skirt_bytes));
    // The buffer gets new storage on each upload. The driver keeps the old storage until its draws
    // are complete.
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(lists.capacity), nullptr, GL_STREAM_DRAW);
    gl_.BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(patch_bytes), patches.data());
    lists.skirt_offset = patch_bytes;
    gl_.BufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(patch_bytes), static_cast<GLsizeiptr>(skirt_bytes),
                      skirt.data());
    return patch_bytes + skirt_bytes;
}

PatchBuffers::Counts PatchBuffers::draw_patches(std::span<const DrawBatch> batches, bool as_lines) {
    const Lists& lists = ring_[current_];
    gl_.BindVertexArray(as_lines ? lists.lines.name() : lists.patches.name());
    gl_.BindBuffer(GL_ARRAY_BUFFER, lists.instances.name());
    constexpr GLsizei stride = sizeof(PatchInstance);
    Counts counts;
    for (const DrawBatch& batch : batches) {
        const std::size_t first = batch.first * sizeof(PatchInstance);
        gl_.VertexAttribIPointer(1, 2, GL_UNSIGNED_SHORT, stride,
                                 offset_of(first + offsetof(PatchInstance, corner_x)));
        gl_.VertexAttribIPointer(2, 2, GL_UNSIGNED_BYTE, stride, offset_of(first + offsetof(PatchInstance, level)));
        gl_.VertexAttribPointer(3, 1, GL_UNSIGNED_SHORT, GL_TRUE, stride,
                                offset_of(first + offsetof(PatchInstance, inner_weight)));
        gl_.VertexAttribPointer(4, 4, GL_UNSIGNED_SHORT, GL_TRUE, stride,
                                offset_of(first + offsetof(PatchInstance, edge_weights)));
        const PatchMesh::Range& range = as_lines ? line_ranges_[batch.stitches] : mesh_.ranges[batch.stitches];
        const Stopwatch driver;
        gl_.DrawElementsInstanced(as_lines ? GL_LINES : GL_TRIANGLES, static_cast<GLsizei>(range.count),
                                  GL_UNSIGNED_SHORT, offset_of(range.first * sizeof(std::uint16_t)),
                                  static_cast<GLsizei>(batch.count));
        counts.driver_ms += driver.milliseconds();
        ++counts.calls;
        counts.triangles += std::uint64_t{mesh_.ranges[batch.stitches].count / 3} * batch.count;
    }
    return counts;
}

PatchBuffers::Counts PatchBuffers::draw_skirt(std::span<const SkirtInstance> skirt) {
    if (skirt.empty()) return {};
    const Lists& lists = ring_[current_];
    gl_.BindVertexArray(lists.skirt.name());
    gl_.BindBuffer(GL_ARRAY_BUFFER, lists.instances.name());
    gl_.VertexAttribIPointer(1, 1, GL_UNSIGNED_SHORT, sizeof(SkirtInstance),
                             offset_of(lists.skirt_offset + offsetof(SkirtInstance, start)));
    gl_.VertexAttribIPointer(2, 2, GL_UNSIGNED_BYTE, sizeof(SkirtInstance),
                             offset_of(lists.skirt_offset + offsetof(SkirtInstance, level)));
    const Stopwatch driver;
    gl_.DrawElementsInstanced(GL_TRIANGLES, static_cast<GLsizei>(skirt_indices_), GL_UNSIGNED_SHORT, nullptr,
                              static_cast<GLsizei>(skirt.size()));
    return {1, std::uint64_t{skirt_indices_ / 3} * skirt.size(), driver.milliseconds()};
}

}  // namespace pelagic::gl
