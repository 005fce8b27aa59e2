#!/usr/bin/env bash
# Compiles the C library for macOS on Apple processors with zig of PyPI. Nothing runs it: the test checks the
# file's kind, that it needs the system's library only, and that it exports each function of pelagic.h. Zig's
# linker also exports operators of its C++ library. Exits with 77 if PyPI is out of reach.
#
# usage: macos_test.sh FOLDER
set -euo pipefail
source=$(realpath "$(dirname "$0")/../..") work=$(realpath -m "$1")
rm -rf "$work"
mkdir -p "$work"
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q 'ziglang>=0.14' >"$work/log" 2>&1 || { echo "skipped: $(tail -n 1 "$work/log")" && exit 77; }
PELAGIC_ZIG=$(echo "$work"/venv/lib/python3*/site-packages/ziglang/zig)
export PELAGIC_ZIG
cmake -S "$source" --preset macos -B "$work/build" >"$work/log" 2>&1 || { tail -n 20 "$work/log" && exit 1; }
cmake --build "$work/build" --target pelagic_shared >"$work/log" 2>&1 || { grep -A 5 "error" "$work/log" && exit 1; }
library=$work/build/capi/libpelagic_c.1.0.0.dylib
file "$library"
[[ $(file -b "$library") == "Mach-O 64-bit arm64 dynamically linked shared library"* ]]
# The first line is the library's own name.
[ "$(llvm-objdump-14 --macho --dylibs-used "$library" | tail -n +3 | awk '{print $1}')" = /usr/lib/libSystem.B.dylib ]
missing=$(llvm-nm-14 -gU "$library" | awk '{sub(/^_/, "", $3); print $3}' | sort | comm -23 <(sort "$source/tests/abi/pelagic.symbols") -)
[ -z "$missing" ] || { echo "missing: $missing" && exit 1; }
! PELAGIC_ZIG=/nowhere cmake -S "$source" --preset macos -B "$work/none" >"$work/log" 2>&1
grep -q 'PELAGIC_ZIG is "/nowhere", expected the path of the command zig' "$work/log"
