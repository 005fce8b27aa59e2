#!/usr/bin/env bash
# From a fresh Debian 12 to a looping sea on disk: installs what is missing, builds, exports into out/.
set -euo pipefail
cd "$(dirname "$0")"
. cmake/dependencies.sh
pelagic_install_dependencies

echo "Building (a minute or two the first time) ..."
log=$(mktemp)
trap 'rm -f "$log"' EXIT
if ! { cmake --preset release -DPELAGIC_TESTS=OFF -DPELAGIC_BENCH=OFF -DPELAGIC_EXAMPLES=OFF && cmake --build --preset release -j "$(nproc)" --target pelagic; } >"$log" 2>&1; then
  cat "$log"
  echo "The build failed."
  exit 1
fi

# 60 seconds are nine periods of the highest waves, so the loop looks like a sea and not like a machine. The shortest wave of
# this coarse grid takes 1.6 seconds, so 4 frames a second are enough where the player blends between them.
command=(build/release/bin/pelagic export --out out --patch-size 250 --resolution 128 --loop-period 60 --loop-frames 240 --mips)
"${command[@]}"
picture=(build/release/bin/pelagic render --out out/sea.png --loop-period 60)
"${picture[@]}" ||
  echo "No picture: see above what is missing; the export needs none of it."
cat <<END

Your sea is in out/:
  displacement_0000.exr ... displacement_0239.exr   metres: red = Dx, green = height, blue = Dz
  gradient_0000.png ... gradient_0239.png           normal x, normal z, Jacobian, smoothness (and _mip1 ...)
  sea.json                                          every option, what pixels mean, a hash for each frame
Play the 240 frames at 4 a second, blended: after the last one the first follows without a seam.
  sea.png                                           a sea in that wind, with its smaller waves
They were made by:
  ${command[*]}
  ${picture[*]}
Try also:
  build/release/bin/pelagic export --out tiles          a frame of all four tiles of the default sea
  build/release/bin/pelagic info --preset storm
  build/release/bin/pelagic export --help
END
