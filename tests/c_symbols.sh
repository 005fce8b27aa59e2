#!/usr/bin/env bash
# Checks that a shared library exports exactly the symbols of its list in tests/abi: the C
# interface, or the symbols that Godot loads. A removed symbol breaks applications; a new symbol is
# added to the list in the same commit.
#
# usage: c_symbols.sh NM LIBRARY LIST
set -euo pipefail
nm=$1 library=$2 list=$3
diff -u "$list" <("$nm" -D --defined-only "$library" | awk '{print $3}' | LC_ALL=C sort) ||
  { echo "what $library exports differs from $list"; exit 1; }
