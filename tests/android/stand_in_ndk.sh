#!/usr/bin/env bash
# Makes a folder with the layout of an Android NDK around Debian's clang. It is NOT an NDK: code is compiled
# for Linux, with the headers of glibc and Debian's libc++. As with an NDK, libraries contain the C++
# library, are linked against stubs of libc.so, libm.so and libdl.so, and state API level 29; their segments
# are aligned to 4 KB unless an option changes that.
#
# usage: stand_in_ndk.sh FOLDER LIBCXX_FOLDER
#
# LIBCXX_FOLDER has libc++ for 64-bit Arm (cmake/unpack_arm64_libcxx.sh).
set -euo pipefail
ndk=$(realpath -m "$1") libcxx=$(realpath "$2")
tools=$ndk/toolchains/llvm/prebuilt/linux-x86_64
mkdir -p "$ndk/build/cmake" "$tools/bin"
printf 'Pkg.Desc = Android NDK\nPkg.Revision = 27.0.0\n' >"$ndk/source.properties"

# The options that the toolchain file of r27 sets by default, as far as Debian's clang has them.
cat >"$ndk/build/cmake/android.toolchain.cmake" <<'END'
set(CMAKE_SYSTEM_NAME Android)
set(CMAKE_SYSTEM_VERSION 1)  # CMake's own support of NDKs is off
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ANDROID_ABI ANDROID_PLATFORM)
set(ANDROID TRUE)
get_filename_component(ndk ${CMAKE_CURRENT_LIST_DIR}/../.. ABSOLUTE)
set(tools ${ndk}/toolchains/llvm/prebuilt/linux-x86_64)
list(APPEND CMAKE_FIND_ROOT_PATH ${ndk})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
foreach(kind LIBRARY INCLUDE PACKAGE)
  set(CMAKE_FIND_ROOT_PATH_MODE_${kind} ONLY)
endforeach()
set(CMAKE_SYSTEM_PROCESSOR x86_64)
if(ANDROID_ABI STREQUAL arm64-v8a)
  set(CMAKE_SYSTEM_PROCESSOR aarch64)
endif()
string(REPLACE android- "" level ${ANDROID_PLATFORM})
set(CMAKE_SYSROOT ${tools}/sysroot)
foreach(language C CXX)
  set(CMAKE_${language}_COMPILER_TARGET ${CMAKE_SYSTEM_PROCESSOR}-none-linux-android${level})
  set(CMAKE_${language}_FLAGS "" CACHE STRING "")
  string(PREPEND CMAKE_${language}_FLAGS "-g -DANDROID -fdata-sections -ffunction-sections -funwind-tables "
    "-fstack-protector-strong -D_FORTIFY_SOURCE=2 -Wformat -Werror=format-security ")
  set(CMAKE_${language}_FLAGS_RELEASE "" CACHE STRING "")
  string(PREPEND CMAKE_${language}_FLAGS_RELEASE "-O3 -DNDEBUG ")
endforeach()
set(CMAKE_C_COMPILER ${tools}/bin/clang)
set(CMAKE_CXX_COMPILER ${tools}/bin/clang++)
set(CMAKE_POSITION_INDEPENDENT_CODE TRUE)
set(CMAKE_SHARED_LINKER_FLAGS "" CACHE STRING "")
string(PREPEND CMAKE_SHARED_LINKER_FLAGS "-static-libstdc++ -Wl,--build-id=sha1 -Wl,--no-rosegment "
  "-Wl,--no-undefined-version -Wl,--fatal-warnings -Wl,--no-undefined -Qunused-arguments ")
set(CMAKE_SHARED_LINKER_FLAGS_RELEASE "-Wl,--gc-sections")
END

cat >"$tools/bin/clang" <<END
#!/usr/bin/env bash
name=\$(basename "\$0") sysroot=$tools/sysroot libcxx=$libcxx
END
cat >>"$tools/bin/clang" <<'END'
triple=x86_64-linux links=1 shared= words=()
for word in "$@"; do
  case $word in
    --target=aarch64-*) triple=aarch64-linux ;&
    --target=* | --sysroot=* | -static-libstdc++) continue ;;
    -c | -E | -S) links= ;;
    -shared) shared=1 ;;
  esac
  words+=("$word")
done
cxx=() archives=/usr/lib/llvm-14/lib gcc=/usr/lib/gcc/x86_64-linux-gnu/12
if [ $triple = aarch64-linux ]; then
  cxx=(-stdlib++-isystem "$libcxx/usr/lib/llvm-14/include/c++/v1") archives=$libcxx/usr/lib/llvm-14/lib gcc=/usr/lib/gcc-cross/aarch64-linux-gnu/12
else
  cxx=(-stdlib++-isystem /usr/lib/llvm-14/include/c++/v1)
fi
[ "$name" = clang++ ] || cxx=()
before=(--target=$triple-gnu "${cxx[@]}") after=()
if [ -n "$links" ]; then
  before+=(-fuse-ld=lld -Wl,-z,max-page-size=4096)
  [ "$name" = clang ] || after+=(-nostdlib++ "$archives/libc++.a" "$archives/libc++abi.a")
  if [ -n "$shared" ]; then
    stubs=$sysroot/usr/lib/$triple-android/29
    after=(-nostdlib "$stubs/crtbegin_so.o" "${after[@]}" -L"$stubs" -lm -lc -ldl "$gcc/libgcc_eh.a" "$gcc/libgcc.a")
  fi
fi
exec "$name-14" "${before[@]}" "${words[@]}" "${after[@]}"
END
chmod +x "$tools/bin/clang"
ln -sf clang "$tools/bin/clang++"

# Stubs, as the NDK's: the names of functions without code.
for triple in aarch64-linux x86_64-linux; do
  libc=/lib/$triple-gnu
  [ $triple = x86_64-linux ] || libc=/usr/$triple-gnu/lib
  stubs=$tools/sysroot/usr/lib/$triple-android/29
  mkdir -p "$stubs"
  # The start-up object has a note with the API level, and the handle that destructors are registered with.
  clang-14 --target=$triple-gnu -c -x assembler - -o "$stubs/crtbegin_so.o" <<'END'
  .section .note.android.ident, "a", %note
  .p2align 2
  .long 8, 132, 1
  .asciz "Android"
  .long 29
  .asciz "r27"
  .zero 124
  .hidden __dso_handle
  .globl __dso_handle
  .data
  .p2align 3
__dso_handle: .quad __dso_handle
  .section .note.GNU-stack, "", %progbits
END
  for name in c m dl; do
    files=("$libc/lib$name.so.6")
    case $name in
      c) files+=("$libc"/ld-linux-*.so.?) ;;
      dl) files=(/dev/null) ;;
    esac
    { [ $name = dl ] || nm -D --defined-only "${files[@]}" | awk 'NF == 3 && $2 ~ /[TWiBDRV]/ { sub(/@.*/, "", $3); print $3 }' | sort -u |
      awk '{ print ".globl " $1 "\n.type " $1 ", %function\n" $1 ":" }'; } |
      clang-14 --target=$triple-gnu -shared -nostdlib -fuse-ld=lld -Wl,-soname,lib$name.so -x assembler - -o "$stubs/lib$name.so"
  done
done
