#include "pelagic/gl/kept_state.hpp"

namespace pelagic::gl {

KeptState::KeptState(const Functions& gl) : gl_(gl) {
    gl.GetIntegerv(GL_CURRENT_PROGRAM, &program_);
    gl.GetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
    gl.GetIntegerv(GL_ARRAY_BUFFER_BINDING, &array_buffer_);
    gl.GetIntegerv(GL_UNIFORM_BUFFER_BINDING, &uniform_buffer_);
    gl.GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 0, &indexed_uniform_buffer_);
    gl.GetIntegerv(GL_ACTIVE_TEXTURE, &unit_);
    gl.GetIntegerv(GL_DEPTH_FUNC, &depth_func_);
    gl.GetFloatv(GL_POLYGON_OFFSET_FACTOR, &offset_factor_);
    gl.GetFloatv(GL_POLYGON_OFFSET_UNITS, &offset_units_);
    gl.GetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
    gl.GetBooleanv(GL_COLOR_WRITEMASK, colour_mask_.data());
    for (std::size_t i = 0; i < switches.size(); ++i) switched_[i] = gl.IsEnabled(switches[i]);
    for (std::size_t i = 0; i < units_.size(); ++i) {
        gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        gl.GetIntegerv(GL_TEXTURE_BINDING_2D, &units_[i].flat);
        gl.GetIntegerv(GL_TEXTURE_BINDING_CUBE_MAP, &units_[i].cube);
        gl.GetIntegerv(GL_SAMPLER_BINDING, &units_[i].sampler);
        // A sampler of the host's would override how our textures are filtered.
        gl.BindSampler(static_cast<GLuint>(i), 0);
    }
}

KeptState::~KeptState() {
    for (std::size_t i = 0; i < units_.size(); ++i) {
        gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        gl_.BindTexture(GL_TEXTURE_2D, static_cast<GLuint>(units_[i].flat));
        gl_.BindTexture(GL_TEXTURE_CUBE_MAP, static_cast<GLuint>(units_[i].cube));
        gl_.BindSampler(static_cast<GLuint>(i), static_cast<GLuint>(units_[i].sampler));
    }
    gl_.ActiveTexture(static_cast<GLenum>(unit_));
    for (std::size_t i = 0; i < switches.size(); ++i) {
        if (switched_[i])
            gl_.Enable(switches[i]);
        else
            gl_.Disable(switches[i]);
    }
    gl_.ColorMask(colour_mask_[0], colour_mask_[1], colour_mask_[2], colour_mask_[3]);
    gl_.PolygonOffset(offset_factor_, offset_units_);
    gl_.DepthMask(depth_mask_);
    gl_.DepthFunc(static_cast<GLenum>(depth_func_));
    gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, static_cast<GLuint>(indexed_uniform_buffer_));
    gl_.BindBuffer(GL_UNIFORM_BUFFER, static_cast<GLuint>(uniform_buffer_));
    gl_.BindVertexArray(static_cast<GLuint>(vertex_array_));
    gl_.BindBuffer(GL_ARRAY_BUFFER, static_cast<GLuint>(array_buffer_));
    gl_.UseProgram(static_cast<GLuint>(program_));
}

}  // namespace pelagic::gl
