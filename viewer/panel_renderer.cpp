#include "pelagic/viewer/panel_renderer.hpp"

#include <imgui.h>

#include <cstddef>

#include "pelagic/gl/errors.hpp"

namespace pelagic::viewer {
namespace {

static_assert(sizeof(ImDrawIdx) == 2);

template <class Function>
Function loaded(gl::GetProcAddress get, const char* name) {
    auto function = reinterpret_cast<Function>(get(name));
    if (!function) throw gl::GlError(std::string("the OpenGL ES driver has no ") + name);
    return function;
}

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

}  // namespace

PanelRenderer::PanelRenderer(const gl::Functions& gl, gl::GetProcAddress get)
    : gl_(gl),
      blend_(loaded<PFNGLBLENDFUNCSEPARATEPROC>(get, "glBlendFuncSeparate")),
      draw_elements_(loaded<PFNGLDRAWELEMENTSPROC>(get, "glDrawElements")),
      uniform2_(loaded<PFNGLUNIFORM2FPROC>(get, "glUniform2f")),
      program_(gl, "panel.vert.glsl", "panel.frag.glsl"),
      font_(gl),
      array_(gl),
      vertices_(gl),
      indices_(gl) {
    unsigned char* pixels = nullptr;
    int width = 0, height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    gl.ActiveTexture(GL_TEXTURE0);
    gl.BindTexture(GL_TEXTURE_2D, font_.name());
    gl.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, width, height);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    gl.TexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.BindTexture(GL_TEXTURE_2D, 0);

    gl.BindVertexArray(array_.name());
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    constexpr GLsizei stride = sizeof(ImDrawVert);
    gl.VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, stride, offset(offsetof(ImDrawVert, pos)));
    gl.VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, stride, offset(offsetof(ImDrawVert, uv)));
    gl.VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(offsetof(ImDrawVert, col)));
    for (const GLuint attribute : {0u, 1u, 2u}) gl.EnableVertexAttribArray(attribute);
    gl.BindVertexArray(0);
}

void PanelRenderer::draw(const ImDrawData& data) {
    const auto width = static_cast<GLsizei>(data.DisplaySize.x * data.FramebufferScale.x);
    const auto height = static_cast<GLsizei>(data.DisplaySize.y * data.FramebufferScale.y);
    if (width <= 0 || height <= 0) return;
    gl_.Viewport(0, 0, width, height);
    gl_.Enable(GL_BLEND);
    blend_(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.UseProgram(program_.name());
    gl_.Uniform1i(program_.uniform("font"), 0);
    uniform2_(program_.uniform("window_size"), data.DisplaySize.x, data.DisplaySize.y);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, font_.name());
    gl_.BindSampler(0, 0);
    gl_.BindVertexArray(array_.name());
    gl_.BindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    for (int l = 0; l < data.CmdListsCount; ++l) {
        const ImDrawList& list = *data.CmdLists[l];
        gl_.BufferData(GL_ARRAY_BUFFER, list.VtxBuffer.size_in_bytes(), list.VtxBuffer.Data, GL_STREAM_DRAW);
        gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER, list.IdxBuffer.size_in_bytes(), list.IdxBuffer.Data, GL_STREAM_DRAW);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const ImVec4 clip = command.ClipRect;
            const auto pixels = [&](float units, float scale) { return static_cast<GLint>(units * scale); };
            const GLint left = pixels(clip.x, data.FramebufferScale.x),
                        right = pixels(clip.z, data.FramebufferScale.x);
            const GLint top = pixels(clip.y, data.FramebufferScale.y),
                        bottom = pixels(clip.w, data.FramebufferScale.y);
            if (right <= left || bottom <= top) continue;
            gl_.Scissor(left, height - bottom, right - left, bottom - top);
            draw_elements_(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount), GL_UNSIGNED_SHORT,
                           offset(command.IdxOffset * sizeof(ImDrawIdx)));
        }
    }
    gl_.BindVertexArray(0);
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Disable(GL_BLEND);
}

}  // namespace pelagic::viewer
