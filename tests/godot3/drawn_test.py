# Images of the sea in Godot: the water of each pixel is where `pelagic query` has it and has its
# normal, also with dynamic waves, a shore, a tide and a current, no pixel of the sea is missing,
# and a wall in the water is hidden exactly where water is nearer.
# usage: drawn_test.py PROJECT PELAGIC
import json
import math
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

from engine import run_drawing
from floor_image import heights_of, properties_of, write_png

project, pelagic = sys.argv[1:]
width, height, fov = 320, 180, 50.0
smooth = {"patch_size_m": 250, "resolution": 64, "wind_direction_deg": 30, "time_s": 12.34}
as_flags = {"patch_size_m": "--patch-size", "resolution": "--resolution", "wind_direction_deg": "--wind-direction",
            "time_s": "--time", "wind_speed_mps": "--wind-speed", "cascades": "--cascades",
            "swell_height_m": "--swell-height", "swell_period_s": "--swell-period"}
cases = [
    # Texels of 3.9 m and triangles of 0.5 m: the difference between them is small, so the bounds
    # are tight.
    {"values": {**smooth, "quality": "ultra"}, "from": [10, 9, -4], "to": [120, 0, 60]},
    # The default sea with rotated cascades. The mesh of 2 m resolves waves longer than about 6 m.
    {"values": {"wind_direction_deg": 30, "time_s": 12.34}, "from": [10000, 12, -7000], "to": [9900, 0, -6930]},
]
cases.append({**cases[0], "wall": [60, 0.5, 25]})

# Swell of a few wavelengths per cascade, whose slopes differ little between texels: the image's
# slopes are exact at texels, those of queries are central differences.
swell = {"wind_speed_mps": 1, "swell_height_m": 2, "swell_period_s": 7, "quality": "ultra"}
# Waves of a stone, half a second after it fell.
stone = {"mode": "impulse", "x_m": 45, "z_m": 16, "radius_m": 3, "height_m": 1}
cases.append({**cases[0], "ticks": [720, 751], "center": [50, 19], "stone": stone, "flags": ["--events", "events.csv", "--events-at", "50,19"],
              "values": {**smooth, **swell, "dynamic_waves": True, "dynamic_waves_depth_m": 4000, "time_s": 751 / 60}})
events = f"time,x,z,radius,height,mode\n{721 / 60!r},45,16,3,1,impulse\n"

# An island 6 m high in water 20 m deep.
floor = [[int(220 * math.exp(-(x * x + z * z) / 8)) for x in range(-12, 13)] for z in range(-10, 11)]
floor_width_m = 1000
cases.append({"values": {**swell, "cascades": 2, "resolution": 64, "time_s": 12.34,
                         **properties_of(floor, floor_width_m)},
              "heights": "heights", "flags": ["--shore", "--floor", "floor.png"], "from": [-300, 9, -60], "to": [-160, 0, 0]})
# A tide of 3 m, and a current that has moved the waves by 25 m along x.
cases.append({"values": {**cases[0]["values"], "sea_level_m": 3, "current_x_mps": 2, "current_z_mps": -1},
              "water": ["--sea-level", "3", "--current", "2,-1"], "from": [10, 12, -4], "to": [120, 3, 60]})
first_of_normals = len(cases)  # images with the components of the normal
cases += [{**case, "normals": True} for case in cases if "flags" in case]


def directions(case):
    """Yields unit vectors of the rays through the pixels' centres, row by row from the top."""
    back = [a - b for a, b in zip(case["from"], case["to"])]
    length = math.sqrt(sum(c * c for c in back))
    back = [c / length for c in back]
    right = [back[2], 0, -back[0]]
    length = math.hypot(right[0], right[2])
    right = [c / length for c in right]
    up = [back[1] * right[2] - back[2] * right[1], back[2] * right[0] - back[0] * right[2], back[0] * right[1] - back[1] * right[0]]
    tangent = math.tan(math.radians(fov / 2))
    for j in range(height):
        for i in range(width):
            a = (2 * (i + 0.5) / width - 1) * tangent * width / height
            b = (1 - 2 * (j + 0.5) / height) * tangent
            d = [a * right[k] + b * up[k] - back[k] for k in range(3)]
            length = math.sqrt(sum(c * c for c in d))
            yield [c / length for c in d]


def pixels(file):
    """Returns distance and kind of each pixel: 0 background, 1 sea, 2 wall."""
    halves = struct.iter_unpack("<4e", Path(file).read_bytes())
    return [(whole + part, round(kind / 4)) for whole, part, kind, _ in halves]


def normals(file):
    return [[2 * (c - 0.5) for c in texel[:3]] for texel in struct.iter_unpack("<4e", Path(file).read_bytes())]


def query(case, places, flags, folder):
    """Returns height and normal of each place."""
    flags = [*flags, *case.get("water", []), *(word for name, value in case["values"].items() if name in as_flags
                       for word in (as_flags[name], repr(value)))]
    text = "x,z\n" + "".join(f"{x!r},{z!r}\n" for x, z in places)
    out = subprocess.run([pelagic, "query", "--points", "-", "--interpolation", "linear", *flags], input=text,
                         capture_output=True, text=True, check=True, cwd=folder).stdout
    return [[float(number) for number in line.split(",")[2:6]] for line in out.splitlines()[1:]]


def rms_of(numbers):
    return math.sqrt(sum(number * number for number in numbers) / len(numbers))


def quantile(numbers, fraction):
    return sorted(numbers)[min(int(fraction * len(numbers)), len(numbers) - 1)]


