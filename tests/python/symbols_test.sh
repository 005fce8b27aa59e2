#!/usr/bin/env bash
# The module exports a single symbol, Python's entry point.
#
# usage: symbols_test.sh NM PYTHON
set -euo pipefail
module=$(cd / && "$2" -c 'import pelagic._pelagic; print(pelagic._pelagic.__file__)')
shown=$("$1" -D --defined-only --format=posix "$module" | cut -d' ' -f1)
[ "$shown" = PyInit__pelagic ] || { echo "$module shows $shown" && exit 1; }
