#!/usr/bin/env bash
# Checks that a library is for 64-bit Arm, and that its C++ library is libc++, as the NDK's.
#
# usage: headset_library_test.sh NM LIBRARY
set -euo pipefail
[ "$(od -An -j18 -N2 -tu2 "$2" | tr -d ' ')" = 183 ] || { echo "$2 is not for 64-bit Arm"; exit 1; }
symbols=$("$1" -D "$2")
grep -q 'U _ZNSt3__1' <<<"$symbols" || { echo "$2 was not built with libc++"; exit 1; }
