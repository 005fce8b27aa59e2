#!/usr/bin/env bash
# Installs into an empty prefix, builds the example applications in a folder without access to
# anything else, and runs them: both print the same frames. Also tests pkg-config, and that each
# installed header is self-contained and needs no third-party header.
#
# usage: install_test.sh BUILD_FOLDER EXAMPLES_FOLDER CMAKE C_COMPILER CXX_COMPILER
set -euo pipefail
build=$1 examples=$2 cmake=$3 cc=$4 cxx=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export DESTDIR=  # the caller's DESTDIR would move the prefix

"$cmake" --install "$build" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix"  # package files must not contain their install path

# The packages' lists name each header.
lists=$examples/../packaging/files
(cd "$work/prefix/include" && find . -type f | sed 's|^./||' | sort) |
  diff <(sort "$lists/headers.txt" $([ ! -d "$work/prefix/include/pelagic/gl" ] || echo "$lists/headers_gl.txt")) -

diff -r "$examples/../presets" "$work/prefix/share/pelagic/presets"
cp -r "$examples" "$work/examples"
for application in cpp_application c_application; do
  "$cmake" -S "$work/examples/$application" -B "$work/$application" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_C_COMPILER="$cc" -DCMAKE_CXX_COMPILER="$cxx" >"$work/log" 2>&1 &&
    "$cmake" --build "$work/$application" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  "$work/$application/$application" >"$work/$application.txt"
done
diff "$work/cpp_application.txt" "$work/c_application.txt"
# The page for Windows shows these lines, and a test of Windows compares them too.
sed -n '/^```text$/,/^```$/{/^```/!p}' "$examples/../docs/integrations/windows.md" | diff - "$work/c_application.txt"

# The application of docs/getting-started.md, built by the page's line.
page=$examples/../docs/getting-started.md
mkdir "$work/page"
sed -n '/^```cmake$/,/^```$/{/^```/!p}' "$page" >"$work/page/CMakeLists.txt"
sed -n '/^`main.cpp`:$/,/^```$/{/^[`]/!p}' "$page" >"$work/page/main.cpp"
line=$(sed -n "s|^    \(cmake -S . .*\)/opt/pelagic \(.*\)|\1$work/prefix \2|p" "$page")
[ -n "$line" ] || { echo "docs/getting-started.md has no line for CMake"; exit 1; }
(cd "$work/page" && cmake() { command "$cmake" "$@"; } && export CXX="$cxx" && eval "$line") >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
[ "$(grep -c 'half floats to upload, side' "$work/log")" -eq 20 ] || { cat "$work/log"; exit 1; }

# A C application needs no packages, with or without components. A missing component is reported
# with its reason.
# usage: configure_c_application NAME WANTED [OPTION...]
configure_c_application() {
  mkdir -p "$work/$1"
  sed "s/find_package(.*/find_package(pelagic REQUIRED $2)/" "$examples/c_application/CMakeLists.txt" >"$work/$1/CMakeLists.txt"
  cp "$examples/c_application/main.c" "$work/$1"
  "$cmake" -S "$work/$1" -B "$work/$1/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_C_COMPILER="$cc" "${@:3}" \
    >"$work/log" 2>&1
}
without_packages=(-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON -DCMAKE_DISABLE_FIND_PACKAGE_glm=ON -DCMAKE_DISABLE_FIND_PACKAGE_Threads=ON)
for wanted in "" "COMPONENTS c"; do
  configure_c_application "bare${wanted: -1}" "$wanted" "${without_packages[@]}" || { cat "$work/log"; exit 1; }
done
refused() {  # usage: refused COMPONENT REASON [OPTION...]
  ! configure_c_application "without_$1" "COMPONENTS $1" "${@:3}" || { echo "$1 was found"; exit 1; }
  tr -s '\n ' ' ' <"$work/log" | grep -qF "component $1 is missing: $2" || { cat "$work/log"; exit 1; }
}
refused python "there is no such component: c, cpp, floating, gl and quadtree are"
refused cpp "it needs the CMake package Threads, which was not found" "-DCMAKE_DISABLE_FIND_PACKAGE_Threads=ON"
if grep -q "PELAGIC_TBB:BOOL=ON" "$build/CMakeCache.txt"; then
  refused cpp "it needs the CMake package TBB, which was not found" "-DCMAKE_DISABLE_FIND_PACKAGE_TBB=ON"
