# The instruction sets that kernels are compiled for, and the flags of each.
#
# PELAGIC_ISAS                all of the target processor, weakest first, unless the cache has fewer
# PELAGIC_ISA_FLAGS_<isa>     compiler flags of its one object
# PELAGIC_XSIMD_ARCH_<isa>    the name in xsimd
#
# xsimd selects its code by these flags: avx512 means F, CD, DQ and BW, which every AVX-512 server
# and desktop core has. FMA is disabled on purpose: products and sums round separately on every
# instruction set, so that SSE4.2, which has no fused instruction, gives bit-identical results.
if(EMSCRIPTEN)  # its CMAKE_SYSTEM_PROCESSOR is x86
  set(all_isas wasm128)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
  set(all_isas sse4_2 avx2 avx512)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
  set(all_isas neon)
else()
  message(FATAL_ERROR "Pelagic has kernels for x86-64, 64-bit Arm and WebAssembly, not for ${CMAKE_SYSTEM_PROCESSOR}")
endif()
set(PELAGIC_ISAS "${all_isas}" CACHE STRING "Instruction sets that kernels are compiled for, weakest first")
list(JOIN all_isas ", " accepted_isas)
foreach(isa IN LISTS PELAGIC_ISAS)
  if(NOT isa IN_LIST all_isas)
    message(FATAL_ERROR "PELAGIC_ISAS has ${isa}, accepted here: ${accepted_isas}")
  endif()
endforeach()
if(NOT PELAGIC_ISAS)
  message(FATAL_ERROR "PELAGIC_ISAS is empty, accepted here: ${accepted_isas}")
endif()
# For C++: PELAGIC_COMPILED_ISA(sse4_2) and so on, a line each.
list(TRANSFORM PELAGIC_ISAS REPLACE "(.+)" "PELAGIC_COMPILED_ISA(\\1)\n" OUTPUT_VARIABLE compiled_isas)
list(JOIN compiled_isas "" compiled_isas)
file(CONFIGURE OUTPUT ${PELAGIC_INCLUDE_ROOT}/pelagic/generated/compiled_isas.inc CONTENT "${compiled_isas}" @ONLY)
set(PELAGIC_ISA_FLAGS_sse4_2 -msse4.2)
set(PELAGIC_ISA_FLAGS_avx2 -mavx2 -mf16c)
set(PELAGIC_ISA_FLAGS_avx512 -mavx512f -mavx512cd -mavx512dq -mavx512bw)
set(PELAGIC_ISA_FLAGS_neon)
# xsimd 8.1 does not support WebAssembly, but emscripten implements most of SSE4.2 with 128-bit
# instructions. Those that it emulates lane by lane are replaced.
set(PELAGIC_ISA_FLAGS_wasm128 -msimd128 -msse4.2 -include ${PROJECT_SOURCE_DIR}/simd/wasm128_intrinsics.kernel.hpp)
# The same without SIMD instructions, for a benchmark: what emcc defines for -msse4.2, which it accepts
# with -msimd128 only.
set(PELAGIC_WASM_SCALAR_FLAGS -D__SSE__=1 -D__SSE2__=1 -D__SSE3__=1 -D__SSSE3__=1 -D__SSE4_1__=1 -D__SSE4_2__=1 -D__wasm_simd128__=1
    -include ${PROJECT_SOURCE_DIR}/simd/wasm_scalar.kernel.hpp)
set(PELAGIC_XSIMD_ARCH_sse4_2 sse4_2)
set(PELAGIC_XSIMD_ARCH_avx2 avx2)
set(PELAGIC_XSIMD_ARCH_avx512 avx512bw)
set(PELAGIC_XSIMD_ARCH_neon neon64)
set(PELAGIC_XSIMD_ARCH_wasm128 sse4_2)

# Windows aligns stacks to 16 bytes, and g++ spills registers of 32 and 64 bytes there as if they
# were aligned to their size (GCC bug 54412, fixed in Debian's mingw-w64). So no move of such a
# register requires alignment; on these processors that costs nothing.
if(MINGW)
  foreach(isa avx2 avx512)
    list(APPEND PELAGIC_ISA_FLAGS_${isa} -Wa,-muse-unaligned-vector-move)
  endforeach()
endif()

# With a sanitizer, -O3 takes minutes to compile and detects nothing more.
set(kernel_optimisation -O3)
if(PELAGIC_SANITIZE)
  set(kernel_optimisation -O1)
endif()
set(PELAGIC_KERNEL_OPTIMISATION ${kernel_optimisation} CACHE STRING "Optimisation of the kernels, in every build type")

# xsimd is header-only. Debian's CMake target links xtl, which the package does not include.
find_path(PELAGIC_XSIMD_INCLUDE_DIR xsimd/xsimd.hpp REQUIRED)

# Adds an object of kernels for one instruction set. It is optimised in every build type:
# unoptimised xsimd is a hundred times slower, and its functions would not be inlined, so the linker
# could share them with other code.
function(pelagic_kernel_objects target isa source)
  add_library(${target} OBJECT ${source})
  set_target_properties(${target} PROPERTIES UNITY_BUILD OFF)
  set(PELAGIC_OPTIMISATION "")
  pelagic_target(${target})
  target_compile_definitions(${target} PRIVATE PELAGIC_ISA_NAME=${isa} PELAGIC_ISA_ARCH=${PELAGIC_XSIMD_ARCH_${isa}})
  target_compile_options(${target} PRIVATE ${PELAGIC_KERNEL_OPTIMISATION} -fno-exceptions -Wno-conversion
                                           ${PELAGIC_ISA_FLAGS_${isa}})
  target_include_directories(${target} SYSTEM PRIVATE ${PELAGIC_XSIMD_INCLUDE_DIR})
  # In kernels these checks of pointers take a third of the compile time. AddressSanitizer reports
  # such a pointer where it is used.
  if(PELAGIC_SANITIZE MATCHES "address.*undefined")
    target_compile_options(${target} PRIVATE -fno-sanitize=null,pointer-overflow)
  endif()
  # g++ marks the scope of each vector that a function returns: ten times the code, for values that
  # nothing points to. clang omits these marks, so `asan` and `fuzz` do detect use after scope in
  # kernels too.
  if(PELAGIC_SANITIZE MATCHES "address" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -fno-sanitize-address-use-after-scope)
  endif()
  # g++ 12 reports the undefined lanes that its AVX-512 header passes on purpose as uninitialised
  # variables.
  if(isa STREQUAL "avx512" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-uninitialized -Wno-maybe-uninitialized)
  endif()
endfunction()
