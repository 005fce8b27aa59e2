#!/usr/bin/env bash
# pelagic.dll and the import library that applications link export the symbols of
# tests/abi/pelagic.symbols. The DLL imports only DLLs that every Windows has.
#
# usage: dll_symbols.sh OBJDUMP NM DLL IMPORT_LIBRARY LIST
set -euo pipefail
objdump=$1 nm=$2 dll=$3 import_library=$4 list=$5
headers=$("$objdump" -p "$dll")

# "[Ordinal/Name Pointer] Table", then "	[   0] pelagic_executor_create"
exported=$(sed -nE '/Name Pointer\] Table/,/^$/s/^\t\[ *[0-9]+\] (\+base\[ *[0-9]+\] +[0-9a-f]+ )?(.*)$/\2/p' <<<"$headers" | LC_ALL=C sort)
diff -u "$list" - <<<"$exported" || { echo "what $dll exports differs from $list"; exit 1; }

# Each name occurs twice, once as the address in the import table.
offered=$("$nm" --defined-only "$import_library" 2>/dev/null | awk '$2 == "T" {print $3}' | LC_ALL=C sort)
diff -u "$list" - <<<"$offered" || { echo "what $import_library offers differs from $list"; exit 1; }

imported=$(sed -nE 's/^\tDLL Name: (.*)$/\1/p' <<<"$headers" | tr '[:upper:]' '[:lower:]' | LC_ALL=C sort -u)
[ -n "$imported" ] || { echo "$dll imports nothing?"; exit 1; }
# MSYS2's compiler links the universal C library of Windows 10 by its many names.
strangers=$(grep -vE '^(kernel32|msvcrt|ucrtbase|api-ms-win-crt-[a-z0-9-]+)\.dll$' <<<"$imported" || true)
[ -z "$strangers" ] || { echo "$dll imports what a plain Windows lacks:" $strangers; exit 1; }
