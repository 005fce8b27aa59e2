#!/usr/bin/env bash
# Compares SeaView in headless Chromium with native images.
# usage: view_test.sh MODULE_FOLDER VIEW_IMAGE FOLDER
# MODULE_FOLDER has pelagic_view.js. Images and npm's packages remain in FOLDER.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
for program in chromium node npm; do
  command -v "$program" >/dev/null || { echo "there is no $program; ./test.sh installs it on Debian"; exit 1; }
done
[ -f "$1/pelagic_view.wasm" ] || { echo "there is no $1/pelagic_view.wasm; ./test.sh wasm builds it"; exit 1; }
mkdir -p "$3/page"
cd "$3"
cp "$1"/pelagic_view.* "$here"/../../web/page/*.js page/
cp "$here"/view_page.* "$here"/documented.html "$here"/package.json .
# The example under that heading.
sed -n "/^## In a headset's browser/,/^## /{/^\`\`\`js/,/^\`\`\`$/{/^\`\`\`/!p}}" "$here/../../docs/integrations/web.md" >page/documented.js
[ -d node_modules/iwer ] || npm install --no-audit --no-fund --no-save >npm.log 2>&1 || { cat npm.log; exit 1; }
exec node "$here/view_test.mjs" "$2" "$here/../../web/page/serve.mjs"
