"""Runs every line of docs/integrations/python.md: its shell lines install a wheel of the package in
PACKAGE_FOLDER, or else build it from the sources, and its Python blocks print the documented output.

usage: page_lines.py SOURCE_FOLDER [PACKAGE_FOLDER]
"""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

source = Path(sys.argv[1])
# Debian's python3, which Debian's packages are for, before any other.
environment = {**os.environ, "PATH": "/usr/bin:" + os.environ["PATH"], "PIP_NO_INDEX": "1", "PYTHONDONTWRITEBYTECODE": "1",
               **{"PELAGIC_PYTHON_PACKAGE": folder for folder in sys.argv[2:]}}
# What stands for the wheel of a release.
wheels = source / "build/python-wheel"
installed = f"{wheels}/*.whl" if sys.argv[2:] else "."
blocks = re.findall(r"^```(\w+)\n(.*?)^```$", (source / "docs/integrations/python.md").read_text(), re.MULTILINE | re.DOTALL)
assert {"bash": 2, "python": 3, "text": 3} == {kind: sum(language == kind for language, _ in blocks) for kind in ("bash", "python", "text")}


def run(*command, **options):
    done = subprocess.run(command, cwd=source, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, **options)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\nfailed: {' '.join(command)}")
    return done.stdout


shutil.rmtree(source / "build/python-venv", ignore_errors=True)
if sys.argv[2:]:
    shutil.rmtree(wheels, ignore_errors=True)
    wheels.mkdir(parents=True)
    run("python3", "-c", f"import sys; sys.path.insert(0, 'python/build_backend'); import wheel_of_cmake; wheel_of_cmake.build_wheel({str(wheels)!r})")

# One program of all blocks, in order; a mark separates their outputs.
mark = "-- the next block --"
program = ""
expected = []
for (language, text), (following, printed) in zip(blocks, [*blocks[1:], ("", "")]):
    if language == "python":
        program += f"{text}\nprint({mark!r})\n"
        expected.append(printed if following == "text" else "")
    elif language == "bash" and program == "":
        assert "dist/*_$(uname -m).whl" in text
        print(run("bash", "-e", "-c", text.replace("dist/*_$(uname -m).whl", installed)).strip().splitlines()[-1])

seen = [part.removeprefix("\n") for part in run("build/python-venv/bin/python", "-c", program).split(mark)][:-1]
for number, (there, here) in enumerate(zip(expected, seen)):
    if there != here:
        print(f"block {number} prints\n{here}instead of\n{there}")
if len(seen) != len(expected) or seen != expected:
    sys.exit("the page says otherwise")

assert blocks[-1][0] == "bash"
run("bash", "-e", "-c", blocks[-1][1])
