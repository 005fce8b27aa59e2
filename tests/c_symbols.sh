#!/usr/bin/env bash
# What a shared library exports is what its list in tests/abi says, all of it and nothing else: the C interface, or what Godot looks for.
# A symbol that goes is a break for every application; one that comes is added to the list in the same commit.
#
# usage: c_symbols.sh NM LIBRARY LIST
set -euo pipefail
nm=$1 library=$2 list=$3
diff -u "$list" <("$nm" -D --defined-only "$library" | awk '{print $3}' | LC_ALL=C sort) ||
  { echo "what $library exports differs from $list"; exit 1; }
