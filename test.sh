#!/usr/bin/env bash
# Every test: under ThreadSanitizer (the thread executor), under AddressSanitizer and UndefinedBehaviorSanitizer, and
# as released; a minute of each fuzzer; then the bits of the sea again from other compilers, optimisations and
# processors. ./test.sh release runs one of them alone. Installs what is missing, as demo.sh does.
set -euo pipefail
cd "$(dirname "$0")"
. cmake/dependencies.sh
pelagic_install_dependencies "${pelagic_test_packages[@]}"

presets=("$@")
if [ ${#presets[@]} -eq 0 ]; then
  presets=(tsan asan release fuzz gcc-o1 clang-o1 clang-o3)
  [ "$(uname -m)" = aarch64 ] || presets+=(arm64)  # there, release is that already
fi
for preset in "${presets[@]}"; do
  echo "== $preset"
  cmake --preset "$preset" -DPELAGIC_TESTS="$([ "$preset" = fuzz ] && echo OFF || echo ON)" -DPELAGIC_BENCH="$([ "$preset" = release ] && echo ON || echo OFF)"
  cmake --build --preset "$preset" -j "$(nproc)"
  ctest --preset "$preset" -j "$(nproc)"
done
