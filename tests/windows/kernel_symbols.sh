#!/usr/bin/env bash
# tests/kernel_symbols.sh for objects of Windows, whose symbol tables have no weak symbols. Code
# that several objects share is in a section of its own, ".text$NAME", of which the linker takes
# any.
#
# usage: kernel_symbols.sh OBJDUMP CXXFILT ARCH OBJECT...
set -euo pipefail
objdump=$1 cxxfilt=$2 arch=$3
shift 3
# zzz: the compiler's name
symbols=$("$objdump" -hw "$@" | awk '$2 ~ /^\.(text|data|rdata|bss)\$/ {sub(/^[^$]*\$/, "", $2); if ($2 != "zzz") print $2}' | "$cxxfilt")
[ "$(grep -c "xsimd::$arch\b" <<<"$symbols")" -gt 0 ] || { echo "no kernels of $arch in $*"; exit 1; }
leaks=$(grep -v "xsimd::$arch\b" <<<"$symbols" || true)
if [ -n "$leaks" ]; then
  echo "Sections for everyone that do not name $arch:"
  echo "$leaks"
  exit 1
fi
