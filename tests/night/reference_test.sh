#!/usr/bin/env bash
# Compares images of `pelagic render` with those of a path tracer, by
# docs/images/reference/compare.py. Exits with 77, "skipped" in ctest, if Blender is missing.
#
# usage: reference_test.sh PELAGIC FOLDER    FOLDER keeps the images and the table
set -euo pipefail
reference=$(cd "$(dirname "$0")/../../docs/images/reference" && pwd)
pelagic=$(realpath "$1")
command -v blender >/dev/null || { echo "SKIPPED: there is no blender; ./test.sh all installs it on Debian"; exit 77; }
blender -b --python-exit-code 1 -P "$reference/compare.py" -- "$pelagic" "$2" --samples 128 --check | grep -v '^Fra:'
