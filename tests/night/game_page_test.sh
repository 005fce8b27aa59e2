#!/usr/bin/env bash
# Executes the lines of docs/integrations/unity.md in order, then checks their output with
# independent readers: npm's ktx-parse and zstddec, a checker of Khronos' rules, NVIDIA's nvddsinfo,
# ffmpeg, Pillow, and `pelagic query` for heights. Exits with 77, "skipped" in ctest, if a program
# is missing.
#
# usage: game_page_test.sh PELAGIC FOLDER    FOLDER keeps npm's packages between runs
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
pelagic=$1
for program in node npm python3 ffmpeg nvddsinfo; do
  command -v "$program" >/dev/null || { echo "SKIPPED: there is no $program; ./test.sh all installs it on Debian"; exit 77; }
done
mkdir -p "$2"
cd "$2"
rm -rf sea sea_dds book
cp "$here"/../../docs/recipes/game/sample.mjs "$here"/ktx2_check.mjs .
echo {} >package.json  # npm installs here, regardless of the folders above
PATH=$(dirname "$pelagic"):$PATH

# Indented lines that begin with a program, as a reader types them.
sed -n 's/^    \(\(pelagic\|npm\|node\) .*\)$/\1/p' "$here/../../docs/integrations/unity.md" >lines
[ "$(wc -l <lines)" -eq 6 ] || { echo "unity.md has other lines than this test knows"; exit 1; }
while read -r line; do
  echo "+ $line"
  bash -c "$line" </dev/null | tee last_output
  case $line in
    *--preview)
      [ -s sea/preview.png ] || { echo "there is no sea/preview.png"; exit 1; }
      ! ls sea/*.ktx2 2>/dev/null
      ;;
    node*) cp last_output drawn ;;
  esac
done <lines

python3 "$here/ktx2_rules.py" sea/*.ktx2
node ktx2_check.mjs sea sea_dds
python3 "$here/dds_check.py" sea_dds
python3 "$here/drawn_check.py" "$pelagic" sea "$(cat drawn)"
rm -rf sea sea_dds book
