# For toolchain files: makes header-only packages of the build machine available to a cross
# compiler, whose own headers must come first. /usr/include on its path would hide them, so each
# header or folder is linked into a folder of the build.
set(pelagic_linked_headers ${CMAKE_BINARY_DIR}/linked-headers)
file(MAKE_DIRECTORY ${pelagic_linked_headers})
foreach(header xsimd glm xxhash.h Imath CLI nlohmann stb toml++)
  if(EXISTS /usr/include/${header} AND NOT EXISTS ${pelagic_linked_headers}/${header})
    file(CREATE_LINK /usr/include/${header} ${pelagic_linked_headers}/${header} SYMBOLIC)
  endif()
endforeach()
foreach(package_and_target glm|glm::glm CLI11|CLI11::CLI11 nlohmann_json|nlohmann_json::nlohmann_json)
  string(REPLACE "|" ";" package_and_target ${package_and_target})
  list(GET package_and_target 0 package)
  list(GET package_and_target 1 target)
  file(CONFIGURE OUTPUT ${pelagic_linked_headers}/${package}Config.cmake CONTENT [[
if(NOT TARGET @target@)
  add_library(@target@ INTERFACE IMPORTED)
  target_include_directories(@target@ SYSTEM INTERFACE ${CMAKE_CURRENT_LIST_DIR})
endif()
]] @ONLY)
  set(${package}_DIR ${pelagic_linked_headers})
endforeach()
foreach(package XSIMD XXHASH STB TOMLPLUSPLUS)
  set(PELAGIC_${package}_INCLUDE_DIR ${pelagic_linked_headers})
endforeach()
set(PELAGIC_IMATH_INCLUDE_DIR ${pelagic_linked_headers}/Imath)
set(PELAGIC_IMATH_LIBRARY m)  # none: without its table of halves Imath is header-only
set(pelagic_linked_headers_flags -DIMATH_HALF_NO_LOOKUP_TABLE)
set(PELAGIC_GTEST_SOURCE /usr/src/googletest)