work = tempfile.TemporaryDirectory()
folder = Path(work.name)
(folder / "events.csv").write_text(events)
(folder / "heights").write_bytes(heights_of(floor))
write_png(folder / "floor.png", floor)
says = run_drawing(project, Path(__file__).parent / "drawn.gd", folder, {
    "CASES": json.dumps({"width": width, "height": height, "fov": fov, "cases": cases}), "IMAGES": str(folder)})
assert "refused" not in says, says["refused"]
assert len(says["case"]) == len(cases), says["lines"]
images = [pixels(folder / f"{number}.rgbah") for number in range(first_of_normals)]

for number, (case, image) in enumerate(zip(cases, images)):
    assert len(image) == width * height
    if "wall" in case:
        continue
    rays = list(directions(case))
    # Sea at all rays steeper than the one to the end of the flat skirt, 20 km away. No sea at rays
    # that climb over the highest wave.
    for (distance_m, kind), ray in zip(image, rays):
        if ray[1] < -0.003:
            assert kind == 1, ("a hole", ray)
        if ray[1] > 0.1:
            assert kind == 0, ("water in the sky", ray)
    # Waves fade from 5/16 of 2048 m on.
    shown = [i for i, (distance_m, kind) in enumerate(image) if kind == 1 and distance_m < 600]
    seen = [(image[i][0], [o + image[i][0] * d for o, d in zip(case["from"], rays[i])]) for i in shown]
    assert len(seen) > width * height / 2, len(seen)
    places = [(at[0], at[2]) for _, at in seen]
    samples = query(case, places, case.get("flags", []), folder)
    truth = [sample[0] for sample in samples]
    errors = [(abs(at[1] - h), distance_m) for (distance_m, at), h in zip(seen, truth)]
    rms = rms_of([e for e, _ in errors])
    mean = sum(truth) / len(truth)
    deviation = rms_of([h - mean for h in truth])
    near = [e for e, distance_m in errors if distance_m < 100]
    print(f"case {number}: {len(seen)} pixels of water, {deviation:.3f} m rms, are {rms:.4f} m off rms; {len(near)} nearer than 100 m "
          f"at most {max(near):.4f} m, half of them within {quantile(near, 0.5):.4f} m")
    if number != 1:
        # A texture half a texel off, a rotated or mirrored cascade or another time changes the
        # median by 0.1 m or more. Expected errors: half floats (1 mm), distances in steps of
        # 0.5 mm and, at crests, triangles of 0.5 m (23 mm).
        assert quantile(near, 0.5) < 0.001 and max(near) < 0.05, (quantile(near, 0.5), max(near))
        assert quantile([e for e, _ in errors], 0.999) < 0.05
    else:
        # A mesh of 2 m lacks waves below some 6 m, a fifteenth of this sea's height.
        assert rms < 0.1 * deviation and max(near) < deviation, (rms, deviation, max(near))
    if "flags" in case:
        # What dynamic waves or the shore add to heights and normals, in queries and in the image.
        without = query(case, places, [], folder)
        added = [h - sample[0] for h, sample in zip(truth, without)]
        drawn = normals(folder / f"{first_of_normals}.rgbah")
        first_of_normals += 1
        pixels_near = [(drawn[i], sample[1:], other[1:]) for i, (distance_m, _), sample, other in zip(shown, seen, samples, without)
                       if distance_m < 100]
        turns = [[b - c for b, c in zip(normal, other)] for _, normal, other in pixels_near]
        drawn_turns = [[a - c for a, c in zip(image, other)] for image, _, other in pixels_near]
        angles = [math.dist(image, normal) for image, normal, _ in pixels_near]
        part = sum(a * b for turn, drawn_turn in zip(turns, drawn_turns) for a, b in zip(turn, drawn_turn)) / sum(a * a for turn in turns for a in turn)
        print(f"case {number}: {case['flags'][0]} adds {rms_of(added):.4f} m rms, at most {max(map(abs, added)):.3f} m; normals are turned by "
              f"{part:.3f} of what queries are, and differ by {quantile(angles, 0.5):.4f}")
        assert rms_of(added) > 0.02 and max(map(abs, added)) > 0.3, (rms_of(added), max(map(abs, added)))
        # Slopes without dynamic waves or the shore give 0, with the wrong sign -1. Expected
        # deviation: bytes of the slopes and mips.
        assert 0.85 < part < 1.15 and quantile(angles, 0.5) < 0.01, (part, quantile(angles, 0.5))

# The wall faces the camera, is 40 m by 4 m, and half of it is below the water.
case, alone, walled = cases[2], images[0], images[2]
middle = case["wall"]
shown = hidden = 0
for (distance_m, kind), (_, drawn), ray in zip(alone, walled, directions(case)):
    to_wall_m = (middle[2] - case["from"][2]) / ray[2] if ray[2] else -1
    at = [o + to_wall_m * d for o, d in zip(case["from"], ray)]
    outside_m = max(abs(at[0] - middle[0]) - 20, abs(at[1] - middle[1]) - 2)  # of its edges
    if to_wall_m <= 0 or outside_m > 0.4:
        assert drawn == kind, ("the wall where it is not", ray)
    elif outside_m < -0.4 and (kind == 0 or abs(distance_m - to_wall_m) > 0.1):
        is_nearer = kind == 0 or to_wall_m < distance_m
        assert drawn == (2 if is_nearer else 1), ("wall and water change places", ray, distance_m, to_wall_m)
        shown, hidden = shown + is_nearer, hidden + (not is_nearer)
print(f"a wall is seen in {shown} pixels and under water in {hidden}")
assert shown > 100 and hidden > 100
