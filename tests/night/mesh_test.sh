#!/usr/bin/env bash
# Checks the meshes of `pelagic export --mesh` and `pelagic quadtree` with independent programs:
# Khronos' validator of glTF, and Blender, which reads every format and plays the point cache and
# the animation. Exits with 77, "skipped" in ctest, if a program is missing.
#
# usage: mesh_test.sh PELAGIC FOLDER    FOLDER keeps the image, and the validator between runs
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
pelagic=$(realpath "$1")
for program in blender npm node; do
  command -v "$program" >/dev/null || { echo "SKIPPED: there is no $program; ./test.sh all installs it on Debian"; exit 77; }
done
mkdir -p "$2"
cd "$2"
[ -d node_modules/gltf-validator ] || npm install --no-audit --no-fund --prefix . gltf-validator@2.0.0-dev.3.10

waves=$(mktemp -d)
trap 'rm -rf "$waves"' EXIT
"$pelagic" export --out "$waves" --preset rough --patch-size 300 --resolution 128 --loop-period 60 --loop-frames 5 \
  --maps none --mesh obj,ply,gltf,gltf-animation,mdd
"$pelagic" quadtree --preset rough --quality low --foam --gltf "$waves/quadtree.glb" >/dev/null
"$pelagic" quadtree --preset rough --quality low --gltf "$waves/without_foam.glb" >/dev/null
NODE_PATH=node_modules node "$here/gltf_check.js" "$waves"/*.glb
blender -b --python-exit-code 1 -P "$here/mesh_check.py" -- "$waves" meshes.png "$pelagic"
