#!/usr/bin/env bash
# Builds without oneTBB and runs install_test.sh on that build.
#
# usage: install_without_tbb_test.sh SOURCE_FOLDER CMAKE C_COMPILER CXX_COMPILER
set -euo pipefail
source=$1 cmake=$2 cc=$3 cxx=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$cmake" -S "$source" -B "$work/build" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O1 \
  -DPELAGIC_KERNEL_OPTIMISATION=-O1 -DPELAGIC_TBB=OFF -DPELAGIC_TESTS=OFF -DPELAGIC_TOOLS=OFF -DPELAGIC_GL=OFF \
  -DPELAGIC_EXAMPLES=OFF -DPELAGIC_BENCH=OFF >"$work/log" 2>&1 &&
  "$cmake" --build "$work/build" -j 2 >>"$work/log" 2>&1 || { tail -40 "$work/log"; exit 1; }
"$source/tests/install_test.sh" "$work/build" "$source/examples" "$cmake" "$cc" "$cxx"
if grep -rniE "tbb" "$work/build/package"/*.pc; then
  echo "an application would look for oneTBB"
  exit 1
fi
