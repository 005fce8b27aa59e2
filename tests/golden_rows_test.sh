#!/usr/bin/env bash
# Checks that `pelagic query` prints the rows of tests/golden/query, byte for byte, on every
# instruction set of this processor, and that `pelagic info` prints the golden hash. The rows were
# written on Linux.
#
# usage: golden_rows_test.sh GOLDEN_FOLDER WORK_FOLDER PELAGIC...
#        golden_rows_test.sh --write GOLDEN_FOLDER PELAGIC...
# The command may begin with an emulator. --write generates the rows again, after a change of the
# sea's reproducible values.
set -euo pipefail
seas=(
  "default.csv       points.csv --wind-speed 9 --time 12.5 --interpolation linear"
  "storm.csv         points.csv --preset storm --foam --time 33.3 --interpolation linear"
  "pond.csv          points.csv --preset pond --time 3 --interpolation linear"
  "analytic.csv      points.csv --preset analytic-intense --time 3.25 --interpolation linear"
  "default_cubic.csv points.csv --wind-speed 9 --time 12.5"
  "pond_cubic.csv    points.csv --preset pond --time 3 --interpolation cubic"
  "velocities.csv    points.csv --wind-speed 9 --time 12.5 --velocities water"
  "footprint.csv     points.csv --wind-speed 9 --time 12.5 --footprint 20"
  "water.csv         points_below.csv --wind-speed 9 --time 12.5"
  "water_linear.csv  points_below.csv --preset storm --depth 30 --time 33.3 --interpolation linear"
  "water_long.csv    points_below.csv --wind-speed 9 --depth 30 --time 12.5 --footprint 12"
  "water_exact.csv   points_below.csv --wind-speed 9 --depth 30 --time 12.5 --footprint 12 --interpolation exact"
)

if [ "$1" = --write ]; then
  for sea in "${seas[@]}"; do
    read -ra words <<<"$sea"
    "${@:3}" query --points "$2/query/${words[1]}" "${words[@]:2}" >"$2/query/${words[0]}"
  done
  exit
fi
golden=$1 work=$2 pelagic=("${@:3}")
mkdir -p "$work"

info=$("${pelagic[@]}" info --json | tr -d '\r\n "')
read -ra isas <<<"$(sed -E 's/.*isas_here:\[([^]]*)\].*/\1/; s/,/ /g' <<<"$info")"
[ ${#isas[@]} -gt 0 ]
for isa in "${isas[@]}"; do
  for sea in "${seas[@]}"; do
    read -ra words <<<"$sea"
    "${pelagic[@]}" query --isa "$isa" --points "$golden/query/${words[1]}" "${words[@]:2}" >"$work/rows.csv"
    cmp "$golden/query/${words[0]}" "$work/rows.csv" || { echo "$isa: $sea"; diff "$golden/query/${words[0]}" "$work/rows.csv"; exit 1; }
  done
  expected=$(sed -n 's/^default@0 //p' "$golden/hashes.txt")
  said=$("${pelagic[@]}" info --isa "$isa" --json)
  grep -qF "\"hash\": \"$expected\"" <<<"$said" || { echo "$isa: info has not the hash $expected"; exit 1; }
done
# Also from standard input, which is read as raw bytes.
"${pelagic[@]}" query --wind-speed 9 --time 12.5 --points - <"$golden/query/points.csv" | cmp "$golden/query/default_cubic.csv" -
echo "the golden rows on ${isas[*]}"
