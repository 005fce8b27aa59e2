#!/usr/bin/env python3
"""Prints pelagic.h for Doxygen. Declarations keep their line numbers.

* Comments become those that Doxygen reads: one after a declaration describes it, others what follows.
* The first comment describes the group `c`, which holds what precedes the sections. Its indented lines
  become code.
* Each section is a group within it.

usage: c_reference.py PELAGIC_H
"""
import pathlib
import re
import sys


def described(line):
    if re.search(r"/\* (?:generated from schema/.*|end of generated) \*/", line):
        return ""
    if re.match(r"static inline \w+ \w+_make\(void\)", line):
        return "/** Returns the struct with its struct_size and all defaults. */ " + line
    line = re.sub(r"([;,{]) */\*([^*<])", r"\1 /**<\2", line)
    return re.sub(r"^( *)/\*([^*])", r"\1/**\2", line)


def section_lines(title):
    name = "c_" + re.sub(r"\W+", "_", title.lower())
    return rf"/** @}} */ /** \defgroup {name} {title}", r" * \ingroup c */ /** @{ */"


def lines_for_doxygen(lines):
    end_of_first = next(number for number, line in enumerate(lines) if line.endswith("*/"))
    added = 1  # lines, each of which takes the place of the next empty one
    yield r"/** \defgroup c C interface"
    for number, line in enumerate(lines):
        section = re.fullmatch(r"/\* -+ (.+?) -+ \*/", line)
        if section:
            yield from section_lines(section[1])
            added += 1
        elif not line and added:
            added -= 1
        elif number <= end_of_first:
            yield line.replace("/*", " *", 1).replace(" *   ", " *     ", 1).replace("*/", "*/ /** @{ */", 1)
        else:
            yield described(line)
    yield "/** @} */"


print("\n".join(lines_for_doxygen(pathlib.Path(sys.argv[1]).read_text(encoding="utf-8").splitlines())))
