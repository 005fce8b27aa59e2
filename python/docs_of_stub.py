"""Writes the docstrings of a stub as C++, so that help() and editors show the same:
{"Ocean.schedule", "Starts ..."}, one on each line. Docstrings of functions begin with the
signature, in the form from which Python makes __text_signature__.

usage: docs_of_stub.py STUB.pyi OUT.inc
"""

import ast
import json
import sys
from pathlib import Path


def text_signature(function):
    """Returns "schedule($self, time_s)\\n--\\n\\n"."""
    given = function.args
    defaults = [None] * (len(given.args) - len(given.defaults)) + given.defaults
    texts = [("$self" if argument.arg == "self" else argument.arg) + (f"={ast.unparse(default)}" if default else "")
             for argument, default in zip(given.args, defaults)]
    texts += ["*"] * bool(given.kwonlyargs)
    texts += [argument.arg + (f"={ast.unparse(default)}" if default else "")
              for argument, default in zip(given.kwonlyargs, given.kw_defaults)]
    return f"{function.name}({', '.join(texts)})\n--\n\n"


def is_property(part):
    return any(isinstance(decorator, ast.Name) and decorator.id == "property" for decorator in part.decorator_list)


def docs_in(node, prefix=""):
    for part in node.body:
        if isinstance(part, (ast.ClassDef, ast.FunctionDef)):
            text = ast.get_docstring(part)
            if text:
                has_signature = isinstance(part, ast.FunctionDef) and not is_property(part)
                yield prefix + part.name, (text_signature(part) if has_signature else "") + text
            if isinstance(part, ast.ClassDef):
                yield from docs_in(part, prefix + part.name + ".")


stub, out = map(Path, sys.argv[1:])
# An ASCII string of JSON is also a string of C++.
lines = [f"{{{json.dumps(name)}, {json.dumps(text)}}},\n" for name, text in docs_in(ast.parse(stub.read_text("utf-8")))]
out.write_text("".join(lines), "utf-8")
