// Owners of GL object names, which delete the GL object on destruction. The context must be current
// on construction and destruction. The function table must outlive the object.
#pragma once

#include <utility>

#include "pelagic/gl/functions.hpp"

namespace pelagic::gl {

template <auto Make, auto Delete>
class Object {
   public:
    Object() = default;
    /// Creates an object. \pre the context is current
    explicit Object(const Functions& gl) : gl_(&gl) { (gl.*Make)(1, &name_); }
    ~Object() { reset(); }
    Object(Object&& from) noexcept : gl_(from.gl_), name_(std::exchange(from.name_, 0)) {}
    Object& operator=(Object&& from) noexcept {
        std::swap(gl_, from.gl_);
        std::swap(name_, from.name_);
        return *this;
    }
    /// Returns the GL name, or 0 if there is no object.
    GLuint name() const { return name_; }
    /// Deletes the object, if there is one.
    void reset() {
        if (name_ != 0) (gl_->*Delete)(1, &name_);
        name_ = 0;
    }

   private:
    const Functions* gl_ = nullptr;
    GLuint name_ = 0;
};

using Texture = Object<&Functions::GenTextures, &Functions::DeleteTextures>;
using Buffer = Object<&Functions::GenBuffers, &Functions::DeleteBuffers>;
using VertexArray = Object<&Functions::GenVertexArrays, &Functions::DeleteVertexArrays>;
using Framebuffer = Object<&Functions::GenFramebuffers, &Functions::DeleteFramebuffers>;
using Renderbuffer = Object<&Functions::GenRenderbuffers, &Functions::DeleteRenderbuffers>;
using Sampler = Object<&Functions::GenSamplers, &Functions::DeleteSamplers>;

}  // namespace pelagic::gl
