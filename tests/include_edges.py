#!/usr/bin/env python3
"""Checks every include of C and C++ against the directories that include_edges.txt allows, prints
each violation by file, and checks that the table itself has no cycle.

usage: include_edges.py SOURCE_FOLDER TABLE
"""
import pathlib
import re
import sys

include = re.compile(r'^\s*#\s*include "pelagic/([^"]+)"', re.MULTILINE)
left_out = {"build", "node_modules"}


def read_table(file):
    table = {}
    for line in file.read_text().splitlines():
        if line and not line.startswith("#"):
            directory, allowed = line.split(":")
            if directory in table:
                sys.exit(f"{file}: {directory} stands there twice")
            table[directory] = allowed.split()
    return table


def later_directories(table):
    """Yields directories that a directory of the table may include although they stand below it,
    which would allow a cycle."""
    seen = {"generated"}
    for directory, allowed in table.items():
        for other in allowed:
            if other not in seen and other != "*":
                yield f"the table lets {directory} include {other}, which stands below it"
        seen.add(directory)


def sources(folder):
    for file in sorted(folder.rglob("*")):
        inside = file.relative_to(folder)
        if file.suffix in (".c", ".cpp", ".h", ".hpp") and not left_out & set(inside.parts) and not inside.parts[0].startswith("."):
            yield file, inside


def violations(folder, table):
    for file, inside in sources(folder):
        directory = inside.parent.as_posix()
        for header in include.findall(file.read_text()):
            to = pathlib.PurePosixPath(header).parent.as_posix()
            if to in (directory, "."):  # "pelagic/pelagic.h" is the C interface
                continue
            allowed = table.get(directory, [])
            if to not in allowed and "*" not in allowed:
                yield f"{inside} includes {header}: {directory} may not include {to}"


def main():
    folder, table_file = map(pathlib.Path, sys.argv[1:])
    table = read_table(table_file)
    found = [*later_directories(table), *violations(folder, table)]
    for line in found:
        print(line)
    if not any(True for _ in sources(folder)):
        found.append("no sources")
    sys.exit(1 if found else 0)


main()
