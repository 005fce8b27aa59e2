# Cross-compiles for Android with the NDK in PELAGIC_NDK, an absolute path: its own toolchain file, which
# reads ANDROID_ABI and ANDROID_PLATFORM, and header-only packages of the build machine, if it has them.
set(PELAGIC_NDK "$ENV{ANDROID_NDK_ROOT}" CACHE PATH "Folder of the Android NDK, r26 or later")
if(NOT EXISTS ${PELAGIC_NDK}/build/cmake/android.toolchain.cmake)
  message(FATAL_ERROR "PELAGIC_NDK is \"${PELAGIC_NDK}\", expected the folder of an Android NDK")
endif()
include(${PELAGIC_NDK}/build/cmake/android.toolchain.cmake)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PELAGIC_NDK)
if(EXISTS /usr/include/xsimd)
  include(${CMAKE_CURRENT_LIST_DIR}/linked_headers.cmake)
endif()
