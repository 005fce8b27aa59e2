#!/usr/bin/env bash
# Runs every command line of docs/integrations/windows.md in a folder with the build and the sources
# at the page's paths. The applications print the lines of the page.
#
# usage: page_test.sh SOURCE_FOLDER BUILD_FOLDER
set -euo pipefail
source=$1 build=$2
page=$source/docs/integrations/windows.md
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/build"
ln -s "$build" "$work/build/windows"
ln -s "$source/cmake" "$source/examples" "$work"
printf 'x,z\n0,0\n12.5,-3\n' >"$work/buoys.csv"
cd "$work"
export DESTDIR=

sed -n 's/^    //p' "$page" >lines
[ "$(wc -l <lines)" -eq 10 ] || { echo "the page has other lines than this test knows"; exit 1; }
sed -n '/^```text$/,/^```$/{/^```/!p}' "$page" >shown
[ "$(wc -l <shown)" -eq 5 ]
while read -r line; do
  # The preset would reconfigure this build while it is tested; here it is enough that the preset
  # exists.
  [ "$line" != "cmake --preset windows && cmake --build --preset windows" ] || line="cmake --list-presets=configure -S $source"
  echo "$line"
  bash -e -c "$line" >out </dev/null || { cat out; exit 1; }
  case $line in
    cmake*--list*) grep -q '"windows"' out ;;
    *c_application.exe | *run_wine.sh*cpp_application.exe) tr -d '\r' <out | diff shown - ;;
    *pelagic.exe\ export*) [ -s waves/displacement_0001.exr ] ;;
    *pelagic.exe\ query*) [ "$(wc -l <out)" -eq 3 ] && [ -z "$(tr -dc '\r' <out)" ] || { cat out; exit 1; } ;;
  esac
done <lines
[ -e c_application_build/c_application.exe ]
cp pelagic-windows/bin/pelagic.dll c_application_build
cmake/run_wine.sh build/windows/wine-prefix c_application_build/c_application.exe | tr -d '\r' | diff shown -
