#!/usr/bin/env python3
"""Generates what describes the C interface in other languages from capi/pelagic.h.

usage: header.py            compares the files in the tree with what would be generated
       header.py --write    writes them
       header.py --freeze   writes tests/abi/pelagic-1.layout, which later versions 1.x must keep

unity/Runtime/Native.g.cs        structs with their defaults, enums and functions for C#
python/pelagic/_native.py        structs with their defaults, constants and functions for Python's ctypes
contrib/godot4/options.g.hpp     options for the properties of Godot 4, with ranges of schema/*.toml
docs/api.md                      the table of functions
"""
import difflib
import pathlib
import sys

import abi
import c_header
import c_layout
import csharp
import function_table
import godot4
import python_layouts

SOURCE = pathlib.Path(__file__).resolve().parents[2]
ABI = SOURCE / "tests/abi/pelagic-1.layout"


def read_pelagic_header():
    return c_header.read_header((SOURCE / "capi/pelagic.h").read_text())


def generated(header):
    page = SOURCE / "docs/api.md"
    yield SOURCE / "unity/Runtime/Native.g.cs", csharp.write(header)
    yield SOURCE / "python/pelagic/_native.py", python_layouts.write(header)
    yield SOURCE / "contrib/godot4/options.g.hpp", godot4.write(header)
    yield page, function_table.write(header, page.read_text())


def main():
    if sys.argv[1:] == ["--freeze"]:
        header = read_pelagic_header()
        return ABI.write_text(abi.write(header, c_layout.read_layout(header)))
    if sys.argv[1:] not in ([], ["--write"]):
        sys.exit(__doc__)
    stale = []
    for file, text in generated(read_pelagic_header()):
        there = file.read_text() if file.exists() else ""
        if there == text:
            continue
        name = file.relative_to(SOURCE).as_posix()
        if sys.argv[1:]:
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
            print(f"wrote {name}")
        else:
            stale.append(name)
            sys.stdout.writelines(difflib.unified_diff(there.splitlines(True), text.splitlines(True), name, f"{name}, generated", n=1))
    if stale:
        sys.exit(f"{', '.join(stale)}: not what pelagic.h gives; run tools/bindings/header.py --write")


if __name__ == "__main__":
    main()
