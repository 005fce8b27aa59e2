# What Godot draws of the sea, pixel by pixel: where a pixel's water is must be where `pelagic query` has it, no pixel of the sea is missing,
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

project, pelagic = sys.argv[1:]
width, height, fov = 320, 180, 50.0
smooth = {"patch_size_m": 250, "resolution": 64, "wind_direction_deg": 30, "time_s": 12.34}
as_flags = {"patch_size_m": "--patch-size", "resolution": "--resolution", "wind_direction_deg": "--wind-direction",
            "time_s": "--time", "wind_speed_mps": "--wind-speed"}
cases = [
    # Texels of 3.9 m under a mesh of 0.5 m: what a triangle cuts off is small, so the bound is tight.
    {"values": {**smooth, "quality": "ultra"}, "from": [10, 9, -4], "to": [120, 0, 60]},
    # The default sea, in cascades that are turned. Its mesh of 2 m holds waves down to some 6 m.
    {"values": {"wind_direction_deg": 30, "time_s": 12.34}, "from": [10000, 12, -7000], "to": [9900, 0, -6930]},
]
cases.append({**cases[0], "wall": [60, 0.5, 25]})


def directions(case):
    """Of the rays through the pixels' middles, row by row from the top."""
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
    """Distance and kind: 0 nothing, where the third number is that of the background, 1 sea, 2 wall."""
    halves = struct.iter_unpack("<4e", Path(file).read_bytes())
    return [(whole + part, round(kind / 4)) for whole, part, kind, _ in halves]


def heights(case, places):
    flags = [word for name, value in case["values"].items() if name in as_flags for word in (as_flags[name], str(value))]
    text = "x,z\n" + "".join(f"{x!r},{z!r}\n" for x, z in places)
    out = subprocess.run([pelagic, "query", "--points", "-", "--interpolation", "linear", *flags], input=text, capture_output=True, text=True, check=True).stdout
    return [float(line.split(",")[2]) for line in out.splitlines()[1:]]


def part(numbers, share):
    return sorted(numbers)[min(int(share * len(numbers)), len(numbers) - 1)]


with tempfile.TemporaryDirectory() as work:
    says = run_drawing(project, Path(__file__).parent / "drawn.gd", work, {
        "CASES": json.dumps({"width": width, "height": height, "fov": fov, "cases": cases}), "IMAGES": work})
    assert "refused" not in says, says["refused"]
    assert len(says["case"]) == len(cases), says["lines"]
    images = [pixels(Path(work, f"{number}.rgbah")) for number in range(len(cases))]

for number, (case, image) in enumerate(zip(cases, images)):
    assert len(image) == width * height
    if "wall" in case:
        continue
    rays = list(directions(case))
    # Sea wherever the ray goes down by more than the flat skirt's end is down: 20 km away. None where it climbs over the highest wave.
    for (distance_m, kind), ray in zip(image, rays):
        if ray[1] < -0.003:
            assert kind == 1, ("a hole", ray)
        if ray[1] > 0.1:
            assert kind == 0, ("water in the sky", ray)
    # Without its waves' fade, which begins 5/16 of 2048 m away.
    seen = [(distance_m, [o + distance_m * d for o, d in zip(case["from"], ray)])
            for (distance_m, kind), ray in zip(image, rays) if kind == 1 and distance_m < 600]
    assert len(seen) > width * height / 2, len(seen)
    truth = heights(case, [(at[0], at[2]) for _, at in seen])
    errors = [(abs(at[1] - h), distance_m) for (distance_m, at), h in zip(seen, truth)]
    rms = math.sqrt(sum(e * e for e, _ in errors) / len(errors))
    deviation = math.sqrt(sum(h * h for h in truth) / len(truth) - (sum(truth) / len(truth)) ** 2)
    near = [e for e, distance_m in errors if distance_m < 100]
    if number == 0:
        # Half a texel off, a cascade turned or mirrored, or another time would be 0.1 m or more in the middle of all pixels. What is left
        # is half floats (1 mm), distances in steps of 0.5 mm and, at crests, the triangles of 0.5 m: 23 mm at most when this was written.
        assert part(near, 0.5) < 0.001 and max(near) < 0.05, (part(near, 0.5), max(near))
        assert part([e for e, _ in errors], 0.999) < 0.05
    else:
        # A mesh of 2 m lacks waves below some 6 m, a fifteenth of this sea's height.
        assert rms < 0.1 * deviation and max(near) < deviation, (rms, deviation, max(near))
    print(f"case {number}: {len(seen)} pixels of water, {deviation:.3f} m rms, are {rms:.4f} m off rms; {len(near)} nearer than 100 m "
          f"at most {max(near):.4f} m, half of them within {part(near, 0.5):.4f} m")

# The wall stands across the view, 40 m by 4 m, half of it below the water.
case, alone, walled = cases[2], images[0], images[2]
middle = case["wall"]
shown = hidden = 0
for (distance_m, kind), (_, drawn), ray in zip(alone, walled, directions(case)):
    to_wall_m = (middle[2] - case["from"][2]) / ray[2] if ray[2] else -1
    at = [o + to_wall_m * d for o, d in zip(case["from"], ray)]
    beside = max(abs(at[0] - middle[0]) - 20, abs(at[1] - middle[1]) - 2)  # of its edge, metres outside
    if to_wall_m <= 0 or beside > 0.4:
        assert drawn == kind, ("the wall where it is not", ray)
    elif beside < -0.4 and (kind == 0 or abs(distance_m - to_wall_m) > 0.1):
        is_nearer = kind == 0 or to_wall_m < distance_m
        assert drawn == (2 if is_nearer else 1), ("wall and water change places", ray, distance_m, to_wall_m)
        shown, hidden = shown + is_nearer, hidden + (not is_nearer)
print(f"a wall is seen in {shown} pixels and under water in {hidden}")
assert shown > 100 and hidden > 100
