// The GL state that drawing changes, kept at the start of a scope and put back at its end.
#pragma once

#include <array>

#include "pelagic/gl/functions.hpp"

namespace pelagic::gl {

/// Texture units that the sea's shaders use, from 0 on.
inline constexpr int texture_units = 4;

class KeptState {
   public:
    explicit KeptState(const Functions& gl);
    ~KeptState();
    KeptState(const KeptState&) = delete;
    KeptState& operator=(const KeptState&) = delete;

   private:
    static constexpr std::array<GLenum, 7> switches = {GL_DEPTH_TEST,
                                                       GL_CULL_FACE,
                                                       GL_BLEND,
                                                       GL_STENCIL_TEST,
                                                       GL_SCISSOR_TEST,
                                                       GL_POLYGON_OFFSET_FILL,
                                                       GL_PRIMITIVE_RESTART_FIXED_INDEX};
    const Functions& gl_;
    GLint program_ = 0, vertex_array_ = 0, array_buffer_ = 0, unit_ = 0, depth_func_ = 0;
    GLint uniform_buffer_ = 0, indexed_uniform_buffer_ = 0;
    GLfloat offset_factor_ = 0, offset_units_ = 0;
    GLboolean depth_mask_ = GL_TRUE;
    std::array<GLboolean, 4> colour_mask_{};
    std::array<GLboolean, switches.size()> switched_{};
    struct Unit {
        GLint flat = 0, cube = 0, sampler = 0;
    };
    std::array<Unit, texture_units> units_;
};

}  // namespace pelagic::gl
