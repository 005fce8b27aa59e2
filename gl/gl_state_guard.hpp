// All GL state that the front end changes, or that an application may have left in its way. A scope begins with OpenGL's own
// defaults and ends with what the application had. This is the only place that knows either. In WebGL "what the application had" is nothing
// where a page's own script bound an object, which has no name here.
#pragma once

#include <array>
#include <span>

#include "pelagic/gl/functions.hpp"

namespace pelagic::gl {

/// Texture units that the sea's shaders use, from 0 on.
inline constexpr int texture_units = 16;

class GlStateGuard {
   public:
    explicit GlStateGuard(const Functions& gl);
    ~GlStateGuard();
    GlStateGuard(const GlStateGuard&) = delete;
    GlStateGuard& operator=(const GlStateGuard&) = delete;

   private:
    /// Off at the start of a scope, where there is such a switch: the last one only Functions::can_disable_primitive_restart.
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
    /// 0 at the start of a scope, and the alignment 4.
    static constexpr std::array<GLenum, 6> unpacking = {GL_UNPACK_ALIGNMENT,    GL_UNPACK_ROW_LENGTH,
                                                        GL_UNPACK_IMAGE_HEIGHT, GL_UNPACK_SKIP_PIXELS,
                                                        GL_UNPACK_SKIP_ROWS,    GL_UNPACK_SKIP_IMAGES};
    std::span<const GLenum> switches_there_are() const {
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

/// The framebuffers that the display pass changes, and where pixels are read to. \pre a GlStateGuard stands around it
class GlTargetsGuard {
   public:
    explicit GlTargetsGuard(const Functions& gl);
    ~GlTargetsGuard();
    GlTargetsGuard(const GlTargetsGuard&) = delete;
    GlTargetsGuard& operator=(const GlTargetsGuard&) = delete;
    /// Draws go there again, where the application's did.
    void bind_drawn() const { gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(drawn_)); }

   private:
    static constexpr std::array<GLenum, 4> packing = {GL_PACK_ALIGNMENT, GL_PACK_ROW_LENGTH, GL_PACK_SKIP_PIXELS,
                                                      GL_PACK_SKIP_ROWS};
    const Functions& gl_;
    GLint drawn_ = 0, read_ = 0, pack_buffer_ = 0;
    std::array<GLint, packing.size()> packing_{};
};

}  // namespace pelagic::gl
