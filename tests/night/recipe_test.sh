#!/usr/bin/env bash
# Runs a recipe of docs/recipes as documented, and compares every vertex of the program with
# `pelagic query`. Exits with 77, "skipped" in ctest, if the program is missing.
#
# usage: recipe_test.sh blender|three|godot PELAGIC FOLDER
# FOLDER keeps the images, and three.js between runs.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
recipe=$1 pelagic=$2
recipes=$here/../../docs/recipes
mkdir -p "$3"
cd "$3"

needs() {
  local program
  for program; do
    command -v "$program" >/dev/null || { echo "SKIPPED: there is no $program; ./test.sh all installs it on Debian"; exit 77; }
  done
}
waves=$(mktemp -d)
trap 'rm -rf "$waves"' EXIT
# Two frames, to detect a program that shows the wrong one.
make_waves() {
  "$pelagic" export --out "$waves" --preset "$1" --patch-size 300 --resolution 128 --loop-period 90 --loop-frames 2 \
    --maps displacement,gradient,foam
}

case $recipe in
  blender)
    needs blender
    make_waves rough
    blender -b --python-exit-code 1 -P "$recipes/blender.py" -P "$here/blender_check.py" -- "$waves" blender.png "$pelagic"
    ;;
  three)
    needs chromium npm python3
    [ -d node_modules/three ] || npm install --no-audit --no-fund --prefix . three@0.180.0
    make_waves rough
    python3 "$here/three_check.py" "$waves" three.png "$pelagic" "$recipes/three" node_modules
    ;;
  godot)
    needs godot3 xvfb-run python3
    make_waves rough
    python3 "$here/godot_check.py" "$waves" godot.png "$pelagic" "$recipes/godot"
    ;;
esac
