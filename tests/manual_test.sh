#!/usr/bin/env bash
# The manual page and the bash completion of a build.
# usage: manual_test.sh PAGE COMPLETION PELAGIC
set -euo pipefail
page=$1 completion=$2 pelagic=$3

# groff finds no error in the page, with all its warnings.
warnings=$(groff -man -ww -z "$page" 2>&1)
[ -z "$warnings" ] || { echo "$warnings"; exit 1; }

# The page has every option of every command.
page=$(MANWIDTH=100 groff -man -Tascii -P-c -rHY=0 "$page" | sed 's/.\x08//g')
count=0
for command in $("$pelagic" --help | sed -n '/^Commands:/,/^$/s/^  \([a-z]*\) .*/\1/p'); do
  grep -qF "pelagic $command [OPTIONS]" <<<"$page" || { echo "the page lacks $command"; exit 1; }
  for option in $("$pelagic" "$command" --help | grep -oE '^  (-., )?--[a-z-]+' | grep -oE -- '--[a-z-]+'); do
    grep -qE -- "(^|[ ,])$option( |,|$)" <<<"$page" || { echo "the page lacks $option of $command"; exit 1; }
    count=$((count + 1))
  done
done
[ "$count" -gt 200 ] || { echo "only $count options were found"; exit 1; }

# Completions: the words before the cursor, and what bash offers.
# shellcheck source=/dev/null
source "$completion"
cd "$(mktemp -d)"
trap 'rm -r "$PWD"' EXIT
mkdir waves
touch storm.png
expect() {
  local expected=$1
  shift
  COMP_WORDS=(pelagic "$@") COMP_CWORD=$# COMPREPLY=()
  _pelagic "$pelagic"
  [ "${COMPREPLY[*]}" = "$expected" ] || { echo "pelagic $*: expected $expected, offered ${COMPREPLY[*]}"; exit 1; }
}
expect 'export' ex
expect 'storm' info sto
expect 'storm' render --preset sto
expect '--resume --resolution' export --res
expect 'exr tif ktx2 dds' export --format ''
expect 'waves' export w
expect 'waves' export -o w
expect 'storm.png' render s
expect '' export --seed ''
echo "$count options"
