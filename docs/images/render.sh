#!/usr/bin/env bash
# Makes the README's pictures of the sea with `pelagic render`: on any machine, in some minutes without a GPU.
# usage: docs/images/render.sh [PELAGIC]   default build/release/bin/pelagic
set -euo pipefail
cd "$(dirname "$0")/../.."
pelagic=${1:-build/release/bin/pelagic}
picture() {
  local name=$1
  shift
  "$pelagic" render --size 960x540 --out "docs/images/render_$name.png" "$@"
}
picture calm --preset calm --camera 0,2.2,0 --target 60,-1,25 --fov 50 --sun 72,30
picture moderate --preset moderate --camera 0,7,0 --target 100,-2,40 --fov 50 --sun 66,26
picture storm --preset storm --camera 0,7,0 --target 60,3,12 --fov 50 --time 7 --sun 105,28
picture close --preset rough --camera 0,3.2,0 --target 12,1.2,5 --fov 50 --time 3 --sun 75,30
picture above --preset rough --camera 0,420,0 --target 420,0,160 --fov 55 --sun 110,42
picture levels --preset moderate --camera -60,260,-60 --target 240,0,240 --fov 60 --quality low --wireframe

# Small water.
small() {
  local name=$1
  shift
  "$pelagic" render --size 480x270 --surface "$name" --out "docs/images/small_$name.png" "$@"
}
small lake --preset lake --camera 0,1.7,0 --target 12,0,5 --fov 45 --sun 72,30
small coast --preset rough --camera 0,3,0 --target 20,0,10 --sun 72,30
small river --preset calm --camera 30,14,30 --target 70,0,90 --fov 50 --sun 60,35
small pond --preset calm --camera 0,1.1,0 --target 4,0,1.6 --fov 45 --sun 72,30

# Below the surface, and where it ends.
below() {
  local name=$1
  shift
  "$pelagic" render --size 480x270 --out "docs/images/below_$name.png" "$@"
}
heights=$(mktemp --suffix=.png)
trap 'rm -f "$heights"' EXIT
docs/images/island.py "$heights"
below ahead --preset calm --water I --depth 5 --camera 0,-1.5,0 --target 20,-3,16 --sun 20,60 --fov 80
below up --preset calm --camera 0,-7,0 --target 4,0,4 --sun 45,50 --fov 100
below split --preset moderate --water I --depth 8 --time 2 --camera 0,0.077,0 --target 20,0.3,20 --sun 60,45 --fov 75
below shore --preset calm --water I --floor "$heights" --floor-size 300 --camera -86,5,-18 --target -50,-2,20 --sun 150,45 --fov 60
below island --preset calm --water I --floor "$heights" --floor-size 300 --camera -160,40,0 --target 0,0,0 --sun 200,50 --fov 50

# What a host draws, mirrored.
"$pelagic" render --size 480x270 --preset beaufort-1 --camera 0,3,0 --target 30,0.5,12 --fov 40 --sun 300,28 --rock 32,12.5 --out docs/images/mirror_rock.png

# One tile of 250 m beside the default tiles, from four heights.
pair() {
  local name=$1
  shift
  for tiles in one all; do
    local side=()
    [ "$tiles" = one ] && side=(--patch-size 250)
    "$pelagic" render --size 480x270 --preset moderate --fov 50 --sun 66,26 --out "docs/images/${tiles}_$name.png" "${side[@]}" "$@"
  done
}
pair 2m --camera 0,2.6,0 --target 60,-1,25
pair 20m --camera 0,20,0 --target 100,0,40
pair 250m --camera 0,250,0 --target 400,0,160
pair 2km --camera 0,2000,0 --target 900,0,360
