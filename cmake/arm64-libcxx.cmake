# clang++ with libc++ for 64-bit Arm Linux: the compiler and C++ library of the Android NDK, with
# another C library. Tests run under qemu's user mode. Debian's libc++ for Arm cannot be installed
# beside that of the build machine, so it is unpacked into a folder once.
set(PELAGIC_ARM64_LIBCXX_FOLDER ${CMAKE_CURRENT_LIST_DIR}/../build/arm64-libcxx-packages CACHE PATH "libc++ for 64-bit Arm")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES PELAGIC_ARM64_LIBCXX_FOLDER)
if(NOT EXISTS ${PELAGIC_ARM64_LIBCXX_FOLDER})
  execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/unpack_arm64_libcxx.sh ${PELAGIC_ARM64_LIBCXX_FOLDER} COMMAND_ERROR_IS_FATAL ANY)
endif()
set(libcxx ${PELAGIC_ARM64_LIBCXX_FOLDER}/usr/lib/llvm-14)
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER clang)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_C_COMPILER_TARGET aarch64-linux-gnu)
set(CMAKE_CXX_COMPILER_TARGET aarch64-linux-gnu)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_CXX_FLAGS_INIT "-stdlib++-isystem ${libcxx}/include/c++/v1")
foreach(kind EXE SHARED MODULE)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT "-stdlib=libc++ -L${libcxx}/lib -Wl,-rpath,${libcxx}/lib")
endforeach()
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64)
# Debian's GoogleTest is compiled with another C++ library.
set(PELAGIC_GTEST_SOURCE /usr/src/googletest)
