#!/usr/bin/env bash
# From a fresh Debian 12 to a sea; installs what is missing, then builds:
#
#   ./demo.sh                              a looping sea on disk, in out/
#   ./demo.sh web [PORT] [--build-only]    the sea in a page, served on localhost until Ctrl-C
set -euo pipefail
cd "$(dirname "$0")"
. cmake/dependencies.sh

# Runs a function whose output is for nobody unless it fails.
quietly() {
  local log
  log=$(mktemp)
  trap 'rm -f "$log"' RETURN
  if ! "$@" >"$log" 2>&1; then
    cat "$log"
    echo "The build failed."
    exit 1
  fi
}

serve_page() {
  local port=0 serves=1 word
  for word in "$@"; do
    case "$word" in
      --build-only) serves= ;;
      *[!0-9]* | '') echo "demo.sh web: what is $word? A port or --build-only is accepted" && exit 2 ;;
      *) port=$word ;;
    esac
  done
  pelagic_install_dependencies "${pelagic_web_packages[@]}"
  echo "Building the page (some minutes the first time) ..."
  build() { cmake --preset web && cmake --build --preset web -j "$(nproc)" --target pelagic_page; }
  quietly build
  [ -n "$serves" ] || return 0
  echo "The sea is at this address until Ctrl-C:"
  exec node web/page/serve.mjs build/web/page "$port"
}

if [ "${1:-}" = web ]; then
  shift
  serve_page "$@"
  exit
fi
[ $# -eq 0 ] || { echo "demo.sh: what is $1? Nothing, or web, is accepted" && exit 2; }
pelagic_install_dependencies

echo "Building (a minute or two the first time) ..."
build() {
  cmake --preset release -DPELAGIC_TESTS=OFF -DPELAGIC_BENCH=OFF -DPELAGIC_EXAMPLES=OFF &&
    cmake --build --preset release -j "$(nproc)"  # libraries, too, so that cmake --install finds them
}
quietly build

# 60 seconds are nine periods of the highest waves, so the loop looks like a sea and not like a machine. The shortest wave of
# this coarse grid takes 1.6 seconds, so 4 frames a second are enough where the player blends between them.
command=(build/release/bin/pelagic export --out out --patch-size 250 --resolution 128 --loop-period 60 --loop-frames 240 --mips --overwrite)
"${command[@]}"
image=(build/release/bin/pelagic render --out out/sea.png --loop-period 60)
"${image[@]}" ||
  echo "No image: see above what is missing; the export needs none of it."
cat <<END

Your sea is in out/:
  displacement_0000.exr ... displacement_0239.exr   metres: red = Dx, green = height, blue = Dz
  gradient_0000.png ... gradient_0239.png           normal x, normal z, Jacobian, smoothness (and _mip1 ...)
  sea.json                                          every option, what pixels mean, a hash for each frame
  sea_files.json                                    a hash for each file, for --resume and pelagic verify
Play the 240 frames at 4 a second, blended: after the last one the first follows without a seam.
  sea.png                                           a sea in that wind, with its smaller waves
They were made by:
  ${command[*]}
  ${image[*]}
Try also:
  build/release/bin/pelagic export --out cascades          a frame of all four cascades of the default sea
  build/release/bin/pelagic info --preset storm
  build/release/bin/pelagic export --help
END
