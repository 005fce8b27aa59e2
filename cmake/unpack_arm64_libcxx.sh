#!/usr/bin/env bash
# Unpacks Debian's libc++ for 64-bit Arm into FOLDER, which must not exist, for arm64-libcxx.cmake.
# Install the packages for Arm of dependencies.sh first: they register the architecture with apt.
#
# usage: unpack_arm64_libcxx.sh FOLDER
set -euo pipefail
folder=$1
mkdir -p "$(dirname "$folder")"
work=$(mktemp -d "$folder.XXXXXX")
trap 'rm -rf "$work"' EXIT

packages=(libc++-14-dev libc++1-14 libc++abi-14-dev libc++abi1-14 libunwind-14-dev libunwind-14)
(cd "$work" && apt-get download -qq -o APT::Sandbox::User=root "${packages[@]/%/:arm64}") ||
  { echo "can't fetch ${packages[*]} for arm64: run apt-get update, after dpkg --add-architecture arm64"; exit 1; }
mkdir "$work/root"
for package in "$work"/*.deb; do dpkg -x "$package" "$work/root"; done
chmod 755 "$work/root"
mv -T "$work/root" "$folder"
