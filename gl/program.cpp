#include "pelagic/gl/program.hpp"

#include <utility>

#include "pelagic/gl/errors.hpp"

namespace pelagic::gl {
namespace {

/// Returns the file with each include line replaced by the included file.
std::string expanded(std::string_view file) {
    std::string_view text = shader_text(file);
    if (text.empty()) throw GlError("no shader " + std::string(file) + " in this build");
    constexpr std::string_view include = "#include \"";
    std::string all;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end);
        if (line.starts_with(include))
            all += expanded(line.substr(include.size(), line.find('"', include.size()) - include.size()));
        else
            all += line;
    }
    return all;
}

GLuint compiled(const Functions& gl, GLenum kind, std::string_view file, const std::string& defines) {
    const std::string text = shader_source(file, defines);
    const GLuint shader = gl.CreateShader(kind);
    const char* start = text.c_str();
    gl.ShaderSource(shader, 1, &start, nullptr);
    gl.CompileShader(shader);
    GLint good = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
    if (good) return shader;
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    gl.DeleteShader(shader);
    throw GlError("the driver refuses " + std::string(file) + ": " + log);
}

}  // namespace

std::string shader_source(std::string_view file, const std::string& defines) {
    return "#version 300 es\n" + defines + expanded(file);
}

Program::Program(const Functions& gl, std::string_view vertex_file, std::string_view fragment_file,
                 const std::string& defines)
    : gl_(&gl) {
    const GLuint vertex = compiled(gl, GL_VERTEX_SHADER, vertex_file, defines);
    const GLuint fragment = compiled(gl, GL_FRAGMENT_SHADER, fragment_file, defines);
    name_ = gl.CreateProgram();
    gl.AttachShader(name_, vertex);
    gl.AttachShader(name_, fragment);
    gl.LinkProgram(name_);
    // GL deletes the attached shaders together with the program.
    gl.DeleteShader(vertex);
    gl.DeleteShader(fragment);
    GLint good = GL_FALSE;
    gl.GetProgramiv(name_, GL_LINK_STATUS, &good);
    if (good) return;
    std::string log(4096, '\0');
    GLsizei length = 0;
    gl.GetProgramInfoLog(name_, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    gl.DeleteProgram(name_);
    throw GlError("the driver can't link " + std::string(vertex_file) + " with " + std::string(fragment_file) + ": " +
                  log);
}

Program::~Program() {
    if (name_ != 0) gl_->DeleteProgram(name_);
}
Program::Program(Program&& from) noexcept : gl_(from.gl_), name_(std::exchange(from.name_, 0)) {}
Program& Program::operator=(Program&& from) noexcept {
    std::swap(gl_, from.gl_);
    std::swap(name_, from.name_);
    return *this;
}

}  // namespace pelagic::gl
