#!/usr/bin/env python3
"""Searches headers, docs, examples and the command's help texts for retired names and phrases, and
prints each with its file and line.

usage: retired_terms.py SOURCE_FOLDER TERMS [PELAGIC]
"""
import pathlib
import re
import subprocess
import sys

commands = ["bench", "export", "info", "merge", "quadtree", "query", "render", "verify", "view"]
folders = ["analytic", "capi", "docs", "examples", "gl", "jobs", "message", "presets", "python", "quadtree", "sim", "simd", "tools",
           "viewer", "web"]
suffixes = {".glsl", ".h", ".hpp", ".js", ".md", ".mjs", ".py", ".pyi", ".toml", ".ts"}


def read_terms(file):
    lines = [line for line in file.read_text().splitlines() if line and not line.startswith("#")]
    return [(line, re.compile(rf"(?<![\w-])(?:{line})(?!\w)")) for line in lines]


def texts(source, pelagic):
    for file in [*sorted(source.glob("*.md")), *(file for folder in folders for file in sorted((source / folder).rglob("*")))]:
        inside = file.relative_to(source)
        if file.suffix in suffixes and not {"build", "node_modules"} & set(inside.parts):
            yield inside, file.read_text()
    for command in [[], *([name] for name in commands)] if pelagic else []:
        help_text = subprocess.run([pelagic, *command, "--help"], capture_output=True, text=True, check=True).stdout
        yield " ".join(["pelagic", *command, "--help"]), help_text


def main():
    source, terms = pathlib.Path(sys.argv[1]), read_terms(pathlib.Path(sys.argv[2]))
    found = read = 0
    for place, text in texts(source, sys.argv[3] if len(sys.argv) > 3 else None):
        read += 1
        for number, line in enumerate(text.splitlines(), 1):
            for term, pattern in terms:
                if pattern.search(line):
                    print(f"{place}:{number}: {term}: {line.strip()[:120]}")
                    found += 1
    if read < 100:
        sys.exit(f"{read} texts were read, expected the whole tree")
    sys.exit(1 if found else 0)


main()
