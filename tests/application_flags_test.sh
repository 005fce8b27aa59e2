#!/usr/bin/env bash
# Builds an application and Pelagic with -march=native and -ffast-math, and checks that the golden
# frames are bit-identical. Kernels are compiled at -O1 to save time; the flags would change results
# at -O1 too.
#
# usage: application_flags_test.sh SOURCE_FOLDER CMAKE CXX_COMPILER
set -euo pipefail
source=$1 cmake=$2 cxx=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The contraction flag comes last, to check that it does not override the flags that Pelagic's
# targets add.
"$cmake" -S "$source" -B "$work/build" -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS="-march=native -ffast-math -funsafe-math-optimizations -ffp-contract=fast" \
  -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DPELAGIC_KERNEL_OPTIMISATION=-O1 -DPELAGIC_TBB=OFF -DPELAGIC_TESTS=ON \
  -DPELAGIC_TOOLS=OFF -DPELAGIC_GL=OFF -DPELAGIC_EXAMPLES=OFF -DPELAGIC_BENCH=OFF >"$work/log" 2>&1 &&
  "$cmake" --build "$work/build" --target pelagic_bits_tests -j 2 >>"$work/log" 2>&1 ||
  { tail -40 "$work/log"; exit 1; }
"$work/build/bin/pelagic_bits_tests" --gtest_filter='*Golden*:*EveryInstructionSet*' >"$work/log" 2>&1 || { tail -40 "$work/log"; exit 1; }
# A filter without a match passes too, so the number of tests is checked.
grep -qE '\[  PASSED  \] [1-9][0-9]* test' "$work/log"
