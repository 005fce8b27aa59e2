#!/usr/bin/env bash
# Installs the add-on from its zip as docs/integrations/blender.md describes, and runs a test in
# Blender, with a temporary home and folder.
#
# It uses the newest zip in SOURCE_FOLDER/build/python.
#
# usage: run_blender.sh SOURCE_FOLDER TEST.py PELAGIC
set -euo pipefail
source=$1 here=$1/tests/blender
command -v blender >/dev/null || { echo "there is no blender; ./test.sh hosts installs it on Debian"; exit 1; }
zip=$(ls -t "$source"/build/python/pelagic_blender-*.zip | head -n 1)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
export BLENDER_USER_RESOURCES=$folder/home
mkdir "$folder/home" "$folder/files"
blender -b --factory-startup --python-exit-code 1 -P "$source/contrib/blender/install.py" -- "$zip" >"$folder/log" ||
  { cat "$folder/log"; exit 1; }
blender -b --python-exit-code 1 -P "$here/$2" -- "$3" "$folder/files"
