#!/usr/bin/env bash
# Generates the images of docs/gallery.md and other pages with `pelagic render`: on any machine, in
# some minutes without a GPU.
# usage: docs/images/render.sh [PELAGIC]   default build/release/bin/pelagic
set -euo pipefail
cd "$(dirname "$0")/../.."
pelagic=${1:-build/release/bin/pelagic}
image() {
  local name=$1
  shift
  "$pelagic" render --size 960x540 --out "docs/images/render_$name.png" "$@"
}
image 2m --preset moderate --light noon --camera 0,2.2,0 --target 60,0.5,25 --fov 50
image deck --preset rough --light noon --sun 150,40 --camera 0,10,0 --target 100,3,40 --fov 42 --time 4
image plane --preset rough --light noon --sun 95,40 --camera 0,420,0 --target 700,150,420 --fov 50
image dusk --preset moderate --light golden-hour --sun 48,3 --camera 0,3,0 --target 60,1.6,55 --fov 40 --time 5 --cloud-seed 9
image storm --preset beaufort-10 --clouds 0.65 --visibility 30000 --sun 190,25 --camera 0,10,0 --target 60,6,20 --fov 40 --time 7 --cloud-seed 84
image moonlight --preset moderate --light moonlight --camera 0,5,0 --target 60,6,55 --fov 50
image underwater --preset calm --water I --depth 5 --camera 0,-1.5,0 --target 20,-2.6,16 --sun 30,50 --fov 75
heights=$(mktemp --suffix=.png)
trap 'rm -f "$heights"' EXIT
docs/images/island.py "$heights"
image shore --preset calm --light noon --water I --floor "$heights" --floor-size 300 --sun 150,45 --camera -92,6,-30 --target -40,-2,22 --fov 60
# A shore.
"$pelagic" render --size 960x540 --preset moderate --light noon --water I --shore --floor "$heights" --floor-size 1000 --camera 560,150,-120 --target 60,0,10 \
  --fov 60 --sun 185,38 --time 8 --exposure-bias -0.7 --out docs/images/shore_island.png
beach=$(mktemp --suffix=.png)
trap 'rm -f "$heights" "$beach"' EXIT
docs/images/island.py "$beach" beach
"$pelagic" render --size 960x540 --preset rough --light noon --shore --floor "$beach" --floor-size 600 --camera 137,2.6,30 --target 70,0.8,-50 \
  --fov 50 --sun 330,40 --time 9 --exposure-bias 0.3 --out docs/images/shore_beach.png
image levels --preset moderate --camera -60,260,-60 --target 240,0,240 --fov 60 --quality low --wireframe

# One view in each tier of shading.
for tier in headset medium high; do
  "$pelagic" render --size 480x270 --shading "$tier" --preset moderate --light noon --camera 0,4,0 --target 60,-4,25 --fov 50 --time 6 \
    --out "docs/images/tier_$tier.png"
done

# Small water.
small() {
  local name=$1
  shift
  "$pelagic" render --size 480x270 --surface "$name" --out "docs/images/small_$name.png" "$@"
}
small lake --preset lake --light golden-hour --camera 0,1.7,0 --target 12,1.2,9 --fov 45
small coast --preset rough --camera 0,3,0 --target 20,0,10 --sun 72,30
small river --preset calm --camera 30,14,30 --target 70,0,90 --fov 50 --sun 60,35
small pond --preset calm --light noon --camera 0,1.1,0 --target 4,0.3,1.6 --fov 45

# A sea-state transition.
for time in 10 17 22 31; do
  "$pelagic" render --weather docs/images/weather.toml --time "$time" --size 560x315 --camera 0,6,0 --out "docs/images/weather_$time.png"
done

# Analytic waves and ponds.
few() {
  local name=$1
  shift
  "$pelagic" render --size 480x270 --out "docs/images/waves_$name.png" "$@"
}
few analytic --preset analytic-intense --sun 110,34 --camera 0,10,0 --target 80,2,30 --fov 40 --time 16
few pond --preset pond --light noon --camera 0,1.1,0 --target 4,-0.4,1.6 --fov 45 --time 5

# Below the surface, and across it.
below() {
  local name=$1
  shift
  "$pelagic" render --size 480x270 --out "docs/images/below_$name.png" "$@"
}
below up --preset calm --camera 0,-7,0 --target 4,0,4 --sun 45,50 --fov 100
below split --preset moderate --water I --depth 5 --time 2 --camera 0,0.077,0 --target 20,0.3,20 --sun 130,45 --clouds 0.3 --exposure-bias -0.8 --fov 75
below island --preset calm --water I --floor "$heights" --floor-size 300 --camera -160,40,0 --target 0,0,0 --sun 200,50 --fov 50

# Reflection of an application's scene.
"$pelagic" render --size 480x270 --preset beaufort-1 --camera 0,3,0 --target 30,0.5,12 --fov 40 --sun 300,28 --rock 32,12.5 --out docs/images/mirror_rock.png

# A boat that floats by the forces on its hull.
"$pelagic" render --size 960x540 --preset calm --hull examples/boat/boat.obj --mass 4400 --hull-center -0.6,0,0 --hull-thrust 9000 --time 25 --camera 16,5.5,31 --target 33,0,14 --fov 45 --exposure-bias -0.7 --out docs/images/floating.png

# One cascade of 250 m beside the default cascades, from four heights.
pair() {
  local name=$1
  shift
  for cascades in one all; do
    local side=()
    [ "$cascades" = one ] && side=(--patch-size 250)
    "$pelagic" render --size 480x270 --preset moderate --fov 50 --sun 66,26 --out "docs/images/${cascades}_$name.png" "${side[@]}" "$@"
  done
}
pair 2m --camera 0,2.6,0 --target 60,-1,25
pair 20m --camera 0,20,0 --target 100,0,40
pair 250m --camera 0,250,0 --target 400,0,160
pair 2km --camera 0,2000,0 --target 900,0,360

# A boat's wake. Needs Debian's netpbm.
wake=$(mktemp)
trap 'rm -f "$heights" "$wake"' EXIT
"$(dirname "$pelagic")/boat_wake" "$wake"
pnmtopng -compression 9 "$wake" > docs/images/wake.png
