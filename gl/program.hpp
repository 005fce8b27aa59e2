// Shader programs from the files in gl/shaders/, which are part of the library.
#pragma once

#include <string>
#include <string_view>

#include "pelagic/gl/functions.hpp"

namespace pelagic::gl {

/// The text of gl/shaders/<file>; empty if there is none.
std::string_view shader_text(std::string_view file);

/// What the driver compiles: version, `defines` and the file with its includes. Throws GlError if there is no such file.
std::string shader_source(std::string_view file, const std::string& defines = "");

/// A linked program. Lines `#include "file"` in a shader take another file of the same folder in.
class Program {
   public:
    Program() = default;
    /// \param defines  lines that follow #version, "#define STEREO\n" for one
    /// Throws GlError with the driver's log.
    Program(const Functions& gl, std::string_view vertex_file, std::string_view fragment_file,
            const std::string& defines = "");
    ~Program();
    Program(Program&&) noexcept;
    Program& operator=(Program&&) noexcept;

    GLuint name() const { return name_; }
    GLint uniform(const char* name) const { return gl_->GetUniformLocation(name_, name); }

   private:
    const Functions* gl_ = nullptr;
    GLuint name_ = 0;
};

}  // namespace pelagic::gl
