"""Writes the docstrings of a stub as C++, so that help() says what editors show: {"Ocean.schedule", "Starts ..."}, one a line.

usage: docs_of_stub.py STUB.pyi OUT.inc
"""

import ast
import json
import sys
from pathlib import Path


def docs_in(node, prefix=""):
    for part in node.body:
        if isinstance(part, (ast.ClassDef, ast.FunctionDef)):
            text = ast.get_docstring(part)
            if text:
                yield prefix + part.name, text
            if isinstance(part, ast.ClassDef):
                yield from docs_in(part, prefix + part.name + ".")


stub, out = map(Path, sys.argv[1:])
# A text of JSON is one of C++ as long as it is ASCII.
lines = [f"{{{json.dumps(name)}, {json.dumps(text)}}},\n" for name, text in docs_in(ast.parse(stub.read_text("utf-8")))]
out.write_text("".join(lines), "utf-8")
