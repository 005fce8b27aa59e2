#include "pelagic/gl/gl_state_guard.hpp"

namespace pelagic::gl {

GlStateGuard::GlStateGuard(const Functions& gl) : gl_(gl) {
    gl.GetIntegerv(GL_CURRENT_PROGRAM, &program_);
    gl.GetIntegerv(GL_VERTEX_ARRAY_BINDING, &vertex_array_);
    gl.GetIntegerv(GL_ARRAY_BUFFER_BINDING, &array_buffer_);
    gl.GetIntegerv(GL_UNIFORM_BUFFER_BINDING, &uniform_buffer_);
    gl.GetIntegeri_v(GL_UNIFORM_BUFFER_BINDING, 0, &first_uniform_buffer_);
    gl.GetInteger64i_v(GL_UNIFORM_BUFFER_START, 0, &first_uniform_start_);
    gl.GetInteger64i_v(GL_UNIFORM_BUFFER_SIZE, 0, &first_uniform_size_);
    gl.GetIntegerv(GL_VIEWPORT, viewport_.data());
    gl.GetIntegerv(GL_DEPTH_FUNC, &depth_func_);
    gl.GetFloatv(GL_DEPTH_RANGE, depth_range_.data());
    gl.GetBooleanv(GL_DEPTH_WRITEMASK, &depth_mask_);
    gl.GetBooleanv(GL_COLOR_WRITEMASK, colour_mask_.data());
    gl.GetFloatv(GL_POLYGON_OFFSET_FACTOR, &offset_factor_);
    gl.GetFloatv(GL_POLYGON_OFFSET_UNITS, &offset_units_);
    gl.DepthFunc(GL_LESS);
    gl.DepthRangef(0, 1);
    gl.DepthMask(GL_TRUE);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (std::size_t i = 0; i < supported_switches().size(); ++i) {
        switched_[i] = gl.IsEnabled(switches[i]);
        gl.Disable(switches[i]);
    }

    gl.GetIntegerv(GL_PIXEL_UNPACK_BUFFER_BINDING, &unpack_buffer_);
    gl.BindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
    for (std::size_t i = 0; i < unpacking.size(); ++i) {
        gl.GetIntegerv(unpacking[i], &unpacking_[i]);
        gl.PixelStorei(unpacking[i], unpacking[i] == GL_UNPACK_ALIGNMENT ? 4 : 0);
    }
    gl.GetIntegerv(GL_ACTIVE_TEXTURE, &unit_);
    for (std::size_t i = 0; i < units_.size(); ++i) {
        gl.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        gl.GetIntegerv(GL_TEXTURE_BINDING_2D, &units_[i].flat);
        gl.GetIntegerv(GL_TEXTURE_BINDING_2D_ARRAY, &units_[i].array);
        gl.GetIntegerv(GL_TEXTURE_BINDING_CUBE_MAP, &units_[i].cube);
        gl.GetIntegerv(GL_SAMPLER_BINDING, &units_[i].sampler);
        // A bound sampler object of the application would override the filtering of the sea's
        // textures.
        gl.BindSampler(static_cast<GLuint>(i), 0);
    }
    gl.ActiveTexture(GL_TEXTURE0);
    // Binding an index buffer changes the bound vertex array; unbind the application's array.
    gl.BindVertexArray(0);
}

GlStateGuard::~GlStateGuard() {
    for (std::size_t i = 0; i < units_.size(); ++i) {
        gl_.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
        gl_.BindTexture(GL_TEXTURE_2D, static_cast<GLuint>(units_[i].flat));
        gl_.BindTexture(GL_TEXTURE_2D_ARRAY, static_cast<GLuint>(units_[i].array));
        gl_.BindTexture(GL_TEXTURE_CUBE_MAP, static_cast<GLuint>(units_[i].cube));
        gl_.BindSampler(static_cast<GLuint>(i), static_cast<GLuint>(units_[i].sampler));
    }
    gl_.ActiveTexture(static_cast<GLenum>(unit_));
    for (std::size_t i = 0; i < unpacking.size(); ++i) gl_.PixelStorei(unpacking[i], unpacking_[i]);
    gl_.BindBuffer(GL_PIXEL_UNPACK_BUFFER, static_cast<GLuint>(unpack_buffer_));

    for (std::size_t i = 0; i < supported_switches().size(); ++i) {
        if (switched_[i])
            gl_.Enable(switches[i]);
        else
            gl_.Disable(switches[i]);
    }
    gl_.PolygonOffset(offset_factor_, offset_units_);
    gl_.ColorMask(colour_mask_[0], colour_mask_[1], colour_mask_[2], colour_mask_[3]);
    gl_.DepthMask(depth_mask_);
    gl_.DepthRangef(depth_range_[0], depth_range_[1]);
    gl_.DepthFunc(static_cast<GLenum>(depth_func_));
    gl_.Viewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);

    // A size of 0 means that the whole buffer was bound.
    if (first_uniform_size_ == 0)
        gl_.BindBufferBase(GL_UNIFORM_BUFFER, 0, static_cast<GLuint>(first_uniform_buffer_));
    else
        gl_.BindBufferRange(GL_UNIFORM_BUFFER, 0, static_cast<GLuint>(first_uniform_buffer_),
                            static_cast<GLintptr>(first_uniform_start_),
                            static_cast<GLsizeiptr>(first_uniform_size_));
    gl_.BindBuffer(GL_UNIFORM_BUFFER, static_cast<GLuint>(uniform_buffer_));
    gl_.BindVertexArray(static_cast<GLuint>(vertex_array_));
    gl_.BindBuffer(GL_ARRAY_BUFFER, static_cast<GLuint>(array_buffer_));
    gl_.UseProgram(static_cast<GLuint>(program_));
}

GlTargetsGuard::GlTargetsGuard(const Functions& gl) : gl_(gl) {
    gl.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &drawn_);
    gl.GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &read_);
    gl.GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &pack_buffer_);
    gl.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (std::size_t i = 0; i < packing.size(); ++i) {
        gl.GetIntegerv(packing[i], &packing_[i]);
        gl.PixelStorei(packing[i], packing[i] == GL_PACK_ALIGNMENT ? 4 : 0);
    }
}

GlTargetsGuard::~GlTargetsGuard() {
    for (std::size_t i = 0; i < packing.size(); ++i) gl_.PixelStorei(packing[i], packing_[i]);
    gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(pack_buffer_));
    gl_.BindFramebuffer(GL_DRAW_FRAMEBUFFER, static_cast<GLuint>(drawn_));
    gl_.BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(read_));
}

}  // namespace pelagic::gl
