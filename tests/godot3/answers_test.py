# The node PelagicOcean in Godot: its hashes are the golden ones, and it reports invalid values. A thousand frames, with and without a
# window, leak no memory.
# usage: answers_test.py PROJECT PELAGIC GOLDEN_HASHES
import json
import subprocess
import sys
import tempfile
from pathlib import Path

from engine import run_drawing, run_headless, single

project, pelagic, golden_file = sys.argv[1:]
here = Path(__file__).parent
golden = dict(line.split() for line in Path(golden_file).read_text().splitlines())

seas = [{"name": "default", "values": {}}]
seas += [{"name": "preset-" + name, "values": {"preset": name}} for name in ("calm", "moderate", "rough", "storm")]
seas += [{"name": "jonswap-64", "values": {"resolution": 64, "patch_size_m": 250}},
         {"name": "shallow-64", "values": {"resolution": 64, "patch_size_m": 250, "depth_m": 8}}]
refused = [
    ("wind_speed_mps", -3, "wind_speed_mps -3 is out of range (0, 60]"),
    ("wind_speed_mps", "calm", "wind_speed_mps calm is out of range (0, 60]"),
    ("wind_direction_deg", 361, "wind_direction_deg 361 is out of range [-360, 360]"),
    ("depth_m", 0, "depth_m 0 is out of range [0.01, 11000]"),
    ("choppiness", 2, "choppiness 2 is out of range [0, 1]"),
    ("seed", 1.5, "seed is 1.5, expected a whole number from 0 to 4294967295"),
    ("resolution", 100, "resolution is 100, expected a power of two from 16 to 2048, or 0: chosen"),
    ("loop_period_s", 0, "loop_period_s 0 is out of range [0.1, 86400]"),
    ("threads", -1, "threads is -1, expected a whole number from 0 to 1024"),
    ("time_s", 1e12, "time_s 1000000000000 is out of range [-1e9, 1e9]"),
    ("size_m", 10, "size_m 10 is out of range [256, 8192]"),
    ("quality", "best", "quality is best, expected one of low,medium,high,ultra"),
    ("preset", "gale", None),
]
properties = ["preset", "wind_speed_mps", "wind_direction_deg", "fetch_m", "depth_m", "choppiness", "swell_height_m",
              "swell_period_s", "swell_direction_deg", "seed", "loop_period_s", "cascades", "resolution",
              "patch_size_m", "velocities"]

with tempfile.TemporaryDirectory() as work:
    says = run_headless(project, here / "answers.gd", work, {
        "SEAS": json.dumps({"seas": seas, "properties": properties, "refused": [wrong[:2] for wrong in refused]})})

    hashes = dict(words.split() for words in says["hash"])
    for sea in seas:
        for time, said in (("0", "0"), ("12.34", "12.34")):
            name = sea["name"]
            assert hashes[f"{name}@{said}"] == golden[f"{name}@{time}"].zfill(16), (name, time, hashes)
    assert len(hashes) == 2 * len(seas)

    # Presets keep the node's wind direction.
    presets = dict(words.split() for words in says["preset"])
    assert len(presets) > 20 and "custom" in presets, presets
    for name, hash_there in presets.items():
        named = [] if name == "custom" else ["--preset", name]
        info = subprocess.run([pelagic, "info", "--json", "--wind-direction", "30", *named], capture_output=True, text=True, check=True)
        assert json.loads(info.stdout)["first_frame"]["hash"] == hash_there, name

    assert single(says, "same") == "True"
    assert single(says, "shallow") == 'True ["the ocean has no depth: set depth to true"]'
    depth_above_height_m, pressure_pa, velocities, accelerations = map(float, single(says, "water").split())
    assert abs(depth_above_height_m - 3) < 1e-4 and 5e3 < pressure_pa < 60e3 and velocities == accelerations == 1
    hit, drawn_m, water_m = single(says, "hit").split()
    # The hit is within a millimetre of the water. Its position is a float, which adds 2e-6 m at
    # 30 m.
    assert hit == "True" and abs(float(drawn_m) - float(water_m)) < 1.1e-3, says["hit"]
    assert single(says, "miss") == "False"

    assert len(says["refused"]) == len(refused)
    for (name, value, line), said in zip(refused, says["refused"]):
        [only] = json.loads(said)
        assert "\n" not in only and only.startswith(f"{name} "), only
        assert line is None or only == line, (only, line)
        assert "PelagicOcean: " + only in says["lines"], only
    assert says["nothing"] == ["True"] * 3
    assert single(says, "stays") == "True"
    same, why = single(says, "together").split(" ", 1)
    assert same == "True" and json.loads(why)[-1] == "cascades is 4, expected 1 where the side of the cascade is given", why

    for runs in (run_headless, run_drawing):
        frames = runs(project, here / "frames.gd", work, {}, fps=60)
        assert "refused" not in frames
        kib = []
        for words in frames["frame"]:
            number, time_s, x, z, height_m, boat_m, resident = words.split()
            kib.append(int(resident))
            asked = subprocess.run([pelagic, "query", "--points", "-", "--time", time_s, "--wind-speed", "10",
                                    "--wind-direction", "30", "--interpolation", "linear"], input=f"{x},{z}\n", capture_output=True, text=True, check=True).stdout
            # The printed time is rounded to 1e-9 s, in which no water moves a micrometre.
            assert abs(float(asked.splitlines()[1].split(",")[2]) - float(height_m)) < 1e-6, (words, asked)
            # The boat of 6 m floats by the forces of waves with Hm0 2 m.
            assert abs(float(boat_m) - float(height_m)) < 1, words
        assert len(kib) == 3
        assert len(set(words.split()[1] for words in frames["frame"])) == 3
        # A frame's textures are 1.2 MB: a leak in one of fifty frames would be 9.6 MB in 400
        # frames.
        assert kib[2] - kib[1] < 8 * 1024, kib
        print(f"{kib} KiB in frames 200, 600 and 1000")
print(f"{len(hashes) + len(presets)} hashes and {len(refused)} refusals agree")
