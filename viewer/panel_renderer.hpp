// Draws Dear ImGui's triangles with OpenGL ES 3.0. Debian's library contains the backend for
// desktop GL only.
#pragma once

#include "pelagic/gl/objects.hpp"
#include "pelagic/gl/program.hpp"

struct ImDrawData;

namespace pelagic::viewer {

class PanelRenderer {
   public:
    /// Uploads the font of the current ImGui context.
    /// \throws gl::GlError if the driver lacks a function or rejects a shader
    PanelRenderer(const gl::Functions& gl, gl::GetProcAddress get);

    /// Draws over the content of the bound framebuffer. Leaves blending, depth test, culling and
    /// scissor test disabled.
    void draw(const ImDrawData& data);

   private:
    const gl::Functions& gl_;
    PFNGLBLENDFUNCSEPARATEPROC blend_ = nullptr;
    PFNGLDRAWELEMENTSPROC draw_elements_ = nullptr;
    PFNGLUNIFORM2FPROC uniform2_ = nullptr;
    gl::Program program_;
    gl::Texture font_;
    gl::VertexArray array_;
    gl::Buffer vertices_, indices_;
};

}  // namespace pelagic::viewer
