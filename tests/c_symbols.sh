#!/usr/bin/env bash
# What the shared library exports is what tests/abi/pelagic.symbols lists: the C interface, all of it and nothing else.
# A symbol that goes is a break for every host; one that comes is added to the list in the same commit.
#
# usage: c_symbols.sh NM LIBRARY LIST
set -euo pipefail
nm=$1 library=$2 list=$3
diff -u "$list" <("$nm" -D --defined-only "$library" | awk '{print $3}' | LC_ALL=C sort) ||
  { echo "the C interface differs from $list"; exit 1; }
