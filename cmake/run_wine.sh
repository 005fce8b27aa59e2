#!/usr/bin/env bash
# Runs a program for Windows under wine, as a toolchain's emulator. The first call makes the prefix, which is wine's idea of a
# machine; others wait for it. Wine takes a prefix of its own user alone, so one that was handed to another is made anew.
#
# usage: run_wine.sh PREFIX PROGRAM.exe [ARGUMENT...]
set -euo pipefail
WINEPREFIX=$(realpath -m "$1")
export WINEPREFIX WINEDEBUG=-all
export WINEDLLOVERRIDES='mscoree=;mshtml=;winemenubuilder.exe='  # nothing that would ask for a download or a desktop
shift
wine=/usr/lib/wine/wine64  # where Debian has it, without its wrappers
[ -x "$wine" ] || wine=$(command -v wine64 || command -v wine)
if [ ! -e "$WINEPREFIX/made" ] || [ ! -O "$WINEPREFIX" ]; then
  mkdir -p "$(dirname "$WINEPREFIX")"
  exec {lock}>"$WINEPREFIX.lock"
  flock "$lock"
  if [ ! -e "$WINEPREFIX/made" ] || [ ! -O "$WINEPREFIX" ]; then
    rm -rf "$WINEPREFIX"
    "$wine" wineboot --init >"$WINEPREFIX.log" 2>&1 </dev/null {lock}>&-
    "$(dirname "$wine")/wineserver" -w {lock}>&-  # until all of it is written
    touch "$WINEPREFIX/made"
  fi
  exec {lock}>&-
fi
exec "$wine" "$@"
