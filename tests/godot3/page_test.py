# Runs every command line of docs/integrations/godot.md and every script of that page and of the
# nodes' README, in a folder where the build has the page's path. Compares the README's tables with
# the nodes.
# usage: page_test.py SOURCE BUILD GOLDEN_HASHES
import math
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from engine import run, run_headless

source, build, golden_file = sys.argv[1:]
golden = dict(line.split() for line in Path(golden_file).read_text().splitlines())
page = Path(source, "docs/integrations/godot.md").read_text().split("\n## Godot 4\n")[0]
reference = Path(source, "contrib/godot3/README.md").read_text()
lines = re.findall(r"^    (\S.*)$", page, re.MULTILINE)
scripts = dict(re.findall(r"`(\w+\.gd)`[^`]*:\n\n```gdscript\n(.*?)^```$", page + reference, re.MULTILINE | re.DOTALL))
assert sorted(scripts) == ["barrel.gd", "beach.gd", "buoy.gd", "server.gd", "wake.gd"], "the pages have other scripts than this test knows"
assert len(lines) == 10, "the page has other lines than this test knows"

BUOY = """
extends SceneTree
var frames = 0
var ocean = load("res://addons/pelagic/ocean.gdns").new()
var buoy = Spatial.new()
func _init():
	ocean.name = "ocean"
	root.add_child(ocean)
	buoy.set_script(load("res://buoy.gd"))
	buoy.translation = Vector3(4, 0, -9)
	root.add_child(buoy)
func _idle(_seconds):
	frames += 1
	ocean.playing = false
	if frames == 5:
		print("SAYS buoy %s" % str(abs(ocean.height_at(buoy.translation) - buoy.translation.y) < 1e-6 and buoy.translation.y != 0.0))
		quit()
"""

# The boat moves 3 m/s along -z, for 1.5 s.
WAKE = """
extends SceneTree
var frames = 0
var ocean = load("res://addons/pelagic/ocean.gdns").new()
var boat = Spatial.new()
func _init():
	ocean.name = "ocean"
	ocean.dynamic_waves = true
	root.add_child(ocean)
	boat.set_script(load("res://wake.gd"))
	boat.rotation.y = PI / 2
	root.add_child(boat)
func _idle(_seconds):
	frames += 1
	boat.translation.z -= 3.0 / 60
	if frames == 90:
		ocean.playing = false
		var places = PoolVector3Array()
		for i in range(-8, 9):
			places.append(boat.translation + Vector3(i, 0, 0))
			places.append(boat.translation + Vector3(0, 0, i))
		var heights = ocean.query(places)["height"]
		ocean.dynamic_waves = false
		var without = ocean.query(places)["height"]
		for i in range(places.size()):
			print("SAYS added %.9f" % (heights[i] - without[i]))
		quit()
"""

DESCRIBED = """
extends SceneTree
func _init():
	for name in ["ocean", "hull"]:
		var node = load("res://addons/pelagic/%s.gdns" % name).new()
		for property in node.get_script().get_script_property_list():
			print("SAYS property %s %d %s" % [property["name"], property["hint"], property["hint_string"]])
			print("SAYS default %s %s" % [property["name"], node.get(property["name"])])
		for method in node.get_script().get_script_method_list():
			print("SAYS method ", method["name"])
		node.free()
	quit()
"""
hint_none, hint_range, hint_exp_range, hint_enum, hint_resource_type = 0, 1, 2, 3, 17


def difference(first, second):
    """Returns the mean difference of the bytes of two images of 640 x 360 pixels."""
    images = [subprocess.run(["pngtopnm", file], capture_output=True, check=True).stdout for file in (first, second)]
    headers, bytes_of = zip(*((image[:15], image[15:]) for image in images))
    assert headers == (b"P6\n640 360\n255\n",) * 2, headers
    return sum(abs(a - b) for a, b in zip(*bytes_of)) / len(bytes_of[0])


