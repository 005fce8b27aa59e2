#!/usr/bin/env bash
# Every command line of docs/users/openxr.md, in a folder that has the build where the page has it, with the stand-in for a
# runtime. What goes on until its user leaves is left by the stand-in's after six frames, of which the first is not seen.
#
# usage: openxr_page_test.sh SOURCE_FOLDER BUILD_FOLDER RUNTIME_JSON
set -euo pipefail
source=$1 build=$2
export XR_RUNTIME_JSON=$3 PELAGIC_STAND_IN_EYE=32
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/build"
ln -s "$build" "$work/build/release"
cd "$work"

sed -n 's/^    //p' "$source/docs/users/openxr.md" >lines
[ "$(wc -l <lines)" -eq 5 ] || { echo "the page has other lines than this test knows"; exit 1; }
while read -r line; do
  # The preset would configure this very build anew while it is tested; that there is one of this name is enough here.
  [ "$line" != "cmake --preset release" ] || line="cmake --list-presets=configure -S $source"
  echo "$line"
  case $line in *--frames*) unset PELAGIC_STAND_IN_EVENTS ;; *) export PELAGIC_STAND_IN_EVENTS=6:exit ;; esac
  bash -e -c "$line" >out || { cat out; exit 1; }
  case $line in
    cmake*--list*) grep -q '"release"' out ;;
    *openxr_application\ --frames*) grep -q '^20 frames shown' out ;;
    *bin/openxr_application*) grep -q '^5 frames shown' out ;;
  esac
done <lines
# The last frame's images and a hash a frame, as the page says.
[ "$(wc -l <seas.txt)" -eq 20 ]
[ "$(head -c 9 left.ppm | tr '\n' ' ')" = "P6 32 32 " ]
! cmp -s left.ppm right.ppm || { echo "both eyes see the same"; exit 1; }
