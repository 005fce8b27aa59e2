#!/bin/sh
# Runs a WebAssembly program in node: `run_wasm.sh PROGRAM.js ARGUMENTS`, as a toolchain's emulator.
#
# Emscripten 3.1.6 takes a global fetch for a browser's, and would load the module through it.
exec node --no-experimental-fetch "$@"
