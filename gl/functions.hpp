// Table of OpenGL ES 3.0 functions, loaded at run time. A program that links Pelagic therefore
// starts on a machine without OpenGL. An application with its own loader passes that loader.
#pragma once

#include <GLES3/gl3.h>
// gl2ext.h declares the extensions' types.
#include <GLES2/gl2ext.h>

#include <string_view>

namespace pelagic::gl {

/// Lists the functions that the front end calls.
// clang-format off
#define PELAGIC_GL_FUNCTIONS(X)                                                                                 \
    X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindBufferBase) X(BindBufferRange) X(BindFramebuffer)      \
    X(BindRenderbuffer) X(BindSampler) X(BindTexture) X(BindVertexArray) X(BlendColor)                          \
    X(BlendEquationSeparate) X(BlendFuncSeparate) X(BlitFramebuffer) X(BufferData)                              \
    X(BufferSubData) X(CheckFramebufferStatus) X(Clear) X(ClearColor) X(ClearDepthf) X(ClientWaitSync)          \
    X(ColorMask) X(CompileShader) X(CreateProgram) X(CreateShader) X(DeleteBuffers) X(DeleteFramebuffers)       \
    X(DeleteProgram) X(DeleteRenderbuffers) X(DeleteSamplers) X(DeleteShader) X(DeleteSync)                     \
    X(DeleteTextures) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) X(DepthRangef) X(Disable)                 \
    X(DrawArrays) X(DrawArraysInstanced) X(DrawElementsInstanced) X(Enable) X(EnableVertexAttribArray)          \
    X(FenceSync) X(Finish)                                                                                      \
    X(FramebufferRenderbuffer) X(FramebufferTexture2D) X(GenBuffers) X(GenFramebuffers) X(GenRenderbuffers)     \
    X(GenSamplers) X(GenTextures) X(GenVertexArrays) X(GenerateMipmap) X(GetBooleanv) X(GetError)               \
    X(GetFloatv) X(GetInteger64i_v) X(GetIntegeri_v) X(GetIntegerv) X(GetProgramInfoLog) X(GetProgramiv)        \
    X(GetShaderInfoLog) X(GetShaderiv) X(GetString) X(GetStringi) X(GetUniformBlockIndex)                       \
    X(GetUniformLocation) X(IsEnabled) X(LinkProgram) X(PixelStorei) X(PolygonOffset)                           \
    X(ReadPixels) X(RenderbufferStorageMultisample) X(Scissor) X(ShaderSource) X(TexParameteri)                 \
    X(TexStorage2D) X(TexStorage3D) X(TexSubImage2D) X(TexSubImage3D) X(Uniform1f) X(Uniform1i) X(Uniform4f)    \
    X(UniformBlockBinding) X(UseProgram) X(VertexAttribDivisor) X(VertexAttribIPointer)                         \
    X(VertexAttribPointer) X(Viewport)
// clang-format on

/// Returns a function's address by its full name ("glClear"), for example eglGetProcAddress or
/// SDL_GL_GetProcAddress.
using GetProcAddress = void* (*)(const char* name);

struct Functions {
#define PELAGIC_GL_POINTER(name) decltype(&gl##name) name = nullptr;
    PELAGIC_GL_FUNCTIONS(PELAGIC_GL_POINTER)
#undef PELAGIC_GL_POINTER

    // Null in WebGL.
    decltype(&glMapBufferRange) MapBufferRange = nullptr;
    decltype(&glUnmapBuffer) UnmapBuffer = nullptr;

    // Extensions. Null if the driver does not support them.
    PFNGLDEBUGMESSAGECALLBACKKHRPROC DebugMessageCallbackKHR = nullptr;
    PFNGLGETGRAPHICSRESETSTATUSEXTPROC GetGraphicsResetStatus = nullptr;
    PFNGLFRAMEBUFFERTEXTUREMULTIVIEWOVRPROC FramebufferTextureMultiviewOVR = nullptr;

    bool renders_to_half_floats = false;  ///< required to generate the displacement's mips
    bool renders_to_floats = false;       ///< required by PixelKind::data
    /// True if buffers can be mapped and fences can be waited for. False in WebGL, which
    /// synchronises buffer transfers itself.
    bool maps_buffers = true;
    /// False in WebGL, where the largest index always restarts a primitive.
    bool can_disable_primitive_restart = true;
};

/// Loads the table for the context that is current on this thread.
/// \throws GlError if no context is current, the context is older than ES 3.0, or a function is
/// missing
Functions load_functions(GetProcAddress get);

/// Returns whether the context has an extension. \pre the context is current
bool has_extension(const Functions& gl, std::string_view name);

/// Checks for a reset, if the driver supports the query.
/// \throws ContextLost if the driver has reset the context
void check_context(const Functions& gl);

}  // namespace pelagic::gl
