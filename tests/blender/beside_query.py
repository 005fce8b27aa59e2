"""Compares vertices in Blender with the command line's answers at equal times and points."""
import csv
import json
import subprocess
import tempfile

import numpy

bound_m = 1e-5


def vertices_of(object):
    vertices = numpy.empty(len(object.data.vertices) * 3, numpy.float32)
    object.data.vertices.foreach_get("co", vertices)
    return vertices.reshape(-1, 3)


def values_of(object, name, field="value", width=1):
    data = object.data.attributes[name].data
    values = numpy.empty(len(data) * width, numpy.float32)
    data.foreach_get(field, values)
    return values.reshape(-1, width) if width > 1 else values


def run(pelagic, *arguments):
    return subprocess.run([pelagic, *map(str, arguments)], check=True, capture_output=True, text=True).stdout


def ask(pelagic, sea, time_s, points, *options):
    """Returns the columns of `pelagic query` by name. sea: its options; points: x and z."""
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.writelines(f"{x!r},{z!r}\n" for x, z in points.tolist())
        file.flush()
        answer = run(pelagic, "query", *sea, "--time", repr(time_s), "--points", file.name, "--interpolation", "linear", *options)
    rows = list(csv.reader(answer.splitlines()))
    columns = numpy.array(rows[1:], float).T
    return dict(zip(rows[0], columns))


def hash_of(pelagic, sea, time_s):
    """Returns the frame's hash by `pelagic export`."""
    with tempfile.TemporaryDirectory() as folder:
        run(pelagic, "export", "--out", folder, *sea, *([] if "--loop-period" in sea else ["--loop-period", 3600]), "--start", repr(time_s), "--frames", 1, "--maps", "displacement", "--half")
        with open(folder + "/sea.json") as file:
            return json.load(file)["frames"][0]["hash"]


def compare(pelagic, sea, time_s, object, place=(0, 0), folds=0.0, vertices=None):
    """Checks that each vertex lies on the surface of `pelagic query`, within bound_m.

    folds: fraction of the vertices that may lie below an overturning crest, where query returns the
    highest surface"""
    vertices = vertices_of(object) if vertices is None else vertices
    points = numpy.stack([vertices[:, 0].astype(float) + place[0], -(vertices[:, 1].astype(float) + place[1])], axis=1)
    options = ["--foam"] if "foam" in object.data.attributes else []
    sea_there = ask(pelagic, sea, time_s, points, *options)
    off = sea_there["height"] - vertices[:, 2]
    is_below = off > bound_m
    assert is_below.mean() <= folds, f"{is_below.sum()} of {len(off)} vertices lie up to {off.max()} m below the sea"
    worst = numpy.abs(off[~is_below]).max()
    print(f"t = {time_s!r} s: {len(off)} vertices, at most {worst:.2g} m from query's height, {is_below.sum()} under crests")
    assert worst <= bound_m
    assert vertices[:, 2].std() > 1e-4, "a flat sea tests nothing"
    return sea_there, ~is_below
