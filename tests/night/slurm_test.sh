#!/usr/bin/env bash
# Runs docs/render-farm.md line by line on a real Slurm cluster of two nodes. One node is lost in
# the middle of two shards, with a lock. One shard is requeued, one receives its time limit signal,
# and one is cancelled and submitted again. Afterwards every file is identical to that of one run
# without shards.
#
# The test runs in a process namespace of its own, so that no process outlives it. It exits with 77,
# "skipped" in ctest, if the system does not allow that.
# usage: slurm_test.sh PELAGIC
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)

if [ "${1:-}" != --inside ]; then
  namespace=(unshare --pid --fork --mount-proc --kill-child)
  [ "$(id -u)" -eq 0 ] || namespace+=(--user --map-current-user)
  "${namespace[@]}" true || { echo 'SKIPPED: the system refuses a process namespace (unshare --pid)'; exit 77; }
  exec timeout --kill-after=10 900 "${namespace[@]}" "$here/slurm_test.sh" --inside "$@"
fi
. "$here/farm_page.sh"
. "$here/slurm_cluster.sh"
open_page "$2"
run_page 'How many shards'
start_cluster "$work/cluster"
export SLOW_SHARDS='1 2 3 4 5'

log_of() { echo "pelagic-${array}_$1.log"; }
log_says() { grep -q "$2" "$(log_of "$1")" 2>/dev/null; }
shards_on() { squeue --noheader --nodelist="$1" --states=RUNNING --format=%K; }

run_page Slurm
for shard in 1 2 3 4; do wait_for 60 is_in_the_middle "$shard"; done
read -r lost locked < <(shards_on n1 | xargs)
read -r requeued late < <(shards_on n2 | xargs)

echo "== n1 is lost with shards $lost and $locked; the lock of $locked outlives its export, as on NFS until the lease ends"
cut_off n1
for process in $(processes_on n1); do kill -KILL "$process" || true; done
flock --no-fork "waves/.sea.$locked-of-8.lock" sleep infinity &
lock_holder=$!

echo "== $requeued is requeued, the time of $late is up, 5 is cancelled"
scontrol requeue "${array}_$requeued"
scancel --signal=USR1 --batch "${array}_$late" &  # retries while the task is being requeued
wait_for 60 is_in_the_middle 5
scancel "${array}_5"

wait_for 120 log_says "$locked" 'trying again'
kill "$lock_holder"
wait_for 120 no_job_is_left
for shard in "$lost" "$locked" "$requeued" "$late"; do
  log_says "$shard" '([1-9][0-9]* of them kept)' || fail "shard $shard began again from nothing"
done
log_says "$late" 'the time is up, requeued' || fail "shard $late did not requeue itself"
[ ! -e merge.log ] || fail 'there was a merge of an array of which a shard is missing'

echo '== What is missing is named'
if pelagic merge waves >missing 2>&1; then fail 'a merge without shard 5'; fi
cat missing
grep -q -- '--shard 5/8' missing || fail 'the line that would make shard 5 is not told'
[ ! -e waves/sea.json ] || fail 'there is a sea.json of a part of the frames'
(
  mkdir here
  cp -r waves here
  cd here
  set +o pipefail
  run_page 'What is missing'
  same_as_one_run
)

run_page 'One shard again'
wait_for 120 no_job_is_left
cat merge.log
run_page 'Merge and verify'
same_as_one_run

run_page 'Frames a second' | tee figures
grep -q '^96 frames in ' figures || fail 'some frames are not accounted for'
for state in NODE_FAIL REQUEUED CANCELLED COMPLETED; do grep -q " $state" figures || fail "no run ended as $state"; done

echo '== The same of what sacct prints'
{
  echo 'JobID|State|NodeList|Start|End'
  sed -nE 's/^.* JobState=(\S+) .* StartTime=(\S+) EndTime=(\S+) NodeList=(\S+) .* ArrayJobId=(\S+) ArrayTaskId=(\S+) .*$/\5_\6|\1|\4|\2|\3/p' \
    cluster/completions | sed 's/PENDING/REQUEUED/'
} | contrib/slurm/throughput.py waves 8 "$array" "$again" | diff figures - || fail 'other figures of the same runs'
stop_cluster
