#!/usr/bin/env bash
# What a library asks of the C library is in LIST, with an Android API level of 29 or less: docs/users/headset.md promises to run
# there. A new symbol is looked up in bionic's own symbol maps and added to the list in the same commit.
#
# Names of the C++ library and of the unwinder come with the app, from the NDK, whatever the level.
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
# What nobody uses any more would stand for a promise that nobody tests.
awk '
  FILENAME == ARGV[1] { used[$1]; next }
  /^#/ || !NF || $1 in used { next }
  { print $1 " is in the list and used by nobody"; bad = 1 }
  END { exit bad }' "$work/all" "$list" || bad=1
[ -z "${bad:-}" ]
