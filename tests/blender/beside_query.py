"""Holds vertices in Blender to what the command line says of the same sea, at the same time, at the same points."""
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
    """sea: options of the command line; points: x and z. Columns by name."""
    with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
        file.writelines(f"{x!r},{z!r}\n" for x, z in points.tolist())
        file.flush()
        answer = run(pelagic, "query", *sea, "--time", repr(time_s), "--points", file.name, "--interpolation", "linear", *options)
    rows = list(csv.reader(answer.splitlines()))
    columns = numpy.array(rows[1:], float).T
    return dict(zip(rows[0], columns))


def hash_of(pelagic, sea, time_s):
    """Of the frame, by an export of the command line."""
    with tempfile.TemporaryDirectory() as folder:
        run(pelagic, "export", "--out", folder, *sea, "--start", repr(time_s), "--frames", 1, "--maps", "displacement", "--half")
        with open(folder + "/sea.json") as file:
            return json.load(file)["frames"][0]["hash"]


def compare(pelagic, sea, time_s, object, place=(0, 0), folds=0.0, vertices=None):
    """Each vertex lies on the surface that `query` tells of. folds: which part of them may lie below another sheet of a breaking crest, of
    which query tells the highest."""
    vertices = vertices_of(object) if vertices is None else vertices
    points = numpy.stack([vertices[:, 0].astype(float) + place[0], -(vertices[:, 1].astype(float) + place[1])], axis=1)
    sea_there = ask(pelagic, sea, time_s, points, "--foam") if "foam" in object.data.attributes else ask(pelagic, sea, time_s, points)
    off = sea_there["height"] - vertices[:, 2]
    is_below = off > bound_m
    assert is_below.mean() <= folds, f"{is_below.sum()} of {len(off)} vertices lie up to {off.max()} m below the sea"
    worst = numpy.abs(off[~is_below]).max()
    print(f"t = {time_s!r} s: {len(off)} vertices, at most {worst:.2g} m from query's height, {is_below.sum()} under crests")
    assert worst <= bound_m
    assert vertices[:, 2].std() > 1e-4, "a flat sea tells nothing"
    return sea_there, ~is_below
