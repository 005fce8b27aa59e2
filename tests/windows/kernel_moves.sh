#!/usr/bin/env bash
# Kernels move no register of 32 or 64 bytes to or from memory with aligned instructions, because
# stacks of Windows may be unaligned (cmake/isa.cmake). Debian's compiler aligns them, so no crash
# would show the error.
#
# usage: kernel_moves.sh OBJDUMP OBJECT...
set -euo pipefail
code=$("$1" -d --no-show-raw-insn "${@:2}")
[ "$(grep -cE 'vmovups .*%[yz]mm[0-9]+.*\(|vmovups .*\(.*%[yz]mm' <<<"$code")" -gt 0 ] || { echo "no wide moves in ${*:2}"; exit 1; }
aligned=$(grep -E '\bvmov(aps|apd|dqa|dqa32|dqa64) .*\(' <<<"$code" | grep -E '%[yz]mm' || true)
[ -z "$aligned" ] || { echo "aligned moves:"; head -5 <<<"$aligned"; exit 1; }
