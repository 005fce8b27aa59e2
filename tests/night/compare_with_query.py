"""Compares the sea of another program with the heights of `pelagic query`."""
import csv
import json
import math
import subprocess
import tempfile
from pathlib import Path


def float_step(value):
    """Returns the distance of neighbouring 32-bit floats."""
    return 2.0 ** (math.frexp(value)[1] - 24)


def ask(pelagic, folder, frame_number, places, *options):
    """Returns the results of `pelagic query` for a frame of an export, a dictionary for each of the
    points (x, y, z); y is unused."""
    sea_json = Path(folder) / "sea.json"
    frame = json.loads(sea_json.read_text())["frames"][frame_number]
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as points:
        points.writelines(f"{x!r},{z!r}\n" for x, _, z in places)
        points.flush()
        answer = subprocess.run([pelagic, "query", "--config", str(sea_json), "--time", repr(frame["time_s"]),
                                 "--points", points.name, "--interpolation", "linear", *options], check=True, capture_output=True, text=True).stdout
    rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(answer.splitlines())]
    assert len(rows) == len(places)
    return rows


def compare(pelagic, folder, frame_number, places, bits=24):
    """Compares `places`, points (x, y, z) in Pelagic's axes on whole patches of the export in
    `folder`, from floats of `bits` bits, with queries."""
    frame = json.loads((Path(folder) / "sea.json").read_text())["frames"][frame_number]
    heights = [row["height"] for row in ask(pelagic, folder, frame_number, places)]
    worst = max(abs(y - height) for (_, y, _), height in zip(places, heights))
    # Queries are within 8 micrometres of an oracle. A coordinate is a 32-bit float: half a step at
    # the far end horizontally, which is as much in height on a slope of 1, and half a step more for
    # a program that rotates the mesh.
    farthest = max(max(abs(x), abs(z)) for x, _, z in places)
    bound = 8e-6 + float_step(farthest)
    # Godot 3 truncates extra bits: one step of height, and one horizontal step on a slope of 1
    if bits < 24:
        bound += 2 * float_step(max(-frame["height_min_m"], frame["height_max_m"])) * 2 ** (24 - bits)
    print(f"frame {frame_number}: {len(places)} vertices, at most {worst:.2g} m from query's height (bound {bound:.2g})")
    assert worst < bound
    highest = max(abs(y) for _, y, _ in places)
    assert highest > 0.25 * frame["significant_wave_height_m"], f"{highest} m is a flat sea"
