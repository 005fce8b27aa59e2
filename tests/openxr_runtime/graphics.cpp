#include "pelagic/tests/openxr_runtime/graphics.hpp"

namespace pelagic::openxr_stand_in {

/// Makes the application's context current on this thread; the destructor restores the previous
/// context.
class BorrowedContext {
   public:
    explicit BorrowedContext(const Graphics& graphics)
        : graphics_(graphics),
          display_(graphics.current_display_()),
          context_(graphics.current_context_()),
          draw_(graphics.current_surface_(EGL_DRAW)),
          read_(graphics.current_surface_(EGL_READ)) {
        const XrGraphicsBindingEGLMNDX& binding = graphics.binding_;
        is_current_ = context_ == binding.context ||
                      graphics.make_current_(binding.display, EGL_NO_SURFACE, EGL_NO_SURFACE, binding.context);
    }
    ~BorrowedContext() {
        const XrGraphicsBindingEGLMNDX& binding = graphics_.binding_;
        if (context_ == binding.context || !is_current_) return;
        graphics_.make_current_(context_ == EGL_NO_CONTEXT ? binding.display : display_, draw_, read_, context_);
    }
    BorrowedContext(const BorrowedContext&) = delete;
    BorrowedContext& operator=(const BorrowedContext&) = delete;
    bool is_current() const { return is_current_; }

   private:
    const Graphics& graphics_;
    EGLDisplay display_;
    EGLContext context_;
    EGLSurface draw_, read_;
    bool is_current_ = false;
};

bool Graphics::take(const XrGraphicsBindingEGLMNDX& binding) {
    if (!binding.getProcAddress || binding.context == EGL_NO_CONTEXT) return false;
    binding_ = binding;
    binding_.next = nullptr;
    const auto find = [&](const char* name, auto& function) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(binding.getProcAddress(name));
        return function != nullptr;
    };
    bool has_all = find("eglGetCurrentContext", current_context_) && find("eglGetCurrentDisplay", current_display_) &&
                   find("eglGetCurrentSurface", current_surface_) && find("eglMakeCurrent", make_current_);
#define PELAGIC_STAND_IN_FIND(name) has_all = has_all && find("gl" #name, name);
    PELAGIC_STAND_IN_GL(PELAGIC_STAND_IN_FIND)
#undef PELAGIC_STAND_IN_FIND
    return has_all && is_there();
}

bool Graphics::is_there() const { return BorrowedContext(*this).is_current(); }

std::vector<GLuint> Graphics::make_textures(int count, GLenum format, int width, int height, int layers) const {
    const BorrowedContext borrowed(*this);
    const GLenum kind = layers > 1 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_2D;
    GLint bound = 0;
    GetIntegerv(layers > 1 ? GL_TEXTURE_BINDING_2D_ARRAY : GL_TEXTURE_BINDING_2D, &bound);
    std::vector<GLuint> textures(static_cast<std::size_t>(count));
    GenTextures(count, textures.data());
    for (const GLuint texture : textures) {
        BindTexture(kind, texture);
        if (layers > 1)
            TexStorage3D(kind, 1, format, width, height, layers);
        else
            TexStorage2D(kind, 1, format, width, height);
    }
    BindTexture(kind, static_cast<GLuint>(bound));
    return textures;
}

void Graphics::delete_textures(const std::vector<GLuint>& textures) const {
    const BorrowedContext borrowed(*this);
    DeleteTextures(static_cast<GLsizei>(textures.size()), textures.data());
}

GLenum Graphics::error() const {
    const BorrowedContext borrowed(*this);
    return GetError();
}

std::vector<std::uint8_t> Graphics::read(GLuint texture, bool is_array, int layer, const XrRect2Di& part) const {
    const BorrowedContext borrowed(*this);
    GLint bound = 0, buffer = 0, alignment = 0;
    GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
    GetIntegerv(GL_PIXEL_PACK_BUFFER_BINDING, &buffer);
    GetIntegerv(GL_PACK_ALIGNMENT, &alignment);

    GLuint framebuffer = 0;
    GenFramebuffers(1, &framebuffer);
    BindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer);
    if (is_array)
        FramebufferTextureLayer(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, 0, layer);
    else
        FramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
    BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    PixelStorei(GL_PACK_ALIGNMENT, 4);
    const auto width = static_cast<std::size_t>(part.extent.width),
               height = static_cast<std::size_t>(part.extent.height);
    std::vector<std::uint8_t> rgba(4 * width * height), rgb;
    ReadPixels(part.offset.x, part.offset.y, part.extent.width, part.extent.height, GL_RGBA, GL_UNSIGNED_BYTE,
               rgba.data());

    PixelStorei(GL_PACK_ALIGNMENT, alignment);
    BindBuffer(GL_PIXEL_PACK_BUFFER, static_cast<GLuint>(buffer));
    BindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
    DeleteFramebuffers(1, &framebuffer);
    rgb.reserve(3 * width * height);
    for (std::size_t row = height; row-- > 0;)
        for (std::size_t i = row * width; i < (row + 1) * width; ++i)
            rgb.insert(rgb.end(), &rgba[4 * i], &rgba[4 * i] + 3);
    return rgb;
}

}  // namespace pelagic::openxr_stand_in
