#!/usr/bin/env bash
# mypy accepts the package and the example in strict mode, knows the types of arrays, and rejects errors.
#
# usage: types_test.sh SOURCE_FOLDER PYTHON
set -euo pipefail
source=$1 python=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
check() { mypy --strict --python-executable "$python" --cache-dir "$work/cache" "$@"; }

check "$source/python/pelagic"
check "$source/python/examples/measured_spectrum.py"

cat >right.py <<'END'
import numpy as np
from numpy.typing import NDArray
import pelagic

def heights(sea: pelagic.Sea) -> NDArray[np.float32]:
    floor = pelagic.ShoreOptions([[-9.0, 2.0], [-8.0, 1.0]])
    rings = pelagic.RippleInput(pelagic.Ripple(amplitude_m=0.1))
    with pelagic.Ocean(sea, dynamic_waves=pelagic.DynamicWavesOptions(), shore=floor, inputs=[rings, pelagic.GerstnerInput()]) as ocean:
        boat: int = ocean.dynamic_waves.add_source(pelagic.Disturbance(shape="hull"))
        ocean.dynamic_waves.remove_source(boat)
        depths: NDArray[np.float32] = ocean.frame_at(1).shore.depth_m
        print(depths.shape, ocean.frame_at(2).dynamic_waves.hash + 1)
        bodies, hull = pelagic.Bodies(ocean, wakes=True), pelagic.Hull(np.zeros((8, 3)), [[0, 1, 2]], 90)
        body: int = bodies.add(hull, hull.at_rest(0, 0, heading_rad=1))
        bodies.step(ocean.frame_at(3), bodies.state(body).position_m[1] + bodies.loads(body)["displaced_m3"])
    with pelagic.Ocean(sea, threads=1, isa="sse4.2") as ocean:
        frame: pelagic.Frame = ocean.frame_at(1)
        halves: NDArray[np.float16] = frame.cascades[0].displacement
        hit: NDArray[np.bool_] = frame.rays([0, 9, 0], [0, -1, 0], 20)["hit"]
        print(halves.shape, hit.any(), frame.hash + 1)
        return frame.query([[0, 0]], fields=["height"])["height"]
END
check right.py

lines=('pelagic.Sea(wind_speed=9)' 'pelagic.Sea(wind_speed_mps="9")' 'pelagic.preset("rough").seed = 2' 'pelagic.Ocean(pelagic.Sea(), query=True)'
       'pelagic.Ocean(pelagic.Sea()).frame_at("now")' 'pelagic.Ocean(pelagic.Sea()).frame_at(0).query([[0, 0]], fields=["depth"])'
       'pelagic.Ocean(pelagic.Sea()).frame_at(0).query([[0, 0]])["depth"]'
       'pelagic.Disturbance(radius=2)' 'pelagic.Ocean(pelagic.Sea(), inputs=[3])' 'pelagic.Ocean(pelagic.Sea()).dynamic_waves.add_impulse(3)'
       'pelagic.Bodies(None)')
for line in "${lines[@]}"; do
  printf 'import pelagic\n%s\n' "$line" >wrong.py
  if check wrong.py >said; then echo "$line is taken" && exit 1; fi
  grep -q '^wrong.py:2: error' said || { cat said && exit 1; }
done
