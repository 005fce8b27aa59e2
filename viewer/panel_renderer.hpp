// Draws Dear ImGui's triangles in OpenGL ES 3.0. Debian's library holds the backend for desktop GL only.
#pragma once

#include "pelagic/gl/objects.hpp"
#include "pelagic/gl/program.hpp"

struct ImDrawData;

namespace pelagic::viewer {

class PanelRenderer {
   public:
    /// Uploads the font of the current ImGui context. Throws gl::GlError.
    PanelRenderer(const gl::Functions& gl, gl::GetProcAddress get);

    /// Over what the bound framebuffer holds. Leaves blending, depth test, culling and scissor switched off.
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