with tempfile.TemporaryDirectory() as work:
    os.chdir(work)
    Path("build").mkdir()
    Path("build/release").symlink_to(build)
    said = {}
    for line in lines:
        print(line, flush=True)
        command = line
        if line == "cmake --preset release":
            # BUILD is the build of this preset, which only has to exist.
            command = f"cmake --list-presets=configure -S {source}"
        elif line.startswith("godot3 "):
            quits = "" if " -s " in line else " --quit"
            command = line.replace("godot3 ", "xvfb-run -a -s '-screen 0 1280x800x24' godot3 --audio-driver Dummy ", 1) + quits
        elif line.startswith("godot3-server"):
            for name, script in scripts.items():
                Path("my_game", name).write_text(script)
        said[line] = run(["bash", "-e", "-o", "pipefail", "-c", command], work, {}, 560)["lines"]

    assert any('"release"' in line for line in said["cmake --preset release"])
    image = Path(build, "godot3/image.png")
    # Drivers round differently, and the page's image has 200 colours. Another sea, camera or time
    # differs by 10 or more.
    apart = difference(image, Path(source, "docs/images/godot.png"))
    image.unlink()
    assert apart < 3, f"the page's image is {apart} off"

    [server] = [words for line, words in said.items() if "server.gd" in line]
    [beach] = [words for line, words in said.items() if "beach.gd" in line]
    [query] = [words for line, words in said.items() if "query" in line]
    [answer] = [line for line in server if re.fullmatch(r"[0-9a-f]{16} -?[0-9.]+", line)]
    hash_there, height_m = answer.split()
    assert hash_there == golden["preset-moderate@12.34"].zfill(16), answer
    assert abs(float(query[1].split(",")[2]) - float(height_m)) < 1e-6, (query, answer)

    # 20 m deep at x = 0, rising by 0.4 m in 4 m.
    [[depth_m, shore_height_m]] = [map(float, line.split()) for line in beach if re.fullmatch(r"-?[0-9.]+ -?[0-9.]+", line)]
    assert abs(depth_m - 10) < 1e-3 and 0 < abs(shore_height_m) < 5, beach

    barrel = run_headless("my_game", "barrel.gd", work, {})["lines"]
    # A prism of 64 sides on a circle of 1 m, of 3 t. After ten seconds in waves it still floats.
    [[draught_m, displaced_m3]] = [map(float, line.split()) for line in barrel if re.fullmatch(r"[0-9.]+ [0-9.]+", line)]
    assert abs(draught_m * 32 * math.sin(math.pi / 32) / (3000 / 1025) - 1) < 0.005, barrel
    assert abs(displaced_m3 / (3000 / 1025) - 1) < 0.5, barrel

    Path("buoy_test.gd").write_text(BUOY)
    buoy = run_headless("my_game", Path(work, "buoy_test.gd"), work, {})
    assert buoy["buoy"] == ["True"], buoy["lines"]
    Path("wake_test.gd").write_text(WAKE)
    wake = run_headless("my_game", Path(work, "wake_test.gd"), work, {}, fps=60)
    assert "refused" not in wake
    added = [float(words) for words in wake["added"]]
    # The hull, 0.5 m deep, presses a trough into the water. Its wake is highest behind the boat.
    assert -1 < min(added) < -0.3 and 0.1 < max(added) < 1, added
    behind, ahead = added[19::2], added[1:16:2]
    assert max(behind) > 4 * max(ahead), added

    # The tables have all properties and methods of the nodes and their numeric defaults. The editor
    # has a range or choices for each number and name.
    Path("described.gd").write_text(DESCRIBED)
    node = run_headless("my_game", Path(work, "described.gd"), work, {})
    first_cells = [line.split("|")[1] for line in reference.splitlines() if line.startswith("| `")]
    written = [name for cell in first_cells for name in re.findall(r"`(\w+)[`(]", cell)]
    properties = [words.split() for words in node["property"]]
    hints = {name: hint for name, *hint in properties}
    methods = [name for name in node["method"] if not name.startswith("_")]
    names = [name for name, *_ in properties]
    assert sorted(written) == sorted([*names, *methods]), (written, names, methods)
    without = [name for name, hint in hints.items() if int(hint[0]) not in (hint_range, hint_exp_range, hint_enum, hint_resource_type)]
    assert without == ["foam", "velocities", "depth", "time_s", "playing", "dynamic_waves", "spray", "shore_heights_m", "ocean",
                       "centre_of_mass_m", "inertia_kgm2", "force_n", "torque_nm", "wind_mps", "wake"], without
    defaults = dict(words.split(" ", 1) for words in node["default"])
    cells = [[cell.strip() for cell in line.split("|")] for line in reference.splitlines() if re.match(r"\| `\w+` \|.*\| -?[0-9.]+ \|$", line)]
    assert len(cells) > 20, cells
    for _, name, *_, default, _ in cells:
        assert float(default) == float(defaults[name.strip("`")]), (name, default, defaults)
print(f"the image is {apart:.2f} off")
