#!/usr/bin/env bash
# Tests pelagic.exe: files are written completely and no partial file stays, and every error is one
# line.
#
# usage: command_test.sh WORK_FOLDER PELAGIC...    the command may begin with an emulator
set -euo pipefail
work=$1 pelagic=("${@:2}")
rm -rf "$work"
mkdir -p "$work/folder"
cd "$work"

"${pelagic[@]}" quadtree --camera 10,6,20 --target 100,2,60 --svg plan.svg --obj sea.obj >figures
# overwrites the first
"${pelagic[@]}" quadtree --camera 10,6,20 --target 100,2,60 --svg plan.svg >figures
[ "$(head -c 4 plan.svg)" = "<svg" ]
[ "$(grep -c '^v ' sea.obj)" -gt 1000 ]
[ "$(find . -name '*.part' | wc -l)" -eq 0 ]
! grep -q $'\r' plan.svg sea.obj figures || { echo "a line ends as on Windows"; exit 1; }
"${pelagic[@]}" bench --seconds 0.1 --json bench.json >figures
grep -q '"cpu": "[^"]' bench.json

refused() {  # usage: refused EXIT_CODE LINE ARGUMENT...
  local code=0
  "${pelagic[@]}" "${@:3}" >said 2>&1 || code=$?
  [ "$(tr -d '\r' <said)" = "pelagic: $2" ] && [ "$code" -eq "$1" ] || { echo "$code, not $1: ${*:3}"; cat said; exit 1; }
}
for command in render view; do
  refused 2 "$command is not in builds for Windows; use Linux" $command
done
refused 2 "--points is folder, a folder, expected a CSV file of lines x,z (Is a directory)" query --points folder
refused 2 "--points is none.csv, which can't be read, expected a CSV file of lines x,z (No such file or directory)" query --points none.csv
refused 1 "can't write folder: it is a folder, expected a regular file or a free name" quadtree --svg folder
refused 1 "can't write nowhere/plan.svg: No such file or directory" quadtree --svg nowhere/plan.svg
refused 1 "can't write plan.svg/plan.svg: Not a directory" quadtree --svg plan.svg/plan.svg
refused 2 "--wind-speed -3 is out of range (0, 60] m/s, or with a unit such as 20kn, 20knots, 40km/h, 25mph, bft6" info --wind-speed -3
