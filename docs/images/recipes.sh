#!/usr/bin/env bash
# Generates the images of docs/export.md: the same sea in Blender, three.js and Godot, as in
# the nightly tests.
# usage: docs/images/recipes.sh [PELAGIC]   default build/release/bin/pelagic
set -euo pipefail
cd "$(dirname "$0")/../.."
pelagic=$(realpath "${1:-build/release/bin/pelagic}")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
for recipe in blender three godot; do
  tests/night/recipe_test.sh "$recipe" "$pelagic" "$work"
  cp "$work/$recipe.png" "docs/images/recipe_$recipe.png"
done
