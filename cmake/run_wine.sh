#!/usr/bin/env bash
# Runs a program for Windows under wine, as a toolchain's emulator. The first call creates the
# prefix, wine's virtual machine folder; concurrent calls wait for it. Wine accepts a prefix of its
# own user only, so a prefix of another user is created again.
#
# usage: run_wine.sh PREFIX PROGRAM.exe [ARGUMENT...]
set -euo pipefail
WINEPREFIX=$(realpath -m "$1")
shift
export WINEPREFIX WINEDEBUG=-all
export WINEDLLOVERRIDES='mscoree=;mshtml=;winemenubuilder.exe='  # avoids a download and a desktop
wine=/usr/lib/wine/wine64 server=/usr/lib/wine/wineserver64  # Debian's paths, without its wrappers
[ -x "$wine" ] || wine=$(command -v wine64 || command -v wine) server=$(command -v wineserver)

mkdir -p "$(dirname "$WINEPREFIX")"
exec {lock}>"$WINEPREFIX.lock"
flock "$lock"
[ -e "$WINEPREFIX/made" ] && [ -O "$WINEPREFIX" ] || rm -rf "$WINEPREFIX"
mkdir -p "$WINEPREFIX"
# The server of Debian's wrapper ends with the last program and disconnects a program that connects
# at that moment; this one stays for a minute. Its services keep the output that they inherit, so
# they start before the program, without its output.
if "$server" -p60 >/dev/null 2>&1 </dev/null {lock}>&-; then  # no server was running
  "$wine" wineboot --init >"$WINEPREFIX.log" 2>&1 </dev/null {lock}>&-
  touch "$WINEPREFIX/made"
fi
exec {lock}>&-
exec "$wine" "$@"
