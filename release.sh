#!/usr/bin/env bash
# Builds the packages of the current commit into dist/, from a clean clone, and tests each of them:
#
#   ./release.sh              all parts
#   ./release.sh PART...      some: debian linux arm64 windows python blender npm godot3 godot4 android unity
#   ./release.sh --twice ...  builds them again in another folder, and compares the bytes
#   ./release.sh --ndk PATH   with the part android, which needs the Android NDK, r26 or later
#
# Needs Debian 12, and root, because some packages are tested in fresh systems. Installs missing
# packages, like test.sh. The part unity packs the libraries of linux and windows, which come before
# it, and of android. docs/packages.md describes each package.
set -euo pipefail
cd "$(dirname "$0")"
. cmake/dependencies.sh

twice= ndk= parts=()
while [ $# -gt 0 ]; do
  case $1 in
    --twice) twice=1 ;;
    --ndk)
      [ -n "${2:-}" ] || { echo "release.sh: --ndk needs a path: the folder of an Android NDK, r26 or later" >&2 && exit 2; }
      ndk=$2 && shift
      ;;
    *) parts+=("$1") ;;
  esac
  shift
done
[ ${#parts[@]} -gt 0 ] || parts=(debian linux arm64 windows python blender npm godot3 godot4 ${ndk:+android} unity)
if [[ " ${parts[*]} " == *" android "* ]]; then
  [ -n "$ndk" ] || { echo "release.sh: android needs --ndk PATH, the folder of an Android NDK, r26 or later" >&2 && exit 2; }
  packaging/android_ndk.sh "$ndk" >/dev/null || exit 2
  PELAGIC_NDK=$(realpath "$ndk")
  export PELAGIC_NDK
elif [ -n "$ndk" ]; then
  echo "release.sh: --ndk is for the part android, given ${parts[*]}" >&2 && exit 2
fi

packages=(git python3-venv)
earlier=
for part in "${parts[@]}"; do
  case $part in
    debian) packages+=(lintian debootstrap) ;;
    linux) packages+=(debootstrap) ;;
    arm64) packages+=("${pelagic_arm64_packages[@]}" unzip) ;;
    windows) packages+=("${pelagic_windows_packages[@]}" unzip) ;;
    python) packages+=(python3-venv python3-numpy) ;;
    blender) packages+=(blender) ;;
    npm)
      packages+=("${pelagic_web_packages[@]}")
      command -v npm >/dev/null || packages+=(npm)
      ;;
    godot3) packages+=(godot3-server unzip) ;;
    godot4) packages+=(unzip) ;;
    android)
      packages+=(unzip)
      [[ $earlier != *" unity "* ]] || { echo "release.sh: unity needs the part android before it" >&2 && exit 2; }
      ;;
    unity)
      packages+=(mono-mcs mono-runtime unzip)
      [[ $earlier == *" linux "* && $earlier == *" windows "* ]] || { echo "release.sh: unity needs the parts linux and windows before it" >&2 && exit 2; }
      ;;
    *) echo "release.sh: unknown part $part, accepted: debian linux arm64 windows python blender npm godot3 godot4 android unity" >&2 && exit 2 ;;
  esac
  earlier+=" $part "
done
pelagic_install_dependencies "${packages[@]}"
[ -z "$(git status --porcelain --untracked-files=no)" ] || echo "Changes that are not committed are left out."
SOURCE_DATE_EPOCH=$(git log -1 --format=%ct)
export SOURCE_DATE_EPOCH
umask 022

# usage: build_clone FOLDER OUT
build_clone() {
  rm -rf "$1"
  git clone -q --no-local . "$1"
  mkdir -p "$1/build"
  "$1/packaging/build.sh" "$1" "$2" "${parts[@]}" >"$1/build/log" 2>&1 || { tail -n 40 "$1/build/log"; exit 1; }
}

rm -rf dist build/second-dist
clone=$PWD/build/release-clone
echo "Building ${parts[*]} in $clone ..."
build_clone "$clone" dist
"$clone/packaging/test.sh" "$clone" dist "${parts[@]}"
if [ -n "$twice" ]; then
  echo "Building again ..."
  # Without ccache, which would return the first build's objects.
  CCACHE_DISABLE=1 build_clone "$PWD/build/second-release-clone" build/second-dist
  diff -r dist build/second-dist
  echo "Both builds have the same bytes."
fi
packaging/bill_of_materials.py dist "$clone"
if /usr/bin/python3 -m venv build/spdx-tools && build/spdx-tools/bin/pip install -q 'spdx-tools>=0.8' 2>/dev/null; then
  build/spdx-tools/bin/pyspdxtools -i dist/*.spdx.json
else
  echo "The bill of materials was not validated, because spdx-tools of PyPI is out of reach."
fi
(cd dist && sha256sum -- * >SHA256SUMS)
ls -l dist
