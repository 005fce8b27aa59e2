#!/usr/bin/env bash
# Runs a test in Blender, with the add-on installed from its zip as an artist installs it, in a home of its own.
#
# usage: run_blender.sh ZIP TEST.py [ARGUMENT...]
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
zip=$(realpath "$1")
command -v blender >/dev/null || { echo "there is no blender; ./test.sh hosts installs it on Debian"; exit 1; }
BLENDER_USER_RESOURCES=$(mktemp -d)
export BLENDER_USER_RESOURCES
trap 'rm -rf "$BLENDER_USER_RESOURCES"' EXIT
blender -b --factory-startup --python-exit-code 1 -P "$here/install_addon.py" -- "$zip" >"$BLENDER_USER_RESOURCES/log" ||
  { cat "$BLENDER_USER_RESOURCES/log"; exit 1; }
# Not exec: the trap has to run.
blender -b --python-exit-code 1 -P "$here/$2" -- "${@:3}"
