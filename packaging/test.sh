#!/usr/bin/env bash
# Tests packages: compares their files with the lists in files/, installs each in an empty folder or
# a fresh Debian system, and runs the first example of its page.
#
# usage: test.sh SOURCE_FOLDER DIST_FOLDER PART...
set -euo pipefail
source=$(realpath "$1") dist=$(realpath "$2")
packaging=$source/packaging
version=$("$packaging/version.sh")
soversion=${version%%.*}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export DESTDIR= PYTHONDONTWRITEBYTECODE=1
newest_glibc=$(sed -nE 's/.*glibc ([0-9.]+[0-9]).*/\1/p' "$source/docs/packages.md" | head -n 1)

# usage: check LIST ARTEFACT
check() {
  [ -e "$2" ] || { echo "there is no $2"; return 1; }
  "$packaging/artefact.py" check "$packaging/files/$1.txt" "$version" "$soversion" "$source" "$2"
  "$packaging/libraries.py" "$2"
}

# Prints the first block of a language on a page.
first_block() { sed -n "/^\`\`\`$1\$/,/^\`\`\`\$/{/^\`\`\`\$/q;/^\`\`\`/!p}" "$source/docs/$2"; }

# The lines of the example applications.
first_block text integrations/windows.md >"$work/application_lines"

# Prints a command's output only if it fails.
quietly() { "$@" >"$work/log" 2>&1 || { tail -n 40 "$work/log"; return 1; }; }

# usage: in_root ROOT COMMAND   runs a shell command in a Debian system, in processes of its own
in_root() {
  unshare --mount --pid --fork env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C DEBIAN_FRONTEND=noninteractive \
    chroot "$1" sh -c "mount -t proc proc /proc && cd /root && $2"
}

# usage: make_root NAME   a fresh Debian 12 with nothing but its base, in $work/NAME
#
# PELAGIC_DEBIAN_BASE names a folder with such a base, if there is one already.
make_root() {
  local base=${PELAGIC_DEBIAN_BASE:-$work/base}
  [ -d "$base" ] || quietly debootstrap --variant=minbase bookworm "$base" "${PELAGIC_MIRROR:-http://deb.debian.org/debian}"
  cp -a "$base" "$work/$1"
  cp /etc/resolv.conf "$work/$1/etc"
  cp -r "$source/examples" "$work/application_lines" "$work/$1/root"
}

