#!/usr/bin/env bash
# Tests the page in headless Chromium, or by another script of this folder.
# usage: page_test.sh PAGE_FOLDER PELAGIC FOLDER [SCRIPT]
# npm's packages remain in FOLDER.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
for program in chromium node npm; do
  command -v "$program" >/dev/null || { echo "there is no $program; ./test.sh installs it on Debian"; exit 1; }
done
[ -f "$1/main.js" ] || { echo "there is no $1/main.js; ./test.sh wasm builds it"; exit 1; }
page=$(realpath "$1") pelagic=$(realpath "$2")
mkdir -p "$3"
cd "$3"
cp "$here/package.json" .
[ -d node_modules/puppeteer-core ] || npm install --no-audit --no-fund --no-save >npm.log 2>&1 || { cat npm.log; exit 1; }
exec node "$here/${4:-page_test.mjs}" "$page" "$pelagic"
