#!/usr/bin/env bash
# Builds Pelagic on a fresh Debian 12, after installing missing packages, and generates a sea:
#
#   ./demo.sh                              a looping sea on disk, in out/
#   ./demo.sh web [PORT] [--build-only]    the sea in a page, served on localhost until Ctrl-C
#   ./demo.sh web [PORT] --https           the same for a headset of the network, and a benchmark
set -euo pipefail
cd "$(dirname "$0")"
. cmake/dependencies.sh

# Runs a function and prints its output only if it fails; on a terminal, the percentage of its
# build.
quietly() {
  local log
  log=$(mktemp)
  trap 'rm -f "$log"' RETURN
  if ! "$@" 2>&1 | tee "$log" | show_percentage; then
    cat "$log"
    echo "The build failed."
    exit 1
  fi
}

show_percentage() {
  local line
  while IFS= read -r line; do
    [[ -t 1 && $line =~ ^\[\ *([0-9]+%)\] ]] && printf '\r%s' "${BASH_REMATCH[1]}"
  done
  [ ! -t 1 ] || printf '\r    \r'
}

serve_page() {
  local port=0 serves=1 https=() word
  for word in "$@"; do
    case "$word" in
      --build-only) serves= ;;
      --https) https=(--https) ;;
      *[!0-9]* | '') echo "demo.sh web: what is $word? A port, --https or --build-only is accepted" && exit 2 ;;
      *) port=$word ;;
    esac
  done
  pelagic_install_dependencies "${pelagic_web_packages[@]}"
  echo "Building the page (some minutes the first time) ..."
  build_of() { cmake --preset "$1" && cmake --build --preset "$1" -j "$(nproc)" --target "${@:2}"; }
  build() {
    if [ ${#https[@]} -eq 0 ]; then build_of web pelagic_page; else
      build_of web pelagic_page pelagic_bench_page && build_of web-threads pelagic_bench_page
    fi
  }
  quietly build
  [ -n "$serves" ] || return 0
  echo "The page is served at this address until Ctrl-C:"
  exec node web/page/serve.mjs build/web/page "$port" ${https[@]+"${https[@]}"}
}

if [ "${1:-}" = web ]; then
  shift
  serve_page "$@"
  exit
fi
[ $# -eq 0 ] || { echo "demo.sh: what is $1? Nothing, or web, is accepted" && exit 2; }
pelagic_install_dependencies

echo "Building (two or three minutes the first time) ..."
build() {
  cmake --preset release -DPELAGIC_TESTS=OFF -DPELAGIC_EXAMPLES=OFF &&
    cmake --build --preset release -j "$(nproc)"  # libraries, too, so that cmake --install works
}
quietly build

# 60 seconds are nine periods of the highest waves, so the loop is not obvious. The shortest wave of
# this coarse grid has a period of 1.6 seconds, so 4 frames a second suffice if the player
# interpolates between them.
command=(build/release/bin/pelagic export --out out --patch-size 250 --resolution 128 --loop-period 60 --loop-frames 240 --mips --overwrite)
"${command[@]}"
image=(build/release/bin/pelagic render --out out/sea.png --loop-period 60)
"${image[@]}" ||
  echo "No image was rendered, for the reason above. The export does not depend on it."
cat <<END

Your sea is in out/:
  displacement_0000.exr ... displacement_0239.exr   metres: red = Dx, green = height, blue = Dz
  gradient_0000.png ... gradient_0239.png           normal x, normal z, Jacobian, smoothness (and _mip1 ...)
  sea.json                                          every option, the meaning of pixels, a hash for each frame
  sea_files.json                                    a hash for each file, for --resume and pelagic verify
Play the 240 frames at 4 frames a second with interpolation; they loop without a seam.
  sea.png                                           a rendered sea in the same wind, with shorter waves too
These commands generated the files:
  ${command[*]}
  ${image[*]}
Try also:
  build/release/bin/pelagic export --out cascades          a frame of all four cascades of the default sea
  build/release/bin/pelagic info --preset storm
  build/release/bin/pelagic export --help
END
