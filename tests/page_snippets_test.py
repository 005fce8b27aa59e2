#!/usr/bin/env python3
"""Compiles every C, C++ and GLSL code block of README and docs. A block of C or C++ is a program if
it has main(), else the body of a function; its includes and its functions come first. The names
that blocks use without declaring them are in page_snippets.h, .hpp and .glsl.

usage: page_snippets_test.py SOURCE_FOLDER INCLUDE_FOLDER C_COMPILER CXX_COMPILER
"""
import pathlib
import re
import subprocess
import sys

source, include, c_compiler, cxx_compiler = pathlib.Path(sys.argv[1]), *sys.argv[2:]
tests = source / "tests"
C = [c_compiler, "-x", "c", "-std=c99", "-include", str(tests / "page_snippets.h")]
CXX = [cxx_compiler, "-x", "c++", "-std=c++20", "-include", str(tests / "page_snippets.hpp")]


def blocks():
    """Yields page, first line, language and text of each block."""
    for page in [source / "README.md", *sorted((source / "docs").rglob("*.md"))]:
        text = page.read_text(encoding="utf-8")
        for match in re.finditer(r"^```(cpp|c|glsl)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
            yield page.relative_to(source), text.count("\n", 0, match.start(2)) + 1, match[1], match[2]


def unit_of(blocks):
    """Returns a translation unit of blocks. Errors of the compiler name the page and its line."""
    includes, unit = set(), ""
    for number, (page, line, _, text) in enumerate(blocks):
        includes.update(re.findall(r"^#include .*\n", text, re.MULTILINE))
        body = re.sub(r"^#include .*$", "", text, flags=re.MULTILINE)
        functions = body if "int main(" in body else re.match(r"(?:\s*static .*?^}\n)*", body, re.MULTILINE | re.DOTALL)[0]
        unit += f'#line {line} "{page}"\n{functions}\n'
        if functions != body:
            first = line + functions.count("\n")
            unit += f'void block_{number}(void);\nvoid block_{number}(void) {{\n#line {first} "{page}"\n{body[len(functions):]}}}\n'
    return "".join(sorted(includes)) + unit


failed, found = False, list(blocks())
for language, command in (("c", C), ("cpp", CXX)):
    unit = unit_of([block for block in found if block[2] == language])
    flags = ["-Wall", "-Wno-unused", "-Werror", "-fsyntax-only", f"-I{include}", "-"]
    failed |= subprocess.run([*command, *flags], input=unit, text=True).returncode != 0
for page, line, language, text in found:
    if language == "glsl":
        shader = (tests / "page_snippets.glsl").read_text(encoding="utf-8") + text + "\nvoid main() {}\n"
        done = subprocess.run(["glslangValidator", "--stdin", "-S", "vert"], input=shader, text=True, stdout=subprocess.PIPE)
        if done.returncode != 0:
            print(f"{page}:{line}:\n{done.stdout}")
            failed = True
print(f"{len(found)} blocks")
sys.exit(failed or len(found) < 15)
