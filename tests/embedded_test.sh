#!/usr/bin/env bash
# An application that adds Pelagic's sources, with add_subdirectory or by the lines of
# docs/packages.md with FetchContent: its target `all` has nothing of Pelagic unless it links it,
# and its installation has nothing of Pelagic at all. `build` also builds and runs the application.
#
# usage: embedded_test.sh SOURCE_FOLDER CMAKE C_COMPILER CXX_COMPILER WAY [build]
#
# WAY is add_subdirectory or FetchContent.
set -euo pipefail
source=$1 cmake=$2 cc=$3 cxx=$4 way=$5
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export DESTDIR=

case $way in
  add_subdirectory) added="add_subdirectory($source pelagic)" ;;
  FetchContent)
    added=$(sed -n '/^```cmake$/,/^```$/{/FetchContent/p}' "$source/docs/packages.md")
    [ -n "$added" ] || { echo "docs/packages.md has no lines for FetchContent"; exit 1; }
    ;;
esac
cat >"$work/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(application LANGUAGES C CXX)
$added
add_executable(application main.c)
install(TARGETS application)
if(LINKED)
  target_link_libraries(application PRIVATE pelagic::pelagic_c)
endif()
END
cp "$source/examples/c_application/main.c" "$work"

configure() {
  "$cmake" -G 'Unix Makefiles' -S "$work" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER="$cc" -DCMAKE_CXX_COMPILER="$cxx" \
    -DFETCHCONTENT_SOURCE_DIR_PELAGIC="$source" -DLINKED="$1" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
}
# The sources of Pelagic that the target `all` compiles. A dry run omits targets that need objects
# of others, because there are none.
compiled() {
  { make -C "$work/build" --dry-run --keep-going all 2>/dev/null || true; } | sed -n 's|.* -c \(.*/\)*\([^/ ]*[.]cpp\)$|\2|p' | sort -u
}

configure OFF
[ -z "$(compiled)" ] || { echo "all has of Pelagic:"; compiled; exit 1; }
! grep -rlE '^ *file\(INSTALL' "$work/build/_deps" "$work/build/pelagic" --include=cmake_install.cmake 2>/dev/null ||
  { echo "Pelagic would be installed with the application"; exit 1; }

# The C interface, and neither the mesh nor the renderer.
configure ON
compiled >"$work/compiled"
grep -qx kernels_isa.cpp "$work/compiled" || { echo "all lacks the kernels"; exit 1; }
! grep -xE 'selection.cpp|sea_renderer.cpp|hull.cpp|command_line.cpp' "$work/compiled" || { echo "all has parts that are not linked"; exit 1; }

if [ "${6:-}" = build ]; then
  make -C "$work/build" -j "$(nproc)" >"$work/log" 2>&1 || { tail -n 40 "$work/log"; exit 1; }
  "$work/build/application" | diff <(sed -n '/^```text$/,/^```$/{/^```/!p}' "$source/docs/integrations/windows.md") -
fi
