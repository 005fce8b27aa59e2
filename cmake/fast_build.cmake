# PELAGIC_FAST_BUILD: a compiler cache and a quick linker, for builds that are repeated. ccache
# takes paths relative to the sources, so that clones in other folders share its entries.
if(NOT PELAGIC_FAST_BUILD)
  return()
endif()
find_program(PELAGIC_CCACHE ccache)
if(PELAGIC_CCACHE)
  foreach(language C CXX)
    if(NOT CMAKE_${language}_COMPILER_LAUNCHER)
      set(CMAKE_${language}_COMPILER_LAUNCHER
        ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${PELAGIC_CCACHE})
    endif()
  endforeach()
  # __FILE__, which each check of a test contains, too
  add_compile_options(-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
endif()
# mingw-w64, emscripten and macOS have linkers of their own, and g++ for another processor looks for
# lld by another name.
find_program(PELAGIC_LLD ld.lld)
if(PELAGIC_LLD AND UNIX AND NOT APPLE AND NOT EMSCRIPTEN AND NOT (CMAKE_CROSSCOMPILING AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU"))
  add_link_options(-fuse-ld=lld)
endif()
