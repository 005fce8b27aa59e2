# Cross-compiles to WebAssembly with Debian's emscripten 3.1.6. Programs run in node, with the build
# machine's files.
#
# -DPELAGIC_WASM_THREADS=ON   threads on shared memory, available in isolated pages
# -DPELAGIC_WEB=ON            the modules of web/ instead of programs
option(PELAGIC_WASM_THREADS "WebAssembly with threads" OFF)
option(PELAGIC_WEB "Build the modules for pages (needs emscripten)" OFF)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PELAGIC_WASM_THREADS)

include(${CMAKE_CURRENT_LIST_DIR}/linked_headers.cmake)

# The linker needs Debian's path of node modules, whichever node it runs.
foreach(language C CXX)
  set(CMAKE_${language}_LINKER_LAUNCHER ${CMAKE_COMMAND} -E env NODE_PATH=/usr/share/nodejs)
endforeach()
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)

# WebAssembly's own exceptions cost nothing until one is thrown, and every browser has had them
# since 2022. This emscripten's library for threads cannot catch them by type, so with threads
# exceptions are JavaScript's. Kernels throw nothing.
set(pelagic_wasm_flags -fwasm-exceptions)
if(PELAGIC_WASM_THREADS)
  set(pelagic_wasm_flags "-fexceptions -pthread")
endif()
set(CMAKE_C_FLAGS_INIT "${pelagic_wasm_flags}")
set(CMAKE_CXX_FLAGS_INIT "${pelagic_wasm_flags} ${pelagic_linked_headers_flags} -include ${CMAKE_CURRENT_LIST_DIR}/wasm_missing_std.hpp")
# Programs of tests access the machine's files, grow their memory and end when main() does.
if(NOT PELAGIC_WEB)
  set(CMAKE_EXE_LINKER_FLAGS_INIT "-sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB -sEXIT_RUNTIME=1")
  if(PELAGIC_WASM_THREADS)
    string(APPEND CMAKE_EXE_LINKER_FLAGS_INIT " -sPTHREAD_POOL_SIZE=9 -sPROXY_TO_PTHREAD=1")
  endif()
endif()
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/run_wasm.sh)
