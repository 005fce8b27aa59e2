# Dynamic waves and shores of the node PelagicOcean: hashes and samples equal those of the command
# line bit for bit, saved states continue bit-identically, and invalid values are reported.
# usage: ocean_parts_test.py PROJECT PELAGIC
import csv
import json
import math
import random
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

from engine import run_headless, single
from floor_image import heights_of, properties_of, write_png

project, pelagic = sys.argv[1:]
here = Path(__file__).parent

sea = {"cascades": 2, "resolution": 32, "wind_speed_mps": 8, "velocities": True,
       "dynamic_waves": True, "dynamic_waves_resolution": 64, "dynamic_waves_depth_m": 4000}
sea_flags = ["--cascades", "2", "--resolution", "32", "--wind-speed", "8"]
stone = {"mode": "impulse", "x_m": 3, "z_m": -2, "radius_m": 2, "height_m": 0.4}
boat = {"shape": "hull", "x_m": -10, "z_m": 5, "radius_m": 1, "length_m": 4, "height_m": -0.5, "velocity_x_mps": 6}
events = ("time,x,z,radius,height,velocity,heading,duration,length,mode\n"
          "0.5,3,-2,2,0.4,,,,,impulse\n"
          "0.7,-10,5,1,-0.5,6,0,1.5,4,pressure\n")

# An island in a bay, deeper towards -x.
floor = [[max(0, min(255, int(220 * math.exp(-4 * (x * x + z * z)) + 30 * x))) for x in (i / 23.5 - 1 for i in range(48))]
         for z in (j / 19.5 - 1 for j in range(40))]
floor_width_m = 1000

keys = "x_m, z_m, radius_m, length_m, heading_rad, height_m, rate_per_s, velocity_x_mps or velocity_z_mps"
refused = [
    ("property", "dynamic_waves_resolution", 100,
     "dynamic_waves_resolution is 100, expected 64, 128, 256, 512 or 1024"),
    ("property", "dynamic_waves_side_m", "wide", "dynamic_waves_side_m wide is out of range [1, 10000]"),
    ("property", "dynamic_waves_step", "euler", "dynamic_waves_step is euler, expected spectral or verlet"),
    ("property", "dynamic_waves_ticks_per_s", 60.5, "dynamic_waves_ticks_per_s 60.5 is out of range [10, 240]"),
    ("property", "shore_columns", 1, "shore_columns is 1, expected 2 to 4096"),
    ("property", "shore_swash_m", -2, "shore_swash_m -2 is out of range [0, 10], or -1: derived"),
    ("property", "shore_heights_m", 3, "shore_heights_m is 3, expected a PoolRealArray"),
    ("method", "add_impulse", [{**stone, "radius_m": 0}], "radius_m 0 is out of range [0.001, 1000]"),
    ("method", "add_impulse", [{**stone, "radius_m": "wide"}], "radius_m wide is out of range [0.001, 1000]"),
    ("method", "add_impulse", [{**stone, "mode": "pull"}], "mode is pull, expected pressure, relaxation, impulse or foam"),
    ("method", "add_source", [{"radius": 3}], f"the key is radius, expected shape, mode, {keys} (the nearest is radius_m)"),
    ("method", "add_source", [3], "add_source is called as add_source(source)"),
    ("method", "set_source", [-1, boat], "number is -1, expected a number that add_source() returned"),
    ("method", "remove_source", [1.5], "number is 1.5, expected a number that add_source() returned"),
    ("method", "set_rain", [{"seed": 0.5}], "seed is 0.5, expected a whole number from 0 to 4294967295"),
    ("method", "set_rain", [{"drops_per_m2_s": 1, "radius_m": 9}],
     "radius_m 9 is out of range [0.001, 4], to a 16th of side_m"),
    ("method", "restore_state", [[1]], "restore_state is called as restore_state(saved)"),
]
together = [
    "dynamic_waves_border_m is 2000, expected at most a quarter of side_m, 16",
    "shore_columns is 0, expected 2 to 4096",
    "shore_heights_m' size is 3, expected 4, columns times rows",
    "cascades is 1, expected 2 to 4 where there is a shore, which takes the coarsest cascade's waves",
]


