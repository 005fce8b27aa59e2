#!/bin/sh
# Runs a WebAssembly program in node: `run_wasm.sh PROGRAM.js ARGUMENTS`, as a toolchain's emulator.
#
# If a global fetch exists, Emscripten 3.1.6 assumes a browser and loads the module with it.
exec node --no-experimental-fetch "$@"
