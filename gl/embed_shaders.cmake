# Writes the shaders of a folder into a C++ file, so that a program has them without finding files at run time.
# Called as cmake -DSHADERS=a.glsl;b.glsl -DOUT=file.cpp -P embed_shaders.cmake
set(cases "")
foreach(shader IN LISTS SHADERS)
  get_filename_component(name ${shader} NAME)
  file(READ ${shader} text)
  string(APPEND cases "    if (file == \"${name}\")\n        return R\"glsl(${text})glsl\";\n")
endforeach()
file(WRITE ${OUT} "// Made by gl/embed_shaders.cmake.
#include \"pelagic/gl/program.hpp\"

namespace pelagic::gl {
std::string_view shader_text(std::string_view file) {
${cases}    return {};
}
}  // namespace pelagic::gl
")
