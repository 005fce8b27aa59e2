#!/usr/bin/env bash
# Runs the tests, in tiers:
#
#   ./test.sh quick     the release build without soak, sweeps and slow images: two minutes
#                       after the build
#   ./test.sh           the tests that every change must pass
#   ./test.sh hosts     tests that need large packages of other programs: browsers, their compilers
#   ./test.sh night     tests that take hours: a long soak, full sweeps, ten minutes of each fuzzer
#   ./test.sh PART...   some parts, for instance asan; CMakePresets.json lists them
#                       ("workflowPresets"), each with its tier
#
# If a part fails, the others still run. Installs missing packages, like demo.sh. No part starts
# after PELAGIC_START_UNTIL, a time in seconds since 1970, if it is set.
# docs/development/testing.md has the cost of each part and describes how to run one test.
set -uo pipefail
cd "$(dirname "$0")" || exit 1
. cmake/dependencies.sh

tier=gate
case "${1:-}" in quick | hosts | night) tier=$1 && shift ;; esac
packages=("${pelagic_test_packages[@]}")
[ "$tier" = quick ] || packages+=("${pelagic_gate_packages[@]}")
[ "$tier" != hosts ] || packages+=("${pelagic_hosts_packages[@]}")
[ "$tier" != night ] || packages+=("${pelagic_night_packages[@]}")
pelagic_install_dependencies "${packages[@]}" || exit 1

parts=("$@")
if [ ${#parts[@]} -eq 0 ]; then
  mapfile -t parts < <(cmake --workflow --list-presets | sed -n "s/^ *\"\(.*\)\" *- $tier: .*/\1/p")
fi
# release is the same there, except for libc++
[ "$(uname -m)" != aarch64 ] || parts=("${parts[@]/#arm64*/}")

jobs=$(nproc)
export CMAKE_BUILD_PARALLEL_LEVEL=$jobs CTEST_PARALLEL_LEVEL=$jobs
logs=build/logs
mkdir -p "$logs"
# Files that root builds in the clone of another user would block that user's next run.
[ "$(id -u)" -ne 0 ] || trap 'chown -Rh --reference=. build' EXIT

# Computes the processor time of finished children in seconds, user and system. Not in a subshell,
# which has none.
count_processor_seconds() {
  times >"$logs/times"
  processor_seconds=$(awk 'NR == 2 { gsub(/[ms]/, " "); print int($1 * 60 + $2 + $3 * 60 + $4) }' "$logs/times")
}

# Prints why GoogleTest's tests were skipped, mainly instruction sets that this machine lacks, from
# logs newer than FILE.
skipped_since() {
  find build -maxdepth 4 -name LastTest.log -newer "$1" -exec awk '/: Skipped\r?$/ { getline; sub(/\r$/, ""); print }' {} +
}

table=() failed_parts=() skipped=() late=() passed=0 failed=0
for part in ${parts[@]+"${parts[@]}"}; do
  [ -n "$part" ] || continue
  if [ -n "${PELAGIC_START_UNTIL:-}" ] && [ "$(date +%s)" -gt "$PELAGIC_START_UNTIL" ]; then
    late+=("$part")
    continue
  fi
  echo "== $part"
  count_processor_seconds
  log=$logs/$part.log started=$SECONDS before=$processor_seconds
  : >"$logs/started"
  cmake --workflow --preset "$part" 2>&1 | tee "$log"
  status=${PIPESTATUS[0]}
  # "98% tests passed, 1 tests failed out of 42"
  read -r part_failed of < <(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests failed out of ([0-9]+)$/\1 \2/p' "$log" | tail -n 1) ||
    part_failed=0 of=0
  if [ "$status" -ne 0 ]; then
    failed_parts+=("$part")
    # the build failed before the tests
    [ "$part_failed" -gt 0 ] || { part_failed=1 && of=$((of + 1)); }
  fi
  while read -r why; do skipped+=("$part: $why"); done < <(
    skipped_since "$logs/started" | sort -u
    sed -nE 's/^\t *[0-9]+ - (.*) \(Skipped\)$/\1/p' "$log"
  )
  passed=$((passed + of - part_failed)) failed=$((failed + part_failed))
  count_processor_seconds
  table+=("$(printf '%-14s %5.1f %13.1f %8d %8d' "$part" "$(((SECONDS - started) * 10 / 60))e-1" \
    "$(((processor_seconds - before) * 10 / 60))e-1" $((of - part_failed)) "$part_failed")")
done

printf '\n%-14s %s\n' part 'minutes  CPU minutes   passed   failed'
printf '%s\n' ${table[@]+"${table[@]}"}
[ ${#skipped[@]} -eq 0 ] || printf 'not run in %s\n' "${skipped[@]}"
[ ${#late[@]} -eq 0 ] || echo "left out, for lack of time: ${late[*]}"
for part in ${failed_parts[@]+"${failed_parts[@]}"}; do
  echo "failed in $part:"
  sed -n '/^The following tests FAILED:/,/^$/{/^\t/p}' "$logs/$part.log" | grep . || echo "	the build, see $logs/$part.log"
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ $((passed + ${#late[@]})) -gt 0 ]
