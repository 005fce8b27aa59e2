#!/usr/bin/env bash
# Builds packages from a folder with the sources, in its build/, with the steps of each page.
#
# usage: build.sh SOURCE_FOLDER OUT_FOLDER PART...
#
# PELAGIC_MAINTAINER, "NAME <ADDRESS>", is the maintainer of Debian's packages, instead of a
# placeholder. PELAGIC_NDK is the folder of the Android NDK, and PELAGIC_ANDROID_OPTIONS are further
# options of CMake for it, for tests.
set -euo pipefail
source=$(realpath "$1") out=$(realpath -m "$2")
packaging=$source/packaging
mkdir -p "$out"
cd "$source"
version=$("$packaging/version.sh")
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)} PYTHONDONTWRITEBYTECODE=1
export DESTDIR=
# Packages come from the compiler and linker alone, without a cache.
from_sources=-DPELAGIC_FAST_BUILD=OFF
android_abis=(arm64-v8a x86_64)
without_extras=($from_sources -DPELAGIC_TESTS=OFF -DPELAGIC_EXAMPLES=OFF)

# usage: pack BUILD_FOLDER
pack() {
  (cd "$1" && cpack -B packages >packages.log) || { cat "$1/packages.log"; return 1; }
  find "$1/packages" -maxdepth 1 -type f -name '*pelagic*' -exec mv -t "$out" {} +
}

# usage: build_wheel PLATFORM
build_wheel() {
  PELAGIC_WHEEL_PLATFORM=$1 PYTHONPATH=python/build_backend \
    /usr/bin/python3 -c 'import sys, wheel_of_cmake; wheel_of_cmake.build_wheel(sys.argv[1])' "$out"
}

build_debian() {
  cmake --preset release -B build/debian -DCMAKE_INSTALL_PREFIX=/usr -DPELAGIC_DEBIAN=ON "${without_extras[@]}" \
    ${PELAGIC_MAINTAINER:+"-DPELAGIC_MAINTAINER=$PELAGIC_MAINTAINER"}
  cmake --build build/debian
  pack build/debian
}

# Without oneTBB, so that the library needs no other packages, and with stb, which only Debian has
# as a shared library, inside the command. Godot's library comes from the same build.
configure_linux() {
  cmake --preset release -B build/linux "${without_extras[@]}" -DPELAGIC_EXAMPLES=ON -DPELAGIC_TBB=OFF \
    -DCMAKE_SKIP_INSTALL_ALL_DEPENDENCY=ON -DCMAKE_SHARED_LINKER_FLAGS=-s \
    -DPELAGIC_STB_LIBRARY="/usr/lib/$(gcc -print-multiarch)/libstb.a"
}

build_linux() {
  configure_linux
  cmake --build build/linux --target pelagic pelagic_manual_files pelagic_static pelagic_shared pelagic_quadtree pelagic_floating pelagic_gl
  pack build/linux
}

build_godot3() {
  configure_linux
  cmake --build build/linux --target pelagic_godot3
  cp LICENSE NOTICE build/linux/godot3/addons/pelagic
  "$packaging/artefact.py" zip "$out/pelagic-godot3-$version-linux-x86_64.zip" build/linux/godot3 addons
}

build_godot4() {
  configure_linux
  cmake --build build/linux --target pelagic_godot4
  cp LICENSE NOTICE build/linux/godot4/addons/pelagic
  "$packaging/artefact.py" zip "$out/pelagic-godot4-$version-linux-x86_64.zip" build/linux/godot4 addons demo.tscn
}

build_arm64() {
  cmake --preset arm64 -B build/arm64-package "${without_extras[@]}" -DPELAGIC_TBB=OFF -DPELAGIC_TOOLS=ON -DPELAGIC_IMAGES=OFF \
    -DPELAGIC_PYTHON=ON -DCMAKE_SHARED_LINKER_FLAGS=-s
  cmake --build build/arm64-package
  pack build/arm64-package
  PELAGIC_PYTHON_PACKAGE=build/arm64-package/python/pelagic build_wheel manylinux_2_34_aarch64
}

build_windows() {
  cmake --preset windows -B build/windows-package "${without_extras[@]}"
  cmake --build build/windows-package
  pack build/windows-package
}

build_python() {
  CMAKE_ARGS="$from_sources -DPELAGIC_TBB=OFF -DCMAKE_SHARED_LINKER_FLAGS=-s" build_wheel manylinux_2_34_x86_64
}

build_blender() {
  cmake --preset python $from_sources -DPELAGIC_TBB=OFF -DCMAKE_SHARED_LINKER_FLAGS=-s
  cmake --build --preset python --target pelagic_blender
  zip=$(basename build/python/pelagic_blender-*.zip)
  "$packaging/artefact.py" zip "$out/$zip" build/python/contrib/blender pelagic_ocean
}

build_npm() {
  local preset
  for preset in web web-threads; do
    cmake --preset $preset $from_sources
    cmake --build --preset $preset --target pelagic_ocean_module
  done
  npm pack ./build/pelagic-npm --pack-destination "$out"
}

# Without oneTBB, and with hulls. x86-64 is for emulators, without the code for AVX-512.
build_android() {
  local abi libraries=()
  for abi in "${android_abis[@]}"; do
    # shellcheck disable=SC2086
    cmake --preset android -B "build/android-$abi" $from_sources -DPELAGIC_NDK="$PELAGIC_NDK" -DANDROID_ABI="$abi" \
      -DCMAKE_SHARED_LINKER_FLAGS=-s $([ "$abi" = arm64-v8a ] || echo "-DPELAGIC_ISAS=sse4_2;avx2") ${PELAGIC_ANDROID_OPTIONS:-}
    cmake --build "build/android-$abi" --target pelagic_shared
    libraries+=("$abi=build/android-$abi/capi/libpelagic_c.so")
  done
  "$packaging/android.py" "$out" "$("$packaging/android_ndk.sh" "$PELAGIC_NDK")" "${libraries[@]}"
  pack_unity
}

# Packs the libraries of the parts before it. Android's Unity package is complete only with the part unity.
pack_unity() {
  local options=()
  [ ! -d build/android-arm64-v8a ] || options+=(--android build/android-arm64-v8a/capi/libpelagic_c.so)
  [ ! -d build/android-x86_64 ] || options+=(--android-x86-64 build/android-x86_64/capi/libpelagic_c.so)
  python3 unity/pack.py --out "$out" "$@" ${options[@]+"${options[@]}"}
}

# With the libraries of the archives.
build_unity() {
  mkdir -p build/unity-package
  tar -xzf "$out/pelagic-$version-linux-x86_64.tar.gz" -C build/unity-package --strip-components=1
  unzip -qo "$out/pelagic-$version-windows-x86_64.zip" -d build/unity-package
  pack_unity --linux "build/unity-package/lib/libpelagic_c.so.$version" \
    --windows "build/unity-package/pelagic-$version-windows-x86_64/bin/pelagic.dll"
}

for part in "${@:3}"; do
  echo "== building $part"
  "build_$part"
done
