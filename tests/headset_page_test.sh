#!/usr/bin/env bash
# Checks docs/integrations/vr.md: its C code compiles with the installed header, and its command
# lines run. android/stand_in_test.sh tests its build for Android.
#
# usage: headset_page_test.sh SOURCE_FOLDER PELAGIC C_COMPILER INCLUDE_FOLDER
set -euo pipefail
page=$1/docs/integrations/vr.md pelagic=$2 cc=$3 include=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

{
  echo '#include <pelagic/pelagic.h>'
  echo 'pelagic_status make(pelagic_executor** executor) {'
  sed -n '/^```c$/,/^```$/{/^```/!p}' "$page"
  echo 'return pelagic_executor_create(&options, executor); }'
} >"$work/page.c"
grep -q cpu_mask "$work/page.c" || { echo "the page has no such code any more"; exit 1; }
"$cc" -std=c99 -Wall -Wextra -pedantic -Werror -I"$include" -fsyntax-only "$work/page.c"

mapfile -t lines < <(sed -n 's/^    build\/release\/bin\/pelagic //p' "$page")
[ "${#lines[@]}" -ge 2 ] || { echo "the page has no such lines any more"; exit 1; }
for line in "${lines[@]}"; do
  [[ $line != bench* ]] || line+=" --seconds 0.1"
  read -ra words <<<"$line"
  "$pelagic" "${words[@]}" >"$work/printed"
  [ -s "$work/printed" ] || { echo "pelagic $line prints nothing"; exit 1; }
done
