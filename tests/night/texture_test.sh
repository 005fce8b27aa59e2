#!/usr/bin/env bash
# Compares the texture of images of `pelagic render` with a path tracer's, by
# docs/images/reference/texture.py. Exits with 77, "skipped" in ctest, if Blender is missing.
#
# usage: texture_test.sh PELAGIC FOLDER    FOLDER keeps the images
set -euo pipefail
reference=$(cd "$(dirname "$0")/../../docs/images/reference" && pwd)
pelagic=$(realpath "$1")
command -v blender >/dev/null || { echo "SKIPPED: there is no blender; ./test.sh all installs it on Debian"; exit 77; }
blender -b --python-exit-code 1 -P "$reference/texture.py" -- "$pelagic" "$2"
