// A shader over a whole image: what the display pass and the light meter are made of.
#pragma once

#include "pelagic/gl/program.hpp"
#include "pelagic/gl/render_target.hpp"

namespace pelagic::gl {

class ImagePass {
   public:
    /// Throws GlError. Leaves its program in use.
    ImagePass(const Functions& gl, std::string_view fragment_file);

    void use() const { gl_.UseProgram(program_.name()); }
    /// To be used first. The shader's `NAME` reads the image through that unit, `NAME_used` says which part.
    void read(const char* name, GLint unit, const TexturePart& image) const;
    void set(const char* name, float x, float y, float z, float w) const {
        gl_.Uniform4f(program_.uniform(name), x, y, z, w);
    }
    void set(const char* name, float value) const { gl_.Uniform1f(program_.uniform(name), value); }
    /// Over the viewport. \pre an empty vertex array is bound, tests are off
    void draw() const { gl_.DrawArrays(GL_TRIANGLES, 0, 3); }

   private:
    const Functions& gl_;
    Program program_;
};

/// A texture of half floats to draw into, filtered linearly.
struct RadianceTexture {
    RadianceTexture(const Functions& gl, int width, int height);

    Texture texture;
    Framebuffer framebuffer;
    int width, height;
};

}  // namespace pelagic::gl
