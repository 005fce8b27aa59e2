#!/usr/bin/env bash
# Runs COMMAND and ends it when it holds more than MIB of memory: what a limit of address space can't do for programs under
# ThreadSanitizer, which map terabytes, and which take no notice of hard_rss_limit_mb.
#
# usage: limit_resident.sh MIB COMMAND...    the command's exit code, or 125
mib=$1
most=$((mib * 1024 * 1024 / $(getconf PAGESIZE)))
shift
exec {never}<> <(:)
"$@" &
process=$!
# A process that has ended holds nothing.
while read -r _ resident _ 2>/dev/null <"/proc/$process/statm" && [ "$resident" -gt 0 ]; do
  if [ "$resident" -gt "$most" ]; then
    kill -KILL "$process"
    wait "$process" 2>/dev/null
    echo "hard rss limit exhausted ($mib MiB)" >&2
    exit 125
  fi
  read -rt 0.1 -u "$never"  # a pause that starts no process
done
wait "$process"
