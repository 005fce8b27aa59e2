#!/usr/bin/env bash
# Builds the packages for Android with a stand-in for the NDK (stand_in_ndk.sh): Debian's clang with glibc,
# NOT an NDK and not Android's C library. Tests that packaging/build.sh and its options give libraries that
# pass all checks, and that an application runs with each of them, under qemu's user mode and here.
# Both libraries are built with little optimisation: 140 seconds of processor time in all.
#
# usage: stand_in_test.sh SOURCE_FOLDER LIBCXX_FOLDER
#
# LIBCXX_FOLDER, with libc++ for 64-bit Arm, is made if it is missing.
set -euo pipefail
source=$(realpath "$1") libcxx=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
[ -d "$libcxx" ] || "$source/cmake/unpack_arm64_libcxx.sh" "$libcxx"
"$source/tests/android/stand_in_ndk.sh" "$work/ndk" "$libcxx"

mkdir "$work/tree"
tar -C "$source" --exclude=./build --exclude=./out --exclude=./dist --exclude=./.git --exclude=./shared -cf - . |
  tar -C "$work/tree" -xf -
export PELAGIC_NDK=$work/ndk SOURCE_DATE_EPOCH=1700000000
PELAGIC_ANDROID_OPTIONS="-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DPELAGIC_KERNEL_OPTIMISATION=-O1" \
  "$work/tree/packaging/build.sh" "$work/tree" "$work/dist" android >"$work/log" 2>&1 ||
  { tail -n 40 "$work/log"; exit 1; }
"$work/tree/packaging/test.sh" "$work/tree" "$work/dist" android

# The lines of the page for other systems configure the same library.
mapfile -t lines < <(sed -n '/^    cmake --preset android/,/[^\\]$/p' "$source/docs/integrations/vr.md")
[[ ${lines[*]} == *PELAGIC_XXHASH_INCLUDE_DIR* ]] || { echo "the page has no such lines any more"; exit 1; }
(cd "$work/tree" && NDK=$work/ndk DEPS=/usr/include bash -c "$(printf '%s\n' "${lines[@]}")") >"$work/log" 2>&1 ||
  { tail -n 40 "$work/log"; exit 1; }

# An application with the header and library of the prefab package. In this system, libc.so and the other
# libraries that the library needs are those of glibc.
sed -n '/^```text$/,/^```$/{/^```/!p}' "$source/docs/integrations/windows.md" >"$work/lines"
unzip -q "$work/dist"/pelagic-*-android.aar -d "$work/aar"
module=$work/aar/prefab/modules/pelagic_c
for abi in arm64-v8a x86_64; do
  folder=$work/$abi cc=(gcc) libc=/lib/x86_64-linux-gnu
  run=(env LD_LIBRARY_PATH="$folder")
  if [ $abi = arm64-v8a ]; then
    cc=(aarch64-linux-gnu-gcc) libc=/usr/aarch64-linux-gnu/lib
    run=(qemu-aarch64 -E LD_LIBRARY_PATH="$folder")
  fi
  mkdir "$folder"
  cp "$module/libs/android.$abi/libpelagic_c.so" "$folder"
  for name in c m dl; do
    "${cc[@]}" -shared -nostdlib -Wl,-soname,lib$name.so -Wl,--no-as-needed -xc /dev/null -xnone \
      "$libc/libc.so.6" "$libc/libm.so.6" -o "$folder/lib$name.so"
  done
  "${cc[@]}" "$source/examples/c_application/main.c" -I"$module/include" -o "$work/application" \
    "$folder/libpelagic_c.so" -Wl,--allow-shlib-undefined -lm
  "${run[@]}" "$work/application" | diff "$work/lines" - ||
    { echo "the application prints other lines with the library for $abi"; exit 1; }
  echo "$abi: the application prints the lines of docs/integrations/windows.md"
done
