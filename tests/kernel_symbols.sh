#!/usr/bin/env bash
# An inline function in an AVX-512 object may become the program's only copy of it, and crash on
# every other CPU. So each weak symbol of a kernel object must name its instruction set.
#
# usage: kernel_symbols.sh NM ARCH OBJECT...
set -euo pipefail
nm=$1 arch=$2
shift 2
symbols=$("$nm" -C --defined-only "$@")
[ "$(grep -c " W .*xsimd::$arch\b" <<<"$symbols")" -gt 0 ] || { echo "no kernels of $arch in $*"; exit 1; }
leaks=$(grep -E " [WVu] " <<<"$symbols" | grep -v "xsimd::$arch\b" || true)
if [ -n "$leaks" ]; then
  echo "Weak symbols that do not name $arch:"
  echo "$leaks"
  exit 1
fi
