"""Runs the code of docs/integrations/blender.md: shell lines in the clone, Python in one Blender,
whose output must have the page's lines. With ZIP, this add-on is installed instead of a built one.

usage: page_lines.py SOURCE_FOLDER [ZIP]"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

source = Path(sys.argv[1])
blocks = re.findall(r"^```(\w+)\n(.*?)^```$", (source / "docs/integrations/blender.md").read_text(), re.MULTILINE | re.DOTALL)
assert [kind for kind, _ in blocks] == "bash python text python text python bash bash".split(), "the page has other blocks than this test expects"
home = tempfile.TemporaryDirectory()
environment = {**os.environ, "PATH": "/usr/bin:" + os.environ["PATH"], "BLENDER_USER_RESOURCES": home.name}
(source / "out").mkdir(exist_ok=True)
shutil.rmtree(source / "out/pelagic_bake", ignore_errors=True)

def run(*command):
    done = subprocess.run(command, cwd=source, env=environment, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        sys.exit(f"{done.stdout}\nfailed: {' '.join(command)}")
    return done.stdout


shell = [text for kind, text in blocks if kind == "bash"]
python = "\n".join(text for kind, text in blocks if kind == "python")
expected = [line for kind, text in blocks if kind == "text" for line in text.splitlines()]

if len(sys.argv) > 2:
    *_, install = shell[0].splitlines()
    run("bash", "-e", "-c", re.sub(r"\S*pelagic_blender-\*\.zip$", sys.argv[2], install))
else:
    for old in (source / "build/python").glob("pelagic_blender-*.zip"):
        old.unlink()
    run("bash", "-e", "-c", shell[0])
printed = run("blender", "-b", "--python-exit-code", "1", "--python-expr", python)
for line in expected:
    assert line in printed.splitlines(), f"the page has the line {line}, Blender printed {printed}"
assert (source / "out/pelagic_bake/Ocean/foam_0010.png").exists()

# The second block queries, the third is the benchmark, here with few frames because a test has no
# use for its times.
told = run("bash", "-e", "-c", shell[1])
# Notes are on standard error.
header, row = [line for line in told.splitlines() if not line.startswith("note: ")]
assert header.startswith("x,z,height") and row.startswith("12,-7,"), told
assert " ratio" in run("bash", "-e", "-c", shell[2].rstrip() + " -- --frames 4")
print("the page's lines do what it says")
