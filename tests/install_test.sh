#!/usr/bin/env bash
# Installs into an empty prefix, then builds the example hosts in a place that sees nothing else, and runs them: both
# print the same frames. Also with pkg-config; and each installed header stands alone and names nobody else's library.
#
# usage: install_test.sh BUILD_FOLDER EXAMPLES_FOLDER CMAKE C_COMPILER CXX_COMPILER
set -euo pipefail
build=$1 examples=$2 cmake=$3 cc=$4 cxx=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export DESTDIR=  # the caller's would move the prefix

"$cmake" --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix"  # package files must not remember where they were put

cp -r "$examples" "$work/examples"
for host in cpp_host c_host; do
  "$cmake" -S "$work/examples/$host" -B "$work/$host" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_C_COMPILER="$cc" -DCMAKE_CXX_COMPILER="$cxx" >"$work/log" 2>&1 &&
    "$cmake" --build "$work/$host" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  "$work/$host/$host" >"$work/$host.txt"
done
diff "$work/cpp_host.txt" "$work/c_host.txt"
[ "$(wc -l <"$work/c_host.txt")" -eq 5 ]

# The component that needs GLM, which no example uses.
mkdir "$work/quadtree_host"
cat >"$work/quadtree_host/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.16)
project(quadtree_host LANGUAGES CXX)
find_package(pelagic REQUIRED COMPONENTS quadtree)
add_executable(quadtree_host main.cpp)
target_link_libraries(quadtree_host PRIVATE pelagic::quadtree)
END
cat >"$work/quadtree_host/main.cpp" <<'END'
#include "pelagic/quadtree/patch_mesh.hpp"
#include "pelagic/quadtree/patch_vertex.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/quadtree/skirt.hpp"

int main() {
    pelagic::Selection selection(pelagic::quadtree_preset_named("low")->options(1024));
    return selection.select({.viewer_m = {1, 2, 3}}).instances.empty() ? 1 : 0;
}
END
"$cmake" -S "$work/quadtree_host" -B "$work/quadtree_build" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_CXX_COMPILER="$cxx" >"$work/log" 2>&1 &&
  "$cmake" --build "$work/quadtree_build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/quadtree_build/quadtree_host"

# The component that draws, by the example of a host with a context of its own.
if [ -d "$work/prefix/include/pelagic/gl" ]; then
  mkdir "$work/gl_host"
  cat >"$work/gl_host/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.16)
project(gl_host LANGUAGES CXX)
find_package(pelagic REQUIRED COMPONENTS gl)
add_executable(gl_host main.cpp)
target_link_libraries(gl_host PRIVATE pelagic::gl EGL GLESv2)
END
  cp "$work/examples/gl_host.cpp" "$work/gl_host/main.cpp"
  "$cmake" -S "$work/gl_host" -B "$work/gl_build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$cxx" >"$work/log" 2>&1 &&
    "$cmake" --build "$work/gl_build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  (cd "$work" && gl_build/gl_host)
  [ "$(head -c 14 "$work/sea.ppm" | tr '\n' ' ')" = "P6 960 540 255" ]
fi

PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name pelagic_c.pc)")
export PKG_CONFIG_PATH
library_folder=$(dirname "$PKG_CONFIG_PATH")
if command -v pkg-config >/dev/null; then
  "$cc" -std=c99 -Wall -Wextra -pedantic -Werror "$examples/c_host/main.c" -o "$work/c_pc" \
    $(pkg-config --cflags --libs pelagic_c)
  LD_LIBRARY_PATH="$library_folder" "$work/c_pc" | diff - "$work/c_host.txt"
  "$cxx" -std=c++20 "$examples/cpp_host/main.cpp" -o "$work/cpp_pc" $(pkg-config --cflags --libs pelagic)
  "$work/cpp_pc" | diff - "$work/c_host.txt"
fi

cd "$work/prefix/include/pelagic"
for header in $(find jobs simd sim -name '*.hpp') pelagic.h; do
  "$cxx" -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I.. -x c++ - <<<"#include <pelagic/$header>"
done
if find . -name '*kernel*' | grep .; then
  echo "kernels are nobody's business but Pelagic's"
  exit 1
fi

# A host whose own folders have the same names, and come first on its path.
mkdir -p "$work/clash/sim" "$work/clash/jobs" "$work/clash/simd" "$work/clash/quadtree"
for header in $(find jobs simd sim -name '*.hpp'); do
  echo '#error "a host file was taken for one of Pelagic"' >"$work/clash/$header"
done
"$cxx" -std=c++20 -fsyntax-only -I"$work/clash" -I.. "$examples/cpp_host/main.cpp"
if grep -rnE '#include.*(xsimd|tbb|OpenImageIO|Imath|toml|json|CLI|GL/|GLES|EGL)' jobs simd sim quadtree pelagic.h ||
  grep -rnE '#include.*(xsimd|tbb|OpenImageIO|Imath|toml|json|CLI)' .; then
  echo "an installed header names a library that hosts need not have"
  exit 1
fi
if grep -rn '#include.*glm' jobs simd sim pelagic.h; then
  echo "GLM is for the quadtree component only"
  exit 1
fi
[ ! -x "$work/prefix/bin/pelagic" ] || "$work/prefix/bin/pelagic" --version >/dev/null
