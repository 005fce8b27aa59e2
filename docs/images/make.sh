#!/usr/bin/env bash
# Generates images of docs/gallery.md. From an export: height (dark troughs,
# light crests) beside the gradient map, both tiled twice along x so that a seam would be visible.
# Then the plan of a selection. Needs Debian's openimageio-tools and librsvg2-bin.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
build/release/bin/pelagic export --out "$work" --preset rough --patch-size 300 >/dev/null
oiiotool "$work/displacement_0000.exr" --ch G,G,G --addc 2.6 --divc 5.6 -d uint8 -o "$work/height.png"
oiiotool --iconfig oiio:UnassociatedAlpha 1 "$work/gradient_0000.png" --ch R,G,B -o "$work/gradient.png"
oiiotool "$work/height.png" "$work/height.png" "$work/gradient.png" "$work/gradient.png" --mosaic 4x1 -o docs/images/sea.png
build/release/bin/pelagic quadtree --camera 10,6,20 --target 100,2,60 --svg "$work/plan.svg" >/dev/null
rsvg-convert --width 900 "$work/plan.svg" --output docs/images/quadtree.png
