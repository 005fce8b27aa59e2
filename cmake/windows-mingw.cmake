# Cross-compiles for 64-bit Windows with Debian's mingw-w64. Tests run under wine, whose prefix is
# in the build folder. On Windows itself, as in MSYS2, this file does nothing.
if(CMAKE_HOST_WIN32)
  return()
endif()
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)  # the variant with C++ threads
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
list(APPEND CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
include(${CMAKE_CURRENT_LIST_DIR}/linked_headers.cmake)
set(CMAKE_C_FLAGS_INIT "${pelagic_linked_headers_flags}")
set(CMAKE_CXX_FLAGS_INIT "${pelagic_linked_headers_flags}")
set(CMAKE_CROSSCOMPILING_EMULATOR ${CMAKE_CURRENT_LIST_DIR}/run_wine.sh;${CMAKE_BINARY_DIR}/wine-prefix)
