// Saves and restores the GL state that the front end changes, and the state that affects its
// drawing. The constructor saves the application's state and sets OpenGL's defaults. The destructor
// restores the saved state. In WebGL, an object that the page's own script bound has no name in
// this module; its binding is restored as 0.
#pragma once

#include <array>
#include <span>

#include "pelagic/gl/functions.hpp"

namespace pelagic::gl {

/// Number of texture units that the sea's shaders use, from unit 0.
inline constexpr int texture_units = 17;

/// Saves GL state on construction and restores it on destruction, except for framebuffer bindings
/// (GlTargetsGuard). \pre the context is current during both
class GlStateGuard {
   public:
    explicit GlStateGuard(const Functions& gl);
    ~GlStateGuard();
    GlStateGuard(const GlStateGuard&) = delete;
    GlStateGuard& operator=(const GlStateGuard&) = delete;

   private:
    /// Capabilities that the constructor disables. The last one exists only if
    /// Functions::can_disable_primitive_restart.
    static constexpr std::array<GLenum, 10> switches = {GL_DEPTH_TEST,
                                                        GL_CULL_FACE,
                                                        GL_BLEND,
                                                        GL_STENCIL_TEST,
                                                        GL_SCISSOR_TEST,
                                                        GL_POLYGON_OFFSET_FILL,
                                                        GL_SAMPLE_ALPHA_TO_COVERAGE,
                                                        GL_SAMPLE_COVERAGE,
                                                        GL_RASTERIZER_DISCARD,
                                                        GL_PRIMITIVE_RESTART_FIXED_INDEX};
    /// Pixel-unpack parameters. The constructor sets the alignment to 4 and the others to 0.
    static constexpr std::array<GLenum, 6> unpacking = {GL_UNPACK_ALIGNMENT,    GL_UNPACK_ROW_LENGTH,
                                                        GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS,
                                                        GL_UNPACK_SKIP_ROWS,    GL_UNPACK_SKIP_IMAGES};
    std::span<const GLenum> supported_switches() const {
        return {switches.data(), switches.size() - (gl_.can_disable_primitive_restart ? 0 : 1)};
    }

    struct Unit {
        GLint flat = 0, array = 0, cube = 0, sampler = 0;
    };

    const Functions& gl_;
    GLint program_ = 0, vertex_array_ = 0, array_buffer_ = 0, unit_ = 0, depth_func_ = 0;
    GLint uniform_buffer_ = 0, first_uniform_buffer_ = 0, unpack_buffer_ = 0;
    GLint64 first_uniform_start_ = 0, first_uniform_size_ = 0;
    std::array<GLint, 4> viewport_{};
    GLfloat offset_factor_ = 0, offset_units_ = 0;
    std::array<GLfloat, 2> depth_range_{};
    GLboolean depth_mask_ = GL_TRUE;
    std::array<GLboolean, 4> colour_mask_{};
    std::array<GLboolean, switches.size()> switched_{};
    std::array<GLint, unpacking.size()> unpacking_{};
    std::array<Unit, texture_units> units_;
};

/// Saves and restores the framebuffer bindings and the pixel-pack state.
/// \pre a GlStateGuard exists in an enclosing scope
class GlTargetsGuard {
   public:
    explicit GlTargetsGuard(const Functions& gl);
    ~GlTargetsGuard();
    GlTargetsGuard(const GlTargetsGuard&) = delete;
    GlTargetsGuard& operator=(const GlTargetsGuard&) = delete;
    /// Binds the application's draw framebuffer again.
    void bind_drawn() const { gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(drawn_)); }

   private:
    static constexpr std::array<GLenum, 4> packing = {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS,
                                                      GL_PACK_SKIP_ROWS};
    const Functions& gl_;
    GLint drawn_ = 0, read_ = 0, pack_buffer_ = 0;
    std::array<GLint, packing.size()> packing_{};
};

}  // namespace pelagic::gl