fi
refused quadtree "it needs the CMake package glm, which was not found" "-DCMAKE_DISABLE_FIND_PACKAGE_glm=ON"
mv "$(find "$work/prefix" -name pelagic_quadtree_targets.cmake)" "$work/hidden.cmake"
refused quadtree "this Pelagic was built without it"
mv "$work/hidden.cmake" "$(dirname "$(find "$work/prefix" -name pelagic_c_targets.cmake)")/pelagic_quadtree_targets.cmake"

# The component that needs GLM, which no example uses.
mkdir "$work/quadtree_application"
cat >"$work/quadtree_application/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.16)
project(quadtree_application LANGUAGES CXX)
find_package(pelagic REQUIRED COMPONENTS quadtree)
add_executable(quadtree_application main.cpp)
target_link_libraries(quadtree_application PRIVATE pelagic::quadtree)
END
cat >"$work/quadtree_application/main.cpp" <<'END'
#include "pelagic/quadtree/patch_mesh.hpp"
#include "pelagic/quadtree/patch_vertex.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/quadtree/skirt.hpp"

int main() {
    pelagic::Selection selection(pelagic::quadtree_preset_named("low")->options(1024));
    return selection.select({.viewer_m = {1, 2, 3}}).instances.empty() ? 1 : 0;
}
END
"$cmake" -S "$work/quadtree_application" -B "$work/quadtree_build" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_CXX_COMPILER="$cxx" >"$work/log" 2>&1 &&
  "$cmake" --build "$work/quadtree_build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/quadtree_build/quadtree_application"

mkdir "$work/floating_application"
cat >"$work/floating_application/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.16)
project(floating_application LANGUAGES CXX)
find_package(pelagic REQUIRED COMPONENTS floating)
add_executable(floating_application main.cpp)
target_link_libraries(floating_application PRIVATE pelagic::floating)
END
cat >"$work/floating_application/main.cpp" <<'END'
#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/floating/hull_plan.hpp"
#include "pelagic/sim/ocean.hpp"

int main() {
    using namespace pelagic;
    const std::vector<glm::dvec3> vertices{{1, 1, 0}, {-1, 1, 1}, {-1, 1, -1}, {0, -1, 0}};
    const std::vector<HullMesh::Triangle> triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    const Hull hull(HullMesh(vertices, triangles), {.mass_kg = 400});
    Ocean ocean(SeaState{.resolution = 16}, {.queries = true, .depth = true});
    FloatingBodies bodies(make_serial_executor());
    const std::uint32_t body = bodies.add(hull, hull.at_rest(0, 0));
    bodies.step(ocean.frame_at(0), 1.0 / 60);
    return bodies.loads(body).displaced_m3 > 0 ? 0 : 1;
}
END
"$cmake" -S "$work/floating_application" -B "$work/floating_build" -DCMAKE_PREFIX_PATH="$work/prefix" \
  -DCMAKE_CXX_COMPILER="$cxx" >"$work/log" 2>&1 &&
  "$cmake" --build "$work/floating_build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/floating_build/floating_application"

# The component that renders, tested with the example of an application with its own context.
if [ -d "$work/prefix/include/pelagic/gl" ]; then
  mkdir "$work/gl_application"
  cat >"$work/gl_application/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.16)
project(gl_application LANGUAGES CXX)
find_package(pelagic REQUIRED COMPONENTS gl)
add_executable(gl_application main.cpp)
target_link_libraries(gl_application PRIVATE pelagic::gl EGL GLESv2)
END
  cp "$work/examples/gl_application.cpp" "$work/gl_application/main.cpp"
  "$cmake" -S "$work/gl_application" -B "$work/gl_build" -DCMAKE_PREFIX_PATH="$work/prefix" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_CXX_COMPILER="$cxx" >"$work/log" 2>&1 &&
    "$cmake" --build "$work/gl_build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
  (cd "$work" && gl_build/gl_application)
  [ "$(head -c 14 "$work/sea.ppm" | tr '\n' ' ')" = "P6 960 540 255" ]

  # The headset example, which prints one line if there is no headset.
  if [ -e /usr/include/openxr/openxr.h ]; then
    "$cmake" -S "$work/examples/openxr_application" -B "$work/openxr_build" -DCMAKE_PREFIX_PATH="$work/prefix" \
      -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$cxx" >"$work/log" 2>&1 &&
      "$cmake" --build "$work/openxr_build" >>"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
    XR_RUNTIME_JSON=/nowhere.json XR_LOADER_DEBUG=none "$work/openxr_build/openxr_application" 2>"$work/said" && exit 1
    grep -q '^openxr_application: xrCreateInstance: XR_ERROR_RUNTIME_UNAVAILABLE' "$work/said"
  fi
fi

