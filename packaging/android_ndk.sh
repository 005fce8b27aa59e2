#!/usr/bin/env bash
# Prints the major version of the Android NDK in a folder, or fails with one line.
#
# usage: android_ndk.sh FOLDER
set -euo pipefail
ndk=$1 oldest=26
fail() { echo "release.sh: --ndk $ndk $1" >&2 && exit 2; }

[ -d "$ndk" ] || fail "is no folder"
for file in source.properties build/cmake/android.toolchain.cmake toolchains/llvm/prebuilt/linux-x86_64/bin/clang++; do
  [ -e "$ndk/$file" ] || fail "is no Android NDK for Linux: there is no $file"
done
revision=$(sed -nE 's/^Pkg\.Revision *= *([0-9]+\.[0-9A-Za-z.-]+).*/\1/p' "$ndk/source.properties")
[ -n "$revision" ] || fail "is no Android NDK: source.properties has no Pkg.Revision"
[ "${revision%%.*}" -ge $oldest ] || fail "is NDK r${revision%%.*} ($revision), accepted: r$oldest or later"
echo "${revision%%.*}"
