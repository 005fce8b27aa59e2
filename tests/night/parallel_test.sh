#!/usr/bin/env bash
# Runs the line of docs/render-farm.md for GNU parallel, with an export killed in the middle of its
# shard.
#
# usage: parallel_test.sh PELAGIC
set -euo pipefail
. "$(dirname "$0")/farm_page.sh"
open_page "$1"
export SLOW_SHARDS=2
kill_one() {
  wait_for 60 is_in_the_middle 2
  pkill -KILL --full "^$pelagic export .*--shard 2/8"
}
kill_one &
killer=$!
run_page 'GNU parallel' | tee log
wait "$killer" || fail 'no export was killed'
grep -q 'shard 2/8, 12 frames ([1-9][0-9]* of them kept)' log || fail 'the killed shard did not go on where it was'
run_page 'Merge and verify'
same_as_one_run
