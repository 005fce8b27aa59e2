# Sourced by the tests of docs/render-farm.md: runs the page's lines in a temporary folder, for a
# small shot.
#
#   open_page PELAGIC   changes to a new folder, removed at the end, in which `pelagic` and
#                       contrib/ have the page's paths
#   run_page HEADING    runs the lines of a section in this shell, so that its variables stay
#   is_in_the_middle SHARD   true if its journal in waves/ has some frames
#   wait_for SECONDS COMMAND...   waits until the command succeeds
#   same_as_one_run     checks that the merged export in waves/ has the same files as the export
#                       in one/, byte for byte, and no others
#
# The first export of each shard in SLOW_SHARDS writes to a disk on which every fdatasync takes a
# quarter of a second. Its 12 frames take half a minute, enough to interrupt it. (strace can delay
# calls too, but loses threads that receive a signal meanwhile.)
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
page=$root/docs/render-farm.md
# 96 frames of 64 texels in 8 shards.
small='s/\b1440\b/96/; s/\b1024\b/64/; s/\b40\b/8/g'

fail() { echo "FAILED: $*"; exit 1; }

open_page() {
  pelagic=$(realpath "$1")
  work=$(mktemp -d)
  trap close_page EXIT
  cd "$work"
  ln -s "$root/contrib" .
  mkdir bin
  cat >bin/pelagic <<EOF
#!/bin/sh
for shard in \${SLOW_SHARDS:-}; do
  case "\$* " in "export "*" --shard \$shard/8 "*)
    ! mkdir "$work/slow.\$shard" 2>/dev/null || export LD_PRELOAD="$work/slow_disk.so" ;;
  esac
done
exec '$pelagic' "\$@"
EOF
  chmod +x bin/pelagic
  g++ -shared -fPIC -o slow_disk.so "$root/tests/night/slow_disk.cpp"
  PATH=$work/bin:$PATH
  sed -n '/^```toml$/,/^```$/{/^```/!p}' "$page" | sed "$small" >shot.toml
  [ -s shot.toml ] || fail "the page has no shot.toml"
  run_page 'The shot'
}

close_page() {
  local status=$?
  [ "$status" -eq 0 ] || find "$work" -name '*.log' -exec tail -n 20 {} +
  rm -rf "$work"
  exit "$status"
}

run_page() {
  local lines
  lines=$(sed -n "/^## $1\$/,/^## /s/^    //p" "$page" | sed "$small")
  [ -n "$lines" ] || fail "the page has no lines under $1"
  echo "== $1" >&2
  eval "$lines"
}

is_in_the_middle() { [ "$(cat "waves/.pelagic-export.$1-of-8.jsonl" 2>/dev/null | wc -l)" -ge 3 ]; }

wait_for() {
  local end=$((SECONDS + $1))
  shift
  until "$@"; do
    [ "$SECONDS" -lt "$end" ] || { echo "FAILED: waited in vain for: $*" >&2; return 1; }
    sleep 0.1
  done
}

same_as_one_run() {
  diff -r "$work/one" waves || fail 'the shards and one run differ'
  [ "$(ls "$work/one" | wc -l)" -gt 96 ] || fail 'there is no export in one/'
}
