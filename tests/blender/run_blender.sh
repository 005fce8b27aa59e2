#!/usr/bin/env bash
# Installs the add-on from its zip as docs/integrations/blender.md describes, and runs a test in
# Blender, with a temporary home and folder.
#
# usage: run_blender.sh SOURCE_FOLDER ZIP TEST.py PELAGIC
set -euo pipefail
source=$1 zip=$2 here=$1/tests/blender
command -v blender >/dev/null || { echo "there is no blender; ./test.sh installs it on Debian"; exit 1; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export BLENDER_USER_RESOURCES=$folder/home
mkdir "$folder/home" "$folder/files"
blender -b --factory-startup --python-exit-code 1 -P "$source/contrib/blender/install.py" -- "$zip" >"$folder/log" ||
  { cat "$folder/log"; exit 1; }
blender -b --python-exit-code 1 -P "$here/$3" -- "$4" "$folder/files"
