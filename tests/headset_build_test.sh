#!/usr/bin/env bash
# Runs the line of docs/integrations/vr.md with a replacement for the NDK's toolchain file: it
# configures without GLM, oneTBB and a graphics library, and builds a library for 64-bit Arm that
# has the C interface and needs only the system's C++ library. The optimisation level is lower than
# usual, to save time.
#
# usage: headset_build_test.sh SOURCE_FOLDER CMAKE LIBCXX_FOLDER
set -euo pipefail
source=$1 cmake=$2 libcxx=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

mkdir "$work/deps"
ln -s /usr/include/xsimd /usr/include/xxhash.h "$work/deps"

# Read from the page, except for the NDK's options, so that page and test agree.
line=$(sed -n '/^    cmake -S \. -B build\/android/,/[^\\]$/p' "$source/docs/integrations/vr.md" | sed 's/\\$//' | tr '\n' ' ')
[[ $line == *-DPELAGIC_XXHASH_INCLUDE_DIR* ]] || { echo "the page has no such line any more"; exit 1; }
options=$(sed -E 's/^ *cmake -S \. -B build\/android//; s/-DCMAKE_TOOLCHAIN_FILE=[^ ]*//; s/-DANDROID_[A-Z]*=[^ ]*//g; s/\$DEPS/DEPS/g' <<<"$line")
options=${options//DEPS/"$work/deps"}
# Packages of the build machine are not those of the headset: GLM, for instance.
only_of_target=(-DCMAKE_FIND_ROOT_PATH=/usr/aarch64-linux-gnu -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY)
# shellcheck disable=SC2086
"$cmake" -S "$source" -B "$work/build" -DCMAKE_TOOLCHAIN_FILE="$source/cmake/arm64-libcxx.cmake" $options \
  -DPELAGIC_ARM64_LIBCXX_FOLDER="$libcxx" "${only_of_target[@]}" -DCMAKE_CXX_FLAGS_RELEASE=-O0 -DPELAGIC_KERNEL_OPTIMISATION=-O1 >"$work/log" 2>&1 &&
  "$cmake" --build "$work/build" --target pelagic_shared -j 2 >>"$work/log" 2>&1 || { tail -40 "$work/log"; exit 1; }

library=$work/build/capi/libpelagic_c.so
"$source/tests/headset_library_test.sh" nm "$library"
"$source/tests/c_symbols.sh" nm "$library" "$source/tests/abi/pelagic.symbols"
