#!/usr/bin/env bash
# Every test: under ThreadSanitizer (the thread executor), under AddressSanitizer and UndefinedBehaviorSanitizer, and
# as released. ./test.sh release runs one of them alone. Installs what is missing, as demo.sh does.
set -euo pipefail
cd "$(dirname "$0")"
. cmake/dependencies.sh
pelagic_install_dependencies

presets=("$@")
[ ${#presets[@]} -gt 0 ] || presets=(tsan asan release)
for preset in "${presets[@]}"; do
  echo "== $preset"
  cmake --preset "$preset" -DPELAGIC_TESTS=ON -DPELAGIC_BENCH="$([ "$preset" = release ] && echo ON || echo OFF)"
  cmake --build --preset "$preset" -j "$(nproc)"
  ctest --preset "$preset" -j "$(nproc)"
done
