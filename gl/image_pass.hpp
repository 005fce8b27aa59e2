// Draws a fragment shader over a whole image. The display pass and the light meter use it.
#pragma once

#include "pelagic/gl/program.hpp"
#include "pelagic/gl/render_target.hpp"

namespace pelagic::gl {

class ImagePass {
   public:
    /// Compiles the program and leaves it in use. \throws GlError if the driver rejects the shader
    ImagePass(const Functions& gl, std::string_view fragment_file);

    void use() const { gl_.UseProgram(program_.name()); }
    /// Binds an image to a texture unit and sets two uniforms: the sampler `NAME`, and `NAME_used`,
    /// the used fraction of the texture and the size of a texel. \pre use() was called
    void read(const char* name, GLint unit, const TexturePart& image) const;
    void set(const char* name, float x, float y, float z, float w) const {
        gl_.Uniform4f(program_.uniform(name), x, y, z, w);
    }
    void set(const char* name, float value) const { gl_.Uniform1f(program_.uniform(name), value); }
    /// Draws over the viewport.
    /// \pre use() was called, an empty vertex array is bound, and depth and stencil tests are
    /// disabled
    void draw() const { gl_.DrawArrays(GL_TRIANGLES, 0, 3); }

   private:
    const Functions& gl_;
    Program program_;
};

/// A half-float RGBA texture with linear filtering, and a framebuffer to draw into it.
struct RadianceTexture {
    /// \throws GlError if the driver cannot render to half floats or is out of memory
    RadianceTexture(const Functions& gl, int width, int height);

    Texture texture;
    Framebuffer framebuffer;
    int width, height;
};

}  // namespace pelagic::gl
