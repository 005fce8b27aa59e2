#!/usr/bin/env bash
# Runs the tests, in parts that CMakePresets.json lists ("workflowPresets"):
#
#   ./test.sh           the gate: what every change must pass, on two of five other platforms that
#                       rotate with the number of commits
#   ./test.sh quick     the release build without slow tests: two minutes after the build
#   ./test.sh all       the gate on every platform, and the night's parts
#   ./test.sh soak      full sweeps, a million frames and ten minutes of each fuzzer: hours
#   ./test.sh PART...   some parts or platforms, for instance asan
#
# If a part fails, the others still run. Installs missing packages, like demo.sh.
# docs/development/testing.md has the cost of each part and describes how to run one test.
set -uo pipefail
cd "$(dirname "$0")" || exit 1
. cmake/dependencies.sh

# "PART TIER" or "PART platform PLATFORM" of each workflow, in order. Without cmake, which may not
# be installed yet.
listed=$(sed -nE 's/^ *\{"name": "([^"]+)", "displayName": "([a-z]+)( [^:]*)?: .*/\1 \2\3/p' CMakePresets.json)
# release is the same there, except for libc++
[ "$(uname -m)" != aarch64 ] || listed=$(grep -v ^arm64 <<<"$listed")
parts_of() { awk -v tier="$1" '$2 == tier { print $1 }' <<<"$listed"; }
parts_named() { awk -v name="$1" '$1 == name || $3 == name { print $1 }' <<<"$listed"; }
mapfile -t platforms < <(awk '$2 == "platform" && !seen[$3]++ { print $3 }' <<<"$listed")

if [ $# -gt 1 ]; then
  for name in "$@"; do
    case $name in quick | all | soak) echo "test.sh: $name takes no other part, given $*" >&2 && exit 2 ;; esac
  done
fi
rotated=()
case "${1:-}" in
  '')
    commits=$(git rev-list --count HEAD 2>/dev/null) || commits=0
    rotated=("${platforms[commits % ${#platforms[@]}]}" "${platforms[(commits + 1) % ${#platforms[@]}]}")
    wanted=$(parts_of gate && parts_named "${rotated[0]}" && parts_named "${rotated[1]}")
    ;;
  quick | soak) wanted=$(parts_of "$1") ;;
  all) wanted=$(parts_of gate && parts_of platform && parts_of night) ;;
  *)
    wanted=
    for name in "$@"; do
      found=$(parts_named "$name")
      [ -n "$found" ] || {
        echo "test.sh: unknown part $name, accepted: quick, all, soak, $(awk '{ print $1 }' <<<"$listed" | grep -vx quick | paste -sd' ' | sed 's/ /, /g')" >&2
        exit 2
      }
      wanted+="$found"$'\n'
    done
    ;;
esac
mapfile -t parts < <(awk 'NF && !seen[$0]++' <<<"$wanted")
packages=("${pelagic_test_packages[@]}")
[ "${parts[*]}" = quick ] || packages+=("${pelagic_gate_packages[@]}" "${pelagic_platform_packages[@]}")
! grep -qxFf <(parts_of night) <<<"$wanted" || packages+=("${pelagic_night_packages[@]}")
pelagic_install_dependencies "${packages[@]}" || exit 1

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

table=() failed_parts=() skipped=() passed=0 failed=0 all_processor_seconds=0
for part in "${parts[@]}"; do
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
  all_processor_seconds=$((all_processor_seconds + processor_seconds - before))
  table+=("$(printf '%-14s %5.1f %13.1f %8d %8d' "$part" "$(((SECONDS - started) * 10 / 60))e-1" \
    "$(((processor_seconds - before) * 10 / 60))e-1" $((of - part_failed)) "$part_failed")")
done

printf '\n%-14s %s\n' part 'minutes  CPU minutes   passed   failed'
printf '%s\n' "${table[@]}"
printf '%-14s %5.1f %13.1f %8d %8d\n' together "$((SECONDS * 10 / 60))e-1" "$((all_processor_seconds * 10 / 60))e-1" "$passed" "$failed"
[ ${#skipped[@]} -eq 0 ] || printf 'not run in %s\n' "${skipped[@]}"
[ ${#rotated[@]} -eq 0 ] || echo "platforms: ${rotated[*]} (of ${platforms[*]}, by the number of commits)"
for part in ${failed_parts[@]+"${failed_parts[@]}"}; do
  echo "failed in $part:"
  sed -n '/^The following tests FAILED:/,/^$/{/^\t/p}' "$logs/$part.log" | grep . || echo "	the build, see $logs/$part.log"
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
