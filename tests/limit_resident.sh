#!/usr/bin/env bash
# Runs COMMAND and kills it if its resident memory exceeds MIB. A limit of the address space does
# not work under ThreadSanitizer, which maps terabytes, and ThreadSanitizer ignores
# hard_rss_limit_mb.
#
# usage: limit_resident.sh MIB COMMAND...    the command's exit code, or 125
mib=$1
most=$((mib * 1024 * 1024 / $(getconf PAGESIZE)))
shift
exec {never}<> <(:)
"$@" &
process=$!
# A process that has ended has no resident memory.
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
