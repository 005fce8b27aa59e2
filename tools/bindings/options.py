#!/usr/bin/env python3
"""Writes what describes options in each language from schema/*.toml.

usage: options.py [FOLDER]            compares the regions in the tree with what would be generated
       options.py --write [FOLDER]    writes them

A region stands between a line with "generated from schema/FILE.toml: KIND" and a line with "end of generated" in a file
of any language. RENDERERS lists the kinds. FOLDER is the tree, by default the one of this program.
"""
import difflib
import pathlib
import re
import sys

import option_regions
from schema import SchemaError, read_schemas

SUFFIXES = {".hpp", ".cpp", ".h", ".py", ".ts", ".md", ".cs"}
FOLDERS = ("analytic", "capi", "contrib", "docs", "examples", "floating", "gl", "python", "quadtree", "sim", "tools", "web")
REGION = re.compile(r"(?P<head>^(?P<indent>[ \t]*)[^\n]*generated from schema/(?P<file>\w+\.toml): (?P<kind>[\w-]+)[^\n]*\n)"
                    r"(?P<body>.*?)(?P<tail>^[^\n]*end of generated)", re.S | re.M)


def files_in(tree):
    for folder in FOLDERS:
        for file in sorted((tree / folder).rglob("*")):
            if file.suffix in SUFFIXES and file.parent != tree / "tools/bindings":
                yield file


def generated(tree, schemas):
    """Each file with a region: its path, its text and its text with new regions."""
    for file in files_in(tree):
        text = file.read_text()
        if "generated from schema/" not in text:
            continue

        def renew(match):
            name = file.relative_to(tree).as_posix()
            if match["file"] not in schemas:
                raise SchemaError(f"{name} has a region of {match['file']}, which is not in schema/")
            if match["kind"] not in option_regions.RENDERERS:
                raise SchemaError(f"{name} has a region {match['kind']}, accepted: {', '.join(option_regions.RENDERERS)}")
            lines = option_regions.RENDERERS[match["kind"]](schemas[match["file"]])
            body = "".join((match["indent"] + line).rstrip() + "\n" for line in lines)
            return match["head"] + body + match["tail"]

        yield file, text, REGION.sub(renew, text)


def main():
    arguments = sys.argv[1:]
    writes = arguments[:1] == ["--write"]
    folders = arguments[writes:]
    if len(folders) > 1 or any(folder.startswith("-") for folder in folders):
        sys.exit(__doc__)
    tree = pathlib.Path(folders[0]) if folders else pathlib.Path(__file__).resolve().parents[2]
    stale = []
    try:
        schemas = read_schemas(tree / "schema")
        changed = [entry for entry in generated(tree, schemas) if entry[1] != entry[2]]
    except SchemaError as error:
        sys.exit(f"options.py: {error}")
    for file, there, text in changed:
        name = file.relative_to(tree).as_posix()
        if writes:
            file.write_text(text)
            print(f"wrote {name}")
        else:
            stale.append(name)
            sys.stdout.writelines(difflib.unified_diff(there.splitlines(True), text.splitlines(True), name, f"{name}, generated", n=1))
    if stale:
        sys.exit(f"{', '.join(stale)}: not what schema/ gives; run tools/bindings/options.py --write")


if __name__ == "__main__":
    main()
