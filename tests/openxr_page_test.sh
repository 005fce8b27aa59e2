#!/usr/bin/env bash
# Runs every command line of the section OpenXR of docs/integrations/vr.md, in a folder with the
# build at the page's path and with the stand-in as the runtime. The stand-in ends programs that run
# until their user leaves after six frames, of which the first is not displayed.
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

sed -n '/^## OpenXR$/,/^## /s/^    //p' "$source/docs/integrations/vr.md" >lines
[ "$(wc -l <lines)" -eq 5 ] || { echo "the page has other lines than this test knows"; exit 1; }
while read -r line; do
  # The preset would reconfigure this build while it is tested; here it is enough that the preset
  # exists.
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
# The last frame's images and one hash a frame, as documented on the page.
[ "$(wc -l <seas.txt)" -eq 20 ]
[ "$(head -c 9 left.ppm | tr '\n' ' ')" = "P6 32 32 " ]
! cmp -s left.ppm right.ppm || { echo "both eyes see the same"; exit 1; }
