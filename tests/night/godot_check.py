# Runs the recipe's project in Godot 3 under a virtual X server, and compares its vertices with
# queries.
#
# usage: godot_check.py FOLDER IMAGE.png PELAGIC RECIPE
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from compare_with_query import compare

folder, image, pelagic, recipe = sys.argv[1:]
record = json.loads((Path(folder) / "sea.json").read_text())
vertices = (record["sea"]["resolution"] + 1) ** 2

with tempfile.TemporaryDirectory() as project:
    for file in Path(recipe).iterdir():
        shutil.copy(file, project)
    shutil.copy(Path(__file__).parent / "godot_check.gd", project)
    scene = Path(project) / "sea.tscn"
    scene.write_text(scene.read_text().replace("sea.gd", "godot_check.gd"))  # which extends it
    os.symlink(Path(folder).resolve(), Path(project) / "waves")
    places_file = Path(project) / "places.txt"
    run = subprocess.run(["xvfb-run", "-a", "-s", "-screen 0 1280x800x24", "godot3", "--path", project,
                          "--audio-driver", "Dummy"], timeout=300, capture_output=True, text=True,
                         env={**os.environ, "HOME": project, "IMAGE": str(Path(image).resolve()),
                              "PLACES": str(places_file)})
    assert run.returncode == 0 and places_file.exists(), run.stdout + run.stderr
    places = [tuple(map(float, line.split())) for line in places_file.read_text().splitlines()]

assert len(places) == vertices * len(record["frames"])
for number in range(len(record["frames"])):
    # Godot 3 reads an EXR as 16-bit floats, which have 11 bits.
    compare(pelagic, folder, number, places[vertices * number:vertices * (number + 1)], bits=11)
