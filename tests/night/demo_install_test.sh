#!/usr/bin/env bash
# Runs ./demo.sh in a fresh copy of the tree, then cmake --install on its build, and checks that
# everything is installed and runs.
#
# usage: demo_install_test.sh SOURCE_FOLDER CMAKE
set -euo pipefail
source=$1 cmake=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export DESTDIR=

mkdir "$work/tree"
tar -C "$source" --exclude=./build --exclude=./out --exclude=./.git --exclude=./shared -cf - . | tar -C "$work/tree" -xf -
cd "$work/tree"
PELAGIC_SKIP_SETUP=1 ./demo.sh
"$cmake" --install build/release --prefix "$work/prefix" >/dev/null
"$work/prefix/bin/pelagic" --version
for file in libpelagic_c.so libpelagic.a libpelagic_floating.a libpelagic_quadtree.a; do
  find "$work/prefix" -name "$file" | grep . || { echo "$file is missing"; exit 1; }
done
