#!/usr/bin/env bash
# Builds the libraries of the command for Windows from the sources of Debian 12 into FOLDER, as static
# libraries. Needs zlib's package for mingw-w64 (libz-mingw-w64-dev).
#
# usage: windows_libraries.sh FOLDER
#
# FOLDER/versions lists "SOURCE VERSION" of Debian. The upstream versions are those of Debian 12, so
# that images have the bytes that the command writes on Linux; only Debian's fixes may differ.
# PELAGIC_MIRROR is a mirror of Debian.
set -euo pipefail
folder=$(realpath -m "$1")
sources=(imath:3.1.6 openexr:3.1.5 libpng1.6:1.6.39 libzstd:1.5.4)
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}

mkdir -p "$(dirname "$folder")"
exec {lock}>"$folder.lock"
flock "$lock"  # several builds may share the folder
[ ! -e "$folder/versions" ] || exit 0
work=$folder.work  # equal in each run, for ccache
rm -rf "$work"
mkdir "$work"
trap 'rm -rf "$work"' EXIT
prefix=$work/prefix

# apt with lists of its own: systems seldom list sources.
mkdir -p "$work"/{lists,parts,cache/archives}/partial
cat >"$work/parts/debian.sources" <<END
Types: deb-src
URIs: ${PELAGIC_MIRROR:-http://deb.debian.org/debian}
Suites: bookworm
Components: main
Signed-By: /usr/share/keyrings/debian-archive-keyring.gpg
END
apt=(-qq -o Dir::Etc::SourceList=/dev/null -o Dir::Etc::SourceParts="$work/parts" -o Dir::State::Lists="$work/lists"
  -o Dir::Cache="$work/cache" -o APT::Sandbox::User=root)

# usage: build SOURCE CMAKE_FOLDER OPTION...
build() {
  cmake -S "$work/$1/$2" -B "$work/$1/build" -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_SYSTEM_PROCESSOR=x86_64 \
    -DCMAKE_C_COMPILER=x86_64-w64-mingw32-gcc-posix -DCMAKE_CXX_COMPILER=x86_64-w64-mingw32-g++-posix \
    -DCMAKE_RC_COMPILER=x86_64-w64-mingw32-windres -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" \
    -DCMAKE_FIND_ROOT_PATH="$prefix;/usr/x86_64-w64-mingw32" -DCMAKE_FIND_ROOT_PATH_MODE_PROGRAM=NEVER \
    -DCMAKE_FIND_ROOT_PATH_MODE_LIBRARY=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_INCLUDE=ONLY -DCMAKE_FIND_ROOT_PATH_MODE_PACKAGE=ONLY \
    -DCMAKE_POLICY_DEFAULT_CMP0091=NEW -DCMAKE_{C,CXX}_FLAGS="-ffile-prefix-map=$work=." \
    -DZLIB_LIBRARY=/usr/x86_64-w64-mingw32/lib/libz.a -DBUILD_SHARED_LIBS=OFF -DBUILD_TESTING=OFF "${@:3}"
  cmake --build "$work/$1/build"
  cmake --install "$work/$1/build"
}

make_all() {
  cd "$work"
  apt-get "${apt[@]}" update
  for source in "${sources[@]}"; do
    local name=${source%:*} version
    version=$(apt-cache "${apt[@]}" showsrc "$name" | sed -n 's/^Version: //p' | sort -V | tail -n 1)
    case $version in
      "${source#*:}"[-+]*) ;;
      *) echo "Debian's $name is of version $version, expected ${source#*:}" && return 1 ;;
    esac
    apt-get "${apt[@]}" source "$name=$version"
    mv "$name"-*/ "$name"
    echo "$name $version" >>"$prefix.versions"
  done
  local with_ccache=()
  ! command -v ccache >/dev/null || with_ccache=(-DCMAKE_{C,CXX}_COMPILER_LAUNCHER=ccache)
  build imath . -DDOCS=OFF "${with_ccache[@]}"
  build openexr . -DDOCS=OFF -DOPENEXR_BUILD_TOOLS=OFF -DOPENEXR_INSTALL_EXAMPLES=OFF "${with_ccache[@]}"
  build libpng1.6 . -DPNG_SHARED=OFF -DPNG_TESTS=OFF "${with_ccache[@]}"
  build libzstd build/cmake -DZSTD_BUILD_PROGRAMS=OFF -DZSTD_BUILD_SHARED=OFF -DZSTD_MULTITHREAD_SUPPORT=OFF "${with_ccache[@]}"
  mv "$prefix.versions" "$prefix/versions"
}
make_all >"$work.log" 2>&1 {lock}>&- || { tail -n 5 "$work.log"; echo "can't build libraries for Windows, see $work.log"; exit 1; }
rm -rf "$folder" "$work.log"
chmod 755 "$prefix"
mv -T "$prefix" "$folder"
