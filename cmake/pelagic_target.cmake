# One include root: every include is of the form "pelagic/sim/ocean.hpp", here and in an installed
# tree. No folder of Pelagic is itself on an include path, where an application's own sim/frame.hpp
# could hide a header. The top-level folders are linked below the root, beside pelagic.h, which C
# applications include as <pelagic/pelagic.h>.
set(PELAGIC_INCLUDE_ROOT ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${PELAGIC_INCLUDE_ROOT}/pelagic)
foreach(folder message simd analytic jobs sim floating quadtree capi gl viewer tools web contrib bench tests examples)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${folder} ${PELAGIC_INCLUDE_ROOT}/pelagic/${folder} SYMBOLIC)
endforeach()
file(CREATE_LINK ${PROJECT_SOURCE_DIR}/capi/pelagic.h ${PELAGIC_INCLUDE_ROOT}/pelagic/pelagic.h SYMBOLIC)

set(PELAGIC_OPTIMISATION "" CACHE STRING "Optimisation of all targets except kernels, in every build type; empty: the build type's")

# Sets the properties of every target of Pelagic: language, floating-point policy, warnings,
# sanitizers.
function(pelagic_target target)
  # An application may set -ffast-math or parts of it for everything. Target options come later on
  # the command line, so these take precedence.
  set(strict_floats -fno-fast-math -fno-unsafe-math-optimizations -fno-associative-math -fno-reciprocal-math
                    -fno-finite-math-only -fsigned-zeros)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Objects are compiled once, for the static library and for the shared one, which exports only the
  # C interface.
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON
                        CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  if(EMSCRIPTEN)  # has no shared library
    set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  endif()
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PELAGIC_INCLUDE_ROOT}> $<INSTALL_INTERFACE:include>)
  # A compiler that fuses a*b + c where the instruction set allows it rounds once instead of twice,
  # so each instruction set would compute a different sea. Disabled everywhere, because
  # bit-identical results are part of the interface.
  target_compile_options(${target} PRIVATE ${strict_floats} -ffp-contract=off -Wall -Wextra -Wpedantic -Wshadow -Wconversion
                                           -Wno-sign-conversion)
  # g++ 12 reports overlapping copies in every `"text" + std::string` (GCC bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    target_compile_options(${target} PRIVATE -Wno-restrict)
  endif()
  # clang 14 warns for each file on 64-bit Arm that it does not track floating-point exceptions;
  # Pelagic does not use them.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    target_compile_options(${target} PRIVATE -Wno-unsupported-floating-point-opt)
  endif()
  target_compile_options(${target} PRIVATE ${PELAGIC_OPTIMISATION})
  # When linking, -ffast-math adds a start-up file that sets flush-to-zero for the whole process.
  target_link_options(${target} PRIVATE -fno-fast-math)
  # Not kernels: coverage would slow them down, and they have few branches.
  if(PELAGIC_FUZZ AND NOT target MATCHES "kernels")
    target_compile_options(${target} PRIVATE -fsanitize=fuzzer-no-link)
  endif()
  if(PELAGIC_SANITIZE)
    target_compile_options(${target} PRIVATE -fsanitize=${PELAGIC_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
    target_link_options(${target} PUBLIC -fsanitize=${PELAGIC_SANITIZE})
  endif()
endfunction()

# For sources that parse, print and wait rather than compute: they compile in half the time and run
# as fast.
function(pelagic_compile_quickly target)
  if(PELAGIC_SANITIZE)
    target_compile_options(${target} PRIVATE -O0)
  else()
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()
