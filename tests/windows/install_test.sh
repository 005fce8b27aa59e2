#!/usr/bin/env bash
# Installs into an empty prefix, then builds examples/c_application and cpp_application in a folder
# without access to anything else, with CMake and by hand, and runs them beside pelagic.dll. Both
# print the same frames.
#
# usage: install_test.sh BUILD_FOLDER EXAMPLES_FOLDER CMAKE C_COMPILER CXX_COMPILER
#                        TOOLCHAIN [EMULATOR...]
set -euo pipefail
build=$1 examples=$2 cmake=$3 cc=$4 cxx=$5 toolchain=$6
run=("${@:7}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export DESTDIR=  # the caller's DESTDIR would move the prefix

"$cmake" --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix"  # package files must not contain their install path
[ "$(cd "$work/prefix" && ls bin/*.dll lib/*.a | tr '\n' ' ')" = "bin/pelagic.dll lib/libpelagic.a lib/libpelagic_c.dll.a lib/libpelagic_floating.a lib/libpelagic_quadtree.a " ] ||
  { ls "$work/prefix/bin" "$work/prefix/lib"; exit 1; }

export PATH="$work/prefix/bin:$PATH"  # where Windows searches DLLs; wine has its own variable
WINEPATH=$(sed 's|/|\\|g; s|^|Z:|' <<<"$work/prefix/bin")
export WINEPATH
cp -r "$examples/c_application" "$examples/cpp_application" "$work"
for application in c_application cpp_application; do
  "$cmake" -S "$work/$application" -B "$work/$application/build" -Dpelagic_DIR="$work/prefix/lib/cmake/pelagic" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_EXE_LINKER_FLAGS=-static     -DCMAKE_TOOLCHAIN_FILE="$toolchain" >"$work/log" 2>&1 &&
    "$cmake" --build "$work/$application/build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  "${run[@]}" "$work/$application/build/$application.exe" >"$work/$application.txt"
done
diff "$work/cpp_application.txt" "$work/c_application.txt"
[ "$(wc -l <"$work/c_application.txt")" -eq 5 ]

# By hand; the static library needs the compiler's own.
include=-I$work/prefix/include libraries=-L$work/prefix/lib
"$cc" -std=c99 -Wall -Wextra -pedantic -Werror "$work/c_application/main.c" -o "$work/c.exe" "$include" "$libraries" -lpelagic_c
"${run[@]}" "$work/c.exe" | diff - "$work/c_application.txt"
"$cxx" -std=c++20 -DPELAGIC_STATIC "$work/cpp_application/main.cpp" -o "$work/cpp.exe" "$include" "$libraries" -lpelagic -static
env -u WINEPATH "${run[@]}" "$work/cpp.exe" | diff - "$work/c_application.txt"
