// OpenGL ES 3.0 as a table of functions, loaded at run time: a program that links Pelagic starts on a machine without
// any GL, and an application with a loader of its own passes that one.
#pragma once

#include <GLES3/gl3.h>
// gl2ext.h declares the extensions' types.
#include <GLES2/gl2ext.h>

#include <string_view>

namespace pelagic::gl {

/// What the front end calls, and nothing else.
// clang-format off
#define PELAGIC_GL_FUNCTIONS(X)                                                                                 \
    X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindBufferBase) X(BindBufferRange) X(BindFramebuffer)      \
    X(BindRenderbuffer) X(BindSampler) X(BindTexture) X(BindVertexArray) X(BlitFramebuffer) X(BufferData)       \
    X(BufferSubData) X(CheckFramebufferStatus) X(Clear) X(ClearColor) X(ClearDepthf) X(ClientWaitSync)          \
    X(ColorMask) X(CompileShader) X(CreateProgram) X(CreateShader) X(DeleteBuffers) X(DeleteFramebuffers)       \
    X(DeleteProgram) X(DeleteRenderbuffers) X(DeleteSamplers) X(DeleteShader) X(DeleteSync)                     \
    X(DeleteTextures) X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) X(DepthRangef) X(Disable)                 \
    X(DrawArrays) X(DrawArraysInstanced) X(DrawElementsInstanced) X(Enable) X(EnableVertexAttribArray) X(FenceSync) X(Finish)          \
    X(FramebufferRenderbuffer) X(FramebufferTexture2D) X(GenBuffers) X(GenFramebuffers) X(GenRenderbuffers)     \
    X(GenSamplers) X(GenTextures) X(GenVertexArrays) X(GenerateMipmap) X(GetBooleanv) X(GetError)               \
    X(GetFloatv) X(GetInteger64i_v) X(GetIntegeri_v) X(GetIntegerv) X(GetProgramInfoLog) X(GetProgramiv)        \
    X(GetShaderInfoLog) X(GetShaderiv) X(GetString) X(GetStringi) X(GetUniformBlockIndex)                       \
    X(GetUniformLocation) X(IsEnabled) X(LinkProgram) X(PixelStorei) X(PolygonOffset)         \
    X(ReadPixels) X(RenderbufferStorageMultisample) X(Scissor) X(ShaderSource) X(TexParameteri)                 \
    X(TexStorage2D) X(TexStorage3D) X(TexSubImage2D) X(TexSubImage3D) X(Uniform1f) X(Uniform1i) X(Uniform4f)    \
    X(UniformBlockBinding) X(UseProgram) X(VertexAttribDivisor) X(VertexAttribIPointer)          \
    X(VertexAttribPointer) X(Viewport)
// clang-format on

/// Looks a function up by its whole name ("glClear"): eglGetProcAddress, SDL_GL_GetProcAddress, ...
using GetProcAddress = void* (*)(const char* name);

struct Functions {
#define PELAGIC_GL_POINTER(name) decltype(&gl##name) name = nullptr;
    PELAGIC_GL_FUNCTIONS(PELAGIC_GL_POINTER)
#undef PELAGIC_GL_POINTER

    // Null in WebGL.
    decltype(&glMapBufferRange) MapBufferRange = nullptr;
    decltype(&glUnmapBuffer) UnmapBuffer = nullptr;

    // Extensions, null where the driver has none.
    PFNGLDEBUGMESSAGECALLBACKKHRPROC DebugMessageCallbackKHR = nullptr;
    PFNGLGETGRAPHICSRESETSTATUSEXTPROC GetGraphicsResetStatus = nullptr;
    PFNGLFRAMEBUFFERTEXTUREMULTIVIEWOVRPROC FramebufferTextureMultiviewOVR = nullptr;

    bool renders_to_half_floats = false;  ///< so that it can build the displacement's mips
    /// Buffers can be mapped, and fences waited for. In WebGL neither can be: it orders what passes through buffers by itself.
    bool maps_buffers = true;
    bool can_disable_primitive_restart = true;  ///< not in WebGL, where the largest index always restarts
};

/// Loads the table for the context that is current on this thread. Throws GlError if it is older than ES 3.0.
Functions load_functions(GetProcAddress get);

bool has_extension(const Functions& gl, std::string_view name);

/// Throws ContextLost if the driver reset the context.
void check_context(const Functions& gl);

}  // namespace pelagic::gl
