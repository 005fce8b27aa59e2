// Shader programs from the files in gl/shaders/, which are embedded in the library.
#pragma once

#include <string>
#include <string_view>

#include "pelagic/gl/functions.hpp"

namespace pelagic::gl {

/// Returns the text of gl/shaders/<file>, or an empty text if the file does not exist.
std::string_view shader_text(std::string_view file);

/// Returns the source that the driver compiles: version, `defines`, and the file with its includes.
/// \throws GlError if the file does not exist
std::string shader_source(std::string_view file, const std::string& defines = "");

/// A linked program. A line `#include "file"` in a shader inserts another file of gl/shaders/.
class Program {
   public:
    Program() = default;
    /// \param defines  lines that follow #version, for example "#define STEREO\n"
    /// \throws GlError with the driver's log if the driver cannot compile or link the program
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
