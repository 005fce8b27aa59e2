#!/usr/bin/env python3
"""Prints file and line of each comment line of C++, GLSL, Python, JavaScript, CMake and shell
sources that passes column 100. Lines with a URL or with a single word are allowed.

usage: comment_columns.py SOURCE_FOLDER [OMITTED_FOLDER...]    paths relative to SOURCE_FOLDER
"""
import ast
import io
import os
import pathlib
import re
import sys
import tokenize

last_column = 100
left_out = {"build", "node_modules"}
languages = {".c": "c", ".cpp": "c", ".h": "c", ".hpp": "c", ".glsl": "c", ".js": "js", ".mjs": "js", ".ts": "js",
             ".py": "python", ".pyi": "python", ".cmake": "script", ".sh": "script"}
strings = {"c": r'R"(?P<end>[^()\s]*)\(.*?\)(?P=end)"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'',
           "js": r'"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'|`(?:\\.|[^`\\])*`|(?<=[(,=:&|?!;])\s*/(?![/*])(?:\\.|\[[^\]\n]*\]|[^/\\\n])+/'}
allowed = re.compile(r"https?://|^\W*\S*$")


def c_comments(text, language):
    for found in re.finditer(rf"{strings[language]}|(?P<comment>//[^\n]*|/\*.*?\*/)", text, re.DOTALL):
        if found["comment"]:
            yield found.start(), found["comment"]


def script_comments(text):
    """Yields comments that begin a line, or follow a space and an even number of quotes."""
    for found in re.finditer(r"""^(?!#!)(?P<code>(?:[^#"'\n]|"[^"\n]*"|'[^'\n]*'|(?<!\s)#)*)(?P<comment>#[^\n]*)""", text, re.MULTILINE):
        yield found.start("comment"), found["comment"]


def python_comments(text):
    starts = [0]
    for line in text.splitlines(keepends=True):
        starts.append(starts[-1] + len(line))
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            yield starts[token.start[0] - 1] + token.start[1], token.string
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant) and isinstance(node.value.value, str):
            first = starts[node.lineno - 1] + node.col_offset
            yield first, text[first:starts[node.end_lineno - 1] + node.end_col_offset]


def comments(text, language):
    """Yields the position and the text of each comment and docstring."""
    if language == "python":
        return python_comments(text)
    return script_comments(text) if language == "script" else c_comments(text, language)


def sources(folder, omitted):
    for path, folders, files in os.walk(folder):
        folders[:] = sorted(name for name in folders if name not in left_out and not name.startswith(".")
                            and (pathlib.Path(path) / name).relative_to(folder).as_posix() not in omitted)
        for file in map(pathlib.Path(path).joinpath, sorted(files)):
            language = "script" if file.name == "CMakeLists.txt" else languages.get(file.suffix)
            if language:
                yield file, language


def long_lines(text, language):
    lines = text.splitlines()
    for position, comment in comments(text, language):
        first = text.count("\n", 0, position)
        column = position - (text.rfind("\n", 0, position) + 1)
        for number, line in enumerate(comment.splitlines()):
            end = len(line) + (column if number == 0 else 0)
            if end > last_column and not allowed.search(line):
                yield first + number + 1, lines[first + number]


def main():
    folder = pathlib.Path(sys.argv[1])
    found = read = 0
    for file, language in sources(folder, sys.argv[2:]):
        read += 1
        for number, line in sorted(long_lines(file.read_text("utf-8"), language)):
            print(f"{file.relative_to(folder)}:{number}: {line.strip()[:120]}")
            found += 1
    if read < 100:
        sys.exit(f"{read} sources were read, expected the whole tree")
    sys.exit(1 if found else 0)


main()
