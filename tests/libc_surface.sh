#!/usr/bin/env bash
# Checks that LIST has every symbol that a library needs of the C library, with an Android API level
# of 29 or less, which docs/integrations/vr.md requires. A new symbol is looked up in bionic's
# symbol maps and added to the list in the same commit.
#
# Symbols of the C++ library and of the unwinder are part of the application, from the NDK, at any
# level.
#
# usage: libc_surface.sh NM LIST LIBRARY...
set -euo pipefail
nm=$1 list=$2 highest=29
shift 2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for library in "$@"; do
  "$nm" -D --undefined-only "$library" | awk '{ sub(/@.*/, "", $NF); print $NF }' |
    awk '/^__cxa_(atexit|finalize|thread_atexit_impl)$/ || !/^(_Z|__cxa_|__gxx_personality_v0$|_Unwind_)/' |
    LC_ALL=C sort -u >"$work/used"
  [ -s "$work/used" ] || { echo "$library asks nothing of the C library: is it stripped?"; exit 1; }
  awk -v library="$library" -v highest=$highest '
    /^#/ || !NF { next }
    FILENAME == ARGV[1] { level[$1] = $2; next }
    !($1 in level) { print library " uses " $1 ", which is not in the list"; bad = 1; next }
    level[$1] + 0 > highest { print library " uses " $1 ", which Android has from API level " level[$1] " on"; bad = 1 }
    END { exit bad }' "$list" "$work/used" || bad=1
  cat "$work/used" >>"$work/all"
done
# Unused symbols must leave the list, because nothing tests them.
awk '
  FILENAME == ARGV[1] { used[$1]; next }
  /^#/ || !NF || $1 in used { next }
  { print $1 " is in the list and used by nobody"; bad = 1 }
  END { exit bad }' "$work/all" "$list" || bad=1
[ -z "${bad:-}" ]
