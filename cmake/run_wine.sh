#!/usr/bin/env bash
# Runs a program for Windows under wine, as a toolchain's emulator. The first call makes the prefix, which is wine's idea of a
# machine; others wait for it. Wine takes a prefix of its own user alone, so one that was handed to another is made anew.
#
# usage: run_wine.sh PREFIX PROGRAM.exe [ARGUMENT...]
set -euo pipefail
WINEPREFIX=$(realpath -m "$1")
shift
export WINEPREFIX WINEDEBUG=-all
export WINEDLLOVERRIDES='mscoree=;mshtml=;winemenubuilder.exe='  # nothing that would ask for a download or a desktop
wine=/usr/lib/wine/wine64 server=/usr/lib/wine/wineserver64  # where Debian has them, without its wrappers
[ -x "$wine" ] || wine=$(command -v wine64 || command -v wine) server=$(command -v wineserver)

mkdir -p "$(dirname "$WINEPREFIX")"
exec {lock}>"$WINEPREFIX.lock"
flock "$lock"
[ -e "$WINEPREFIX/made" ] && [ -O "$WINEPREFIX" ] || rm -rf "$WINEPREFIX"
mkdir -p "$WINEPREFIX"
# A server of Debian's wrapper ends with the last program, and cuts off one that connects at that moment; this one stays a minute.
# Its services hold on to the output that they inherit, so they begin before the program does, with none of its.
if "$server" -p60 >/dev/null 2>&1 </dev/null {lock}>&-; then  # none was there
  "$wine" wineboot --init >"$WINEPREFIX.log" 2>&1 </dev/null {lock}>&-
  touch "$WINEPREFIX/made"
fi
exec {lock}>&-
exec "$wine" "$@"