PKG_CONFIG_PATH=$(dirname "$(find "$work/prefix" -name pelagic_c.pc)")
export PKG_CONFIG_PATH
library_folder=$(dirname "$PKG_CONFIG_PATH")
if command -v pkg-config >/dev/null; then
  "$cc" -std=c99 -Wall -Wextra -pedantic -Werror "$examples/c_application/main.c" -o "$work/c_pc" \
    $(pkg-config --cflags --libs pelagic_c)
  LD_LIBRARY_PATH="$library_folder" "$work/c_pc" | diff - "$work/c_application.txt"
  # The page's line; afterwards the program finds the library by itself.
  line=$(sed -n 's/^    \(cc main.c -o main .*\)/\1/p' "$examples/../docs/api.md")
  [ -n "$line" ] || { echo "docs/api.md has no line for pkg-config"; exit 1; }
  cp "$examples/c_application/main.c" "$work/main.c"
  (cd "$work" && cc() { command "$cc" "$@"; } && eval "$line" && env -u LD_LIBRARY_PATH ./main) | diff - "$work/c_application.txt"
  "$cxx" -std=c++20 "$examples/cpp_application/main.cpp" -o "$work/cpp_pc" $(pkg-config --cflags --libs pelagic)
  "$work/cpp_pc" | diff - "$work/c_application.txt"
  # The static library, linked by a C compiler.
  "$cc" -std=c99 "$examples/c_application/main.c" -o "$work/c_static" $(pkg-config --static --cflags --libs pelagic)
  env -u LD_LIBRARY_PATH "$work/c_static" | diff - "$work/c_application.txt"
  "$cxx" -std=c++20 "$work/quadtree_application/main.cpp" -o "$work/quadtree_pc" $(pkg-config --cflags --libs pelagic_quadtree)
  "$work/quadtree_pc"
  "$cxx" -std=c++20 "$work/floating_application/main.cpp" -o "$work/floating_pc" $(pkg-config --cflags --libs pelagic_floating)
  "$work/floating_pc"
fi

# The licences of compiled-in code are installed.
notice=$(find "$work/prefix" -name NOTICE)
for name in xsimd xxHash GLM oneTBB CLI11 toml++ nlohmann-json "Dear ImGui" stb OpenImageIO Imath; do
  grep -qF "$name" "$notice" || { echo "NOTICE lacks $name"; exit 1; }
done
[ -s "$(dirname "$notice")/LICENSE" ]

cd "$work/prefix/include/pelagic"
for header in $(find message jobs simd sim -name '*.hpp') pelagic.h; do
  "$cxx" -std=c++20 -Wall -Wextra -Wpedantic -Werror -fsyntax-only -I.. -x c++ - <<<"#include <pelagic/$header>"
done
if find . -name '*kernel*' | grep .; then
  echo "kernels are nobody's business but Pelagic's"
  exit 1
fi

# An application whose own folders have the same names and come first on its include path.
mkdir -p "$work/clash/sim" "$work/clash/jobs" "$work/clash/simd" "$work/clash/message" "$work/clash/quadtree"
for header in $(find message jobs simd sim -name '*.hpp'); do
  echo '#error "an application file was taken for one of Pelagic"' >"$work/clash/$header"
done
"$cxx" -std=c++20 -fsyntax-only -I"$work/clash" -I.. "$examples/cpp_application/main.cpp"
if grep -rnE '#include.*(xsimd|tbb|OpenImageIO|Imath|toml|json|CLI|GL/|GLES|EGL)' message jobs simd sim quadtree pelagic.h ||
  grep -rnE '#include.*(xsimd|tbb|OpenImageIO|Imath|toml|json|CLI)' .; then
  echo "an installed header names a library that applications need not have"
  exit 1
fi
if grep -rn '#include.*glm' message jobs simd sim pelagic.h; then
  echo "GLM is for the components floating, gl and quadtree only"
  exit 1
fi
if [ -x "$work/prefix/bin/pelagic" ]; then
  "$work/prefix/bin/pelagic" --version >/dev/null
  # A library that is installed beside the tool, and found relative to it, writes the images.
  "$work/prefix/bin/pelagic" export --out "$work/export" --resolution 16 --frames 1 --maps displacement >/dev/null
  [ -s "$work/export/displacement_0000.exr" ] || { ls -R "$work/export"; exit 1; }
  [ -s "$work/prefix/share/man/man1/pelagic.1" ] || { ls -R "$work/prefix/share"; exit 1; }
  [ -s "$work/prefix/share/bash-completion/completions/pelagic" ] || { ls -R "$work/prefix/share"; exit 1; }
fi