def assert_samples(file, rows, columns):
    """Compares a file of floats with rows of `pelagic query`, to the last bit."""
    samples = file.read_bytes()
    size = 4 * len(columns)
    assert len(samples) == size * len(rows), (len(samples), len(rows))
    for i, row in enumerate(rows):
        expected = struct.pack(f"<{len(columns)}f", *(float(row[column]) for column in columns))
        assert samples[size * i:size * (i + 1)] == expected, (columns, row)


with tempfile.TemporaryDirectory() as folder:
    work = Path(folder)
    (work / "events.csv").write_text(events)
    (work / "heights").write_bytes(heights_of(floor))
    write_png(work / "floor.png", floor)
    generator = random.Random(5)
    reaches_m = [20] * 500 + [600] * 500  # of dynamic waves, of the shore
    points = [struct.unpack("<ff", struct.pack("<ff", *(generator.uniform(-reach, reach) for _ in range(2))))
              for reach in reaches_m]
    (work / "points").write_bytes(b"".join(struct.pack("<ff", *point) for point in points))
    given = {"sea": sea, "shore_sea": {**sea, **properties_of(floor, floor_width_m)}, "stone": stone, "boat": boat,
             "refused": [wrong[:3] for wrong in refused]}
    says = run_headless(project, here / "ocean_parts.gd", work, {"GIVEN": json.dumps(given), "FILES": folder})
    assert single(says, "no_errors") == "[]"

    grid = ["--events", work / "events.csv", "--events-resolution", "64", "--events-at", "0,0"]
    subprocess.run([pelagic, "export", "--out", work / "out", *sea_flags, "--fps", "4", "--frames", "2-11",
                    "--maps", "displacement", "--no-sync", *grid], capture_output=True, check=True)
    frames = json.loads((work / "out/sea.json").read_text())["frames"]
    wanted = [f"{round(60 * frame['time_s'])} {frame['hash']} {frame['dynamic_waves_hash']}" for frame in frames]
    assert says["waves"] == wanted, (says["waves"], wanted)
    assert len({words.split()[2] for words in wanted}) == len(wanted) == 10
    # The shore changes neither the cascades nor the dynamic waves.
    assert says["shore"] == wanted[:7], (says["shore"], wanted)

    columns = ["height", "nx", "ny", "nz", "vx", "vy", "vz"]
    text = "x,z\n" + "".join(f"{x!r},{z!r}\n" for x, z in points)
    heights = {}
    for name, flags, more in (("open", [], []), ("waves", grid, []),
                              ("shore", [*grid, "--shore", "--floor", work / "floor.png"], ["depth"])):
        done = subprocess.run([pelagic, "query", "--points", "-", "--time", "2", "--interpolation", "linear",
                               *sea_flags, *flags], input=text, capture_output=True, text=True, check=True)
        rows = list(csv.DictReader(done.stdout.splitlines()))
        heights[name] = [float(row["height"]) for row in rows]
        if name != "open":
            assert_samples(work / name, rows, columns + more)
    assert any(float(row["depth"]) < 0 for row in rows)
    # Dynamic waves and the shore change the heights that were compared.
    for one, other, first, end in (("open", "waves", 0, 500), ("waves", "shore", 500, 1000)):
        apart = [abs(a - b) for a, b in zip(heights[one][first:end], heights[other][first:end])]
        assert max(apart) > 0.05 and sum(a > 0.001 for a in apart) > 100, (one, other, max(apart))

    for name in ("restored_elsewhere", "restored", "in_flight", "unchanged"):
        assert single(says, name) == "True", name
    assert len(set(json.loads(single(says, "ends")))) == 4, says["ends"]
    [damaged] = json.loads(single(says, "damaged"))
    assert "\n" not in damaged and "saved" in damaged, damaged
    assert len(says["refused"]) == len(refused)
    for (_, _, _, line), said in zip(refused, says["refused"]):
        assert json.loads(said) == [line], (said, line)
        assert "PelagicOcean: " + line in says["lines"], line
    assert says["answer"] == ["True"] * sum(wrong[0] == "method" for wrong in refused)
    assert [json.loads(said) for said in says["together"]] == [[line] for line in together], says["together"]
    assert single(says, "off") == "True True"
    assert json.loads(single(says, "off_refused")) == ["the ocean has no dynamic waves: set dynamic_waves to true"] * 2
print(f"{len(wanted) + 7} hashes, {2 * len(points)} samples and {len(refused) + len(together)} errors agree")
