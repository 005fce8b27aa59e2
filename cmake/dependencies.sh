# Sourced by demo.sh and test.sh: checks that Pelagic's build dependencies are installed.
#
# On Debian 12 it prints and installs missing packages, with sudo only if you are not root. On
# another system it prints the list and stops; PELAGIC_SKIP_SETUP=1 continues without them.

pelagic_packages=(
  g++ cmake make
  libtbb-dev               # oneTBB: jobs
  libxsimd-dev             # xsimd: kernels
  libxxhash-dev            # XXH3: the hash of a frame
  libglm-dev               # GLM: cameras of the quadtree, hulls
  libegl-dev libgles-dev   # headers of EGL and OpenGL ES
  libegl1 libgles2 libgl1-mesa-dri  # and a driver that renders without a GPU: pelagic render
  libglfw3-dev libimgui-dev libstb-dev  # GLFW and Dear ImGui: pelagic view; stb: text in previews
  libopenxr-dev            # OpenXR: examples/openxr_application
  libopenimageio-dev       # OpenImageIO: EXR, PNG, TIFF
  libcli11-dev             # CLI11: the command line
  libtomlplusplus-dev      # toml++: --config
  nlohmann-json3-dev       # sea.json
  libzstd-dev              # Zstandard: KTX2
  libgtest-dev             # GoogleTest
  libbenchmark-dev         # Google Benchmark
  libopenexr-dev           # OpenEXR: EXR files
  libpng-dev               # tests read PNG files with another reader than Pelagic's writer
  libfftw3-dev             # FFTW: comparison in benchmarks
  libkissfft-dev           # KISS FFT: comparison in benchmarks
)

# Packages for tests only: a compiler cache and a quick linker; an X server with a mouse, for the
# window; pkg-config, as applications use it; the reference compiler of GLSL, for shaders that no
# driver here compiles; strace, to check that files are synced; valgrind and Python, to count
# instructions; groff, to check the manual page; a validation layer for OpenXR; NumPy.
pelagic_test_packages=(ccache lld xvfb xdotool x11-apps netpbm pkg-config glslang-tools spirv-tools strace valgrind python3 groff-base
                       openxr-layer-corevalidation python3-numpy)

# Packages for the gate: clang with its sanitizers and libFuzzer; Doxygen, for the API reference; mono
# and its compiler of C#, and a translator of shaders; what the Python package's tests need; Blender.
pelagic_gate_packages=(clang libclang-rt-14-dev doxygen mono-mcs mono-runtime spirv-cross)
pelagic_gate_packages+=(python3-venv python3-matplotlib python3-pytest mypy blender)

# Packages for other platforms: the C++ library of headsets, a compiler and an emulator for 64-bit
# Arm, a compiler to Windows, what windows_libraries.sh needs, and wine, a compiler to WebAssembly, node and a browser.
pelagic_arm64_packages=(libc++-14-dev libc++abi-14-dev)
[ "$(uname -m)" = aarch64 ] ||
  pelagic_arm64_packages+=(g++-aarch64-linux-gnu qemu-user libtbb-dev:arm64 libgtest-dev:arm64 libimath-dev:arm64)
pelagic_windows_packages=(g++-mingw-w64-x86-64-posix libz-mingw-w64-dev dpkg-dev wine64)
pelagic_web_packages=(emscripten)
command -v node >/dev/null || pelagic_web_packages+=(nodejs)
pelagic_platform_packages=("${pelagic_arm64_packages[@]}" "${pelagic_windows_packages[@]}" "${pelagic_web_packages[@]}" chromium openssl)
command -v npm >/dev/null || pelagic_platform_packages+=(npm)

# Packages for nightly tests: a game engine, with a window (for xvfb-run, which needs xauth) and
# without; schedulers of docs/render-farm.md, and readers of textures and films of
# docs/integrations/unity.md.
pelagic_night_packages=(llvm-14 file godot3 godot3-server xauth slurm-wlm parallel python3-yaml procps libnvtt-bin ffmpeg python3-pil python3-openimageio)

# usage: pelagic_install_dependencies [PACKAGE...]   packages in addition to pelagic_packages
pelagic_install_dependencies() {
  local packages=("${pelagic_packages[@]}" "$@")
  [ -n "${PELAGIC_SKIP_SETUP:-}" ] && return 0
  if ! grep -qs '^ID=debian$' /etc/os-release || ! command -v apt-get >/dev/null; then
    echo "This set-up knows Debian 12. Install what these Debian packages hold, then run again with PELAGIC_SKIP_SETUP=1:"
    echo "  ${packages[*]}"
    return 1
  fi

  local missing=() package
  for package in "${packages[@]}"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -q '^installed$' || missing+=("$package")
  done
  [ ${#missing[@]} -eq 0 ] && return 0

  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || {
      echo "Missing: ${missing[*]}. There is no sudo here: install them as root, then run this again."
      return 1
    }
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  case "${missing[*]}" in *:arm64*) "${as_root[@]}" dpkg --add-architecture arm64 ;; esac
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update -qq &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"; } >"$log" 2>&1; then
    echo "apt-get could not install ${missing[*]}: $(grep -m 1 '^E: ' "$log" || tail -n 1 "$log")" >&2
    rm -f "$log"
    return 1
  fi
  rm -f "$log"
}