test_debian() {
  local root=$work/debian_root install="apt-get install -y -qq --no-install-recommends"
  lintian --allow-root --fail-on error --tag-display-limit 0 "$dist"/*.deb
  check debian_library "$(echo "$dist/libpelagic$soversion"_*.deb)"
  check debian_development "$(echo "$dist"/libpelagic-dev_*.deb)"
  check debian_tools "$(echo "$dist"/pelagic_*.deb)"
  "$packaging/artefact.py" glibc 2.36 "$dist"/*.deb

  make_root debian_root
  cp "$dist"/*.deb "$root/root"
  quietly in_root "$root" "$install ./libpelagic[0-9]*.deb"
  in_root "$root" "ldconfig -p | grep -q 'libpelagic_c.so.$soversion '"
  in_root "$root" "dpkg-query -W" >"$work/packages"
  ! grep -E 'openimageio|openexr|glfw' "$work/packages" || { echo "the library needs packages of the command"; return 1; }
  quietly in_root "$root" "$install ./libpelagic-dev_*.deb gcc libc6-dev pkg-config"
  in_root "$root" 'cc examples/c_application/main.c -o main $(pkg-config --cflags --libs pelagic_c) && ./main' | diff "$work/application_lines" -
  quietly in_root "$root" "$install ./pelagic_*.deb"
  in_root "$root" "pelagic export --out waves --resolution 64 --frames 2 && pelagic verify waves"
  in_root "$root" "test -s waves/displacement_0001.exr && test -s /usr/share/bash-completion/completions/pelagic"
}

# Builds the C application with the shared library of an archive, and runs it and the command.
#
# usage: test_archive FOLDER C_COMPILER [EMULATOR...]
test_archive() {
  local folder=$1 cc=$2 run=("${@:3}")
  "$cc" "$source/examples/c_application/main.c" -o "$work/application.exe" -I"$folder/include" -L"$folder/lib" -lpelagic_c
  [ ! -e "$folder/bin/pelagic.dll" ] || cp "$folder/bin/pelagic.dll" "$work"
  export LD_LIBRARY_PATH=$folder/lib
  ${run[@]+"${run[@]}"} "$work/application.exe" | tr -d '\r' | diff "$work/application_lines" -
  quietly "$source/tests/golden_rows_test.sh" "$source/tests/golden" "$work/rows" ${run[@]+"${run[@]}"} "$(find "$folder/bin" -name pelagic -o -name pelagic.exe)"
  unset LD_LIBRARY_PATH
}

test_linux() {
  local name=pelagic-$version-linux-x86_64
  check linux "$dist/$name.tar.gz"
  "$packaging/artefact.py" glibc "$newest_glibc" "$dist/$name.tar.gz"
  tar -xzf "$dist/$name.tar.gz" -C "$work"
  test_archive "$work/$name" cc
  # A prefix for find_package, whose application is that of docs/getting-started.md.
  mkdir "$work/application"
  first_block cmake getting-started.md >"$work/application/CMakeLists.txt"
  first_block cpp getting-started.md >"$work/application/main.cpp"
  (cd "$work/application" && quietly cmake -S . -B build -DCMAKE_PREFIX_PATH="$work/$name" && quietly cmake --build build)
  [ "$("$work/application/build/cpp_application" | grep -c 'half floats to upload, side')" -eq 20 ]
  # A system with the libraries of the command only.
  make_root linux_root
  tar -xzf "$dist/$name.tar.gz" -C "$work/linux_root/opt"
  quietly in_root "$work/linux_root" "apt-get install -y -qq --no-install-recommends libglfw3 libzstd1"
  in_root "$work/linux_root" "/opt/$name/bin/pelagic info --preset moderate" | grep '^Waves  *Hs 2.21 m expected' >/dev/null
  if in_root "$work/linux_root" "/opt/$name/bin/pelagic export --out waves" >"$work/log" 2>&1; then
    echo "export works without OpenEXR and OpenImageIO" && return 1
  fi
  [ "$(wc -l <"$work/log")" -eq 1 ] && grep -q "^pelagic: can't load " "$work/log" || { cat "$work/log"; return 1; }
}

test_arm64() {
  local name=pelagic-$version-linux-arm64
  check arm64 "$dist/$name.tar.gz"
  "$packaging/artefact.py" glibc "$newest_glibc" "$dist/$name.tar.gz"
  tar -xzf "$dist/$name.tar.gz" -C "$work"
  test_archive "$work/$name" aarch64-linux-gnu-gcc qemu-aarch64
  test_wheel aarch64
  # With Debian's Python for Arm, unpacked beside this system's.
  local root=$work/arm64_root package
  for package in python3.11-minimal libpython3.11-minimal libpython3.11-stdlib python3-numpy libblas3 liblapack3 libgfortran5 \
    libc6 libgcc-s1 libstdc++6 libexpat1 zlib1g libffi8; do
    (cd "$work" && quietly apt-get download "$package:arm64" && dpkg -x "$package"_*_arm64.deb "$root")
  done
  unzip -q "$(wheel_of aarch64)" -d "$root/wheel"
  first_block python integrations/python.md |
    QEMU_LD_PREFIX=$root PYTHONPATH=$root/wheel:$root/usr/lib/python3/dist-packages \
      qemu-aarch64 -E LD_LIBRARY_PATH="$root/usr/lib/aarch64-linux-gnu/blas:$root/usr/lib/aarch64-linux-gnu/lapack" \
      "$root/usr/bin/python3.11" - | diff <(first_block text integrations/python.md) -
}

test_windows() {
  local name=pelagic-$version-windows-x86_64
  check windows "$dist/$name.zip"
  unzip -q "$dist/$name.zip" -d "$work"
  local wine=("$source/cmake/run_wine.sh" "$work/wine-prefix")
  test_archive "$work/$name" x86_64-w64-mingw32-gcc-posix "${wine[@]}"
  quietly "${wine[@]}" "$work/$name/bin/pelagic.exe" export "$work/windows_waves" --resolution 64 --frames 2
  quietly "${wine[@]}" "$work/$name/bin/pelagic.exe" verify "$work/windows_waves"
  test -s "$work/windows_waves/displacement_0001.exr"
}

wheel_of() { echo "$dist"/pelagic-*"$1".whl; }

test_wheel() {
  check python "$(wheel_of "$1")"
  "$packaging/artefact.py" glibc "$newest_glibc" "$(wheel_of "$1")"
}

test_python() {
  test_wheel x86_64
  /usr/bin/python3 -m venv --system-site-packages "$work/venv"
  quietly "$work/venv/bin/pip" install --no-index --no-deps "$(wheel_of x86_64)"
  (cd "$work" && first_block python integrations/python.md | venv/bin/python -) | diff <(first_block text integrations/python.md) -
}

test_blender() {
  local zip
  zip=$(echo "$dist"/pelagic_blender-*.zip)
  check blender "$zip"
  export BLENDER_USER_RESOURCES=$work/blender_home
  mkdir -p "$BLENDER_USER_RESOURCES" "$work/out"
  quietly blender -b --factory-startup --python-exit-code 1 -P "$source/contrib/blender/install.py" -- "$zip"
  first_block python integrations/blender.md >"$work/page.py"
  (cd "$work" && quietly blender -b --python-exit-code 1 -P page.py)
  grep -qFx "$(first_block text integrations/blender.md)" "$work/log" || { cat "$work/log"; return 1; }
}

test_npm() {
  local archive=$dist/pelagic-$version.tgz
  check npm "$archive"
  mkdir "$work/my-sea"
  (
    cd "$work/my-sea"
    quietly npm init -y
    quietly npm install --offline --no-audit --no-fund "$archive"
    sed -n "/^cat >sea.mjs <<'END'/,/^END\$/{/END/!p}" "$source/docs/integrations/web.md" >sea.mjs
    node sea.mjs | diff <(first_block text integrations/web.md) -
  )
}

test_godot3() {
  local zip=$dist/pelagic-godot3-$version-linux-x86_64.zip answer
  check godot3 "$zip"
  "$packaging/artefact.py" glibc "$newest_glibc" "$zip"
  mkdir "$work/my_game"
  touch "$work/my_game/project.godot"
  unzip -q "$zip" -d "$work/my_game"
  sed -n '/`server.gd`:/,/^```$/p' "$source/docs/integrations/godot.md" | sed -n '/^```gdscript/,/^```$/{/^```/!p}' >"$work/my_game/server.gd"
  answer=$(HOME=$work LANG=en_US.UTF-8 godot3-server --path "$work/my_game" -s server.gd)
  grep -q "^$(printf %16s "$(sed -n 's/^preset-moderate@12.34 //p' "$source/tests/golden/hashes.txt")" | tr ' ' 0) " <<<"$answer" || { echo "$answer"; return 1; }
}

# No Debian package has Godot 4: a program stands in for it.
test_godot4() {
  local zip=$dist/pelagic-godot4-$version-linux-x86_64.zip answer
  check godot4 "$zip"
  "$packaging/artefact.py" glibc "$newest_glibc" "$zip"
  unzip -q "$zip" -d "$work/godot4"
  g++ -std=c++20 -O1 "-DGDEXTENSION_INTERFACE=\"$source/contrib/godot4/gdextension_interface.h\"" \
    "$source/tests/godot4/stand_in.cpp" -o "$work/stand_in"
  answer=$("$work/stand_in" "$work/godot4/addons/pelagic/libpelagic_godot4.so" 2)
  grep -q "^hash $(printf %16s "$(sed -n 's/^preset-moderate@12.34 //p' "$source/tests/golden/hashes.txt")" | tr ' ' 0)$" <<<"$answer" || { echo "$answer"; return 1; }
}

# Links the C application for each processor, with the header and the library of the prefab package.
test_android() {
  local stem=$dist/pelagic-$version-android tools=$PELAGIC_NDK/toolchains/llvm/prebuilt/linux-x86_64/bin abi
  check android_aar "$stem.aar"
  check android_zip "$stem.zip"
  # With all parts, unity has replaced it, and tests the package as a whole.
  [[ $parts == *" unity "* ]] || check unity_android "$dist/com.pelagic.ocean-$version.tgz"
  unzip -q "$stem.aar" -d "$work/aar"
  for abi in arm64-v8a x86_64; do
    # Stays, for a device: docs/development/on-hardware.md.
    local module=$work/aar/prefab/modules/pelagic_c folder=$source/build/android-application/$abi
    mkdir -p "$folder"
    cp "$module/libs/android.$abi/libpelagic_c.so" "$folder"
    "$tools/clang" --target="${abi/arm64-v8a/aarch64}-none-linux-android29" "$source/examples/c_application/main.c" -o "$folder/application" \
      -I"$module/include" -L"$folder" -lpelagic_c -lm
  done
}

# Under mono, because Unity is no package; docs/integrations/unity.md has what was tested.
test_unity() {
  local package=$dist/com.pelagic.ocean-$version.tgz
  local list=unity
  [[ $parts != *" android "* ]] || list=unity_with_android
  check $list "$package"
  "$packaging/artefact.py" glibc "$newest_glibc" "$package"
  tar -xzf "$package" -C "$work"
  cd "$work/package"
  echo 'public static class Program { public static void Main() { FrameLoop.Run(System.Console.WriteLine); } }' >"$work/program.cs"
  quietly mcs -unsafe -langversion:7.2 -out:Plugins/Linux/loop.exe "$work/program.cs" Runtime/*.cs Samples~/FrameLoop/FrameLoop.cs
  LD_LIBRARY_PATH=Plugins/Linux mono Plugins/Linux/loop.exe | diff <(sed 's/, cascades.*//' "$work/application_lines") -
  cd "$source"
}

parts=" ${*:3} "
for part in "${@:3}"; do
  echo "== testing $part"
  "test_$part"
done
