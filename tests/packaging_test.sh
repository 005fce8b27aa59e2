#!/usr/bin/env bash
# The test of Debian's packages fails if any of its commands in the fresh system fails. Programs that
# it needs are replaced: `unshare`, which runs these commands, fails at one call after the other.
#
# usage: packaging_test.sh SOURCE_FOLDER
set -euo pipefail
source=$(realpath "$1")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work"/{source/packaging,dist,bin,base/root,base/etc}
cp -r "$source"/{docs,examples,CMakeLists.txt} "$work/source"
cp -r "$source"/packaging/{test.sh,files} "$work/source/packaging"
touch "$work"/dist/{libpelagic1_1,libpelagic-dev_1,pelagic_1}.deb

cat >"$work/bin/unshare" <<'END'
#!/bin/sh
count=$(($(cat "$WORK/count") + 1))
echo "$count" >"$WORK/count"
[ "$count" -ne "$FAILING" ] || { echo "unshare: call $count fails" >&2; exit 1; }
case "$*" in *c_application*) cat "$WORK/lines" ;; esac
END
printf '#!/bin/sh\n' >"$work/bin/lintian"
cp "$work/bin/lintian" "$work/source/packaging/artefact.py"
cp "$work/bin/lintian" "$work/source/packaging/libraries.py"
printf '#!/bin/sh\necho 1.0.0\n' >"$work/source/packaging/version.sh"
chmod +x "$work"/bin/* "$work"/source/packaging/*.{py,sh}
sed -n '/^```text$/,/^```$/{/^```/!p}' "$source/docs/integrations/windows.md" >"$work/lines"

# usage: run FAILING   tests the packages, with a failure at that call
run() {
  echo 0 >"$work/count"
  WORK=$work FAILING=$1 PATH=$work/bin:$PATH PELAGIC_DEBIAN_BASE=$work/base "$work/source/packaging/test.sh" "$work/source" "$work/dist" debian \
    >"$work/log" 2>&1
}
run 0 || { cat "$work/log"; echo "it fails without a failure"; exit 1; }
calls=$(cat "$work/count")
[ "$calls" -ge 7 ] || { echo "only $calls calls"; exit 1; }
for failing in $(seq "$calls"); do
  if run "$failing"; then
    echo "the test passes although call $failing in its system fails"
    exit 1
  fi
done
