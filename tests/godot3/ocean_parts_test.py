# Dynamic waves and shores of the node PelagicOcean: hashes and samples are the golden ones, saved
# states continue bit-identically, and invalid values are reported.
# usage: ocean_parts_test.py PROJECT GOLDEN_VALUES
import json
import struct
import sys
import tempfile
from pathlib import Path

from engine import run_headless, single

project, golden_file = sys.argv[1:]
here = Path(__file__).parent

# The scene of tests/golden_values_test.cpp: a beach with an island in front of it.
sea = {"cascades": 3, "resolution": 32, "wind_speed_mps": 8, "loop_period_s": 40, "velocities": True,
       "dynamic_waves": True, "dynamic_waves_resolution": 64, "dynamic_waves_border_m": 8}
shore = {"shore_columns": 81, "shore_rows": 61, "shore_metres_per_sample": 5, "shore_corner_x_m": -170, "shore_corner_z_m": -130,
         "shore_resolution": 64}
heights_m = [-12 + x * 0.035 + 16 / (1 + squared * squared) for z in range(0, 305, 5) for x in range(0, 405, 5)
             for squared in [((x - 150) * (x - 150) + (z - 120) * (z - 120)) / 1600]]
points = [1.5, 0.25, -7.25, 4, 12, -9.75, 3, -2, 60, 40.5, 150.5, 10, -60, 100, 400, -1000]
stone = {"mode": "impulse", "x_m": 3, "z_m": -2, "radius_m": 2, "height_m": 0.4}
boat = {"shape": "hull", "x_m": -10, "z_m": 5, "radius_m": 1, "length_m": 4, "height_m": -0.5, "velocity_x_mps": 6}

spray_sea = {"cascades": 3, "resolution": 32, "wind_speed_mps": 18, "loop_period_s": 40, "spray": True}
bow = {"time_s": 2, "x_m": 1, "y_m": 2, "z_m": -4, "extent_m": 0.5, "velocity_x_mps": 3, "velocity_y_mps": 4, "spread_mps": 1, "radius_m": 0.0625,
       "count": 10}

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


def golden(kind):
    """Returns the numbers of rows of tests/golden/values.txt."""
    return [numbers for of, _, *numbers in map(str.split, Path(golden_file).read_text().splitlines()) if of == kind]


with tempfile.TemporaryDirectory() as folder:
    work = Path(folder)
    (work / "heights").write_bytes(struct.pack(f"<{len(heights_m)}f", *heights_m))
    (work / "points").write_bytes(struct.pack("<16f", *points))
    given = {"sea": sea, "shore_sea": {**sea, **shore}, "stone": stone, "boat": boat, "spray_sea": spray_sea, "bow": bow, "refused": [wrong[:3] for wrong in refused]}
    says = run_headless(project, here / "ocean_parts.gd", work, {"GIVEN": json.dumps(given), "FILES": folder})
    assert single(says, "no_errors") == "[]"
    hashes = [words.split()[1:] for words in says["waves"]]
    assert hashes == [[frame, waves] for frame, _, waves, _ in golden("waves")], hashes
    samples = struct.unpack("<56I", (work / "samples").read_bytes())
    found = [[f"{bits:08x}" for bits in samples[7 * i:7 * i + 7]] for i in range(8)]
    assert found == [numbers[:7] for numbers in golden("linear")], found
    assert single(says, "has_depth") == "True"

    for name in ("restored_elsewhere", "restored", "in_flight", "unchanged"):
        assert single(says, name) == "True", name
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
    assert says["restored_spray"] == ["True"] * 2
    for said, [hash_, count], first, last in zip(says["spray"], golden("spray"), golden("droplet")[::2], golden("droplet")[1::2]):
        found_hash, found_count, *numbers = json.loads(said)
        assert [found_hash, int(found_count)] == [hash_, int(count, 16)], said
        places = [struct.unpack(">d" if len(bits) == 16 else ">f", bytes.fromhex(bits))[0] for bits in first[:6] + last[:6]]
        # JSON has six digits or more of a number.
        assert all(abs(a - b) <= 1e-5 * max(1, abs(b)) for a, b in zip(numbers, places)), (numbers, places)
    assert json.loads(single(says, "spray_refused")) == ["count 9000 is out of range [0, 8192]", "the ocean has no spray: set spray to true"]
print(f"{2 * len(hashes)} hashes, {len(samples)} numbers and {len(refused) + len(together)} errors agree")
