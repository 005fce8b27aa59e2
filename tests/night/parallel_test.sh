#!/usr/bin/env bash
# The line of docs/users/farm.md for GNU parallel, with an export killed in the middle.
# usage: parallel_test.sh PELAGIC
set -euo pipefail
. "$(dirname "$0")/farm_page.sh"
open_page "$1"
export SLOW_DISK=1
kill_one() {
  until process=$(pgrep --full --newest "^$pelagic export .*--shard"); do sleep 0.1; done
  sleep 1
  kill -KILL "$process"
}
kill_one &
run_page 'GNU parallel'
wait "$!" || fail 'no export was killed'
run_page 'Merge and verify'
same_as_one_run
