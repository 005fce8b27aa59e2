# Every command line and script of docs/users/godot.md, in a folder that has the build where the page has it.
# usage: page_test.py SOURCE BUILD GOLDEN_HASHES
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from engine import run, run_headless

source, build, golden_file = sys.argv[1:]
golden = dict(line.split() for line in Path(golden_file).read_text().splitlines())
page = Path(source, "docs/users/godot.md").read_text()
lines = re.findall(r"^    (\S.*)$", page, re.MULTILINE)
scripts = dict(zip(re.findall(r"`(\w+\.gd)`:$", page, re.MULTILINE), re.findall(r"^```gdscript\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)))
assert sorted(scripts) == ["buoy.gd", "server.gd"], "the page has other scripts than this test knows"
assert len(lines) == 9, "the page has other lines than this test knows"

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

DESCRIBED = """
extends SceneTree
func _init():
	var ocean = load("res://addons/pelagic/ocean.gdns").new()
	for property in ocean.get_script().get_script_property_list():
		print("SAYS property %s %d %s" % [property["name"], property["hint"], property["hint_string"]])
	for method in ocean.get_script().get_script_method_list():
		print("SAYS method ", method["name"])
	ocean.free()
	quit()
"""
hint_none, hint_range, hint_exp_range, hint_enum, hint_resource_type = 0, 1, 2, 3, 17


def difference(first, second):
    """Of two images of one size: the mean of all bytes' differences."""
    images = [subprocess.run(["pngtopnm", file], capture_output=True, check=True).stdout for file in (first, second)]
    headers, bytes_of = zip(*((image[:15], image[15:]) for image in images))
    assert headers == (b"P6\n640 360\n255\n",) * 2, headers
    return sum(abs(a - b) for a, b in zip(*bytes_of)) / len(bytes_of[0])


with tempfile.TemporaryDirectory() as work:
    os.chdir(work)
    Path("build").mkdir()
    Path("build/release").symlink_to(build)
    # What Godot writes into a project is not left in the build.
    said = {}
    for line in lines:
        print(line, flush=True)
        command = line
        if line == "cmake --preset release":
            command = f"cmake --list-presets=configure -S {source}"  # that there is one of this name is enough: this is its build
        elif line.startswith("godot3 "):
            quits = "" if " -s " in line else " --quit"
            command = line.replace("godot3 ", "xvfb-run -a -s '-screen 0 1280x800x24' godot3 --audio-driver Dummy ", 1) + quits
        elif line.startswith("godot3-server"):
            for name, script in scripts.items():
                Path("my_game", name).write_text(script)
        said[line] = run(["bash", "-e", "-o", "pipefail", "-c", command], work, {}, 560)["lines"]

    assert any('"release"' in line for line in said["cmake --preset release"])
    image = Path(build, "godot/image.png")
    # A driver may round otherwise; another sea, camera or time differs by 10 and more. The page's image has 200 colours.
    apart = difference(image, Path(source, "docs/images/godot.png"))
    image.unlink()
    assert apart < 3, f"the page's image is {apart} off"

    [server] = [words for line, words in said.items() if line.startswith("godot3-server")]
    [query] = [words for line, words in said.items() if "query" in line]
    [answer] = [line for line in server if re.fullmatch(r"[0-9a-f]{16} -?[0-9.]+", line)]
    hash_there, height_m = answer.split()
    assert hash_there == golden["preset-moderate@12.34"].zfill(16), answer
    assert abs(float(query[1].split(",")[2]) - float(height_m)) < 1e-6, (query, answer)

    Path("buoy_test.gd").write_text(BUOY)
    buoy = run_headless("my_game", Path(work, "buoy_test.gd"), work, {})
    assert buoy["buoy"] == ["True"], buoy["lines"]
    # The page's tables have the node's properties and methods, all of them, and the editor has a range or choices for each number and name.
    Path("described.gd").write_text(DESCRIBED)
    node = run_headless("my_game", Path(work, "described.gd"), work, {})
    first_cells = [line.split("|")[1] for line in page.splitlines() if line.startswith("| `")]
    written = [name for cell in first_cells for name in re.findall(r"`(\w+)[`(]", cell)]
    hints = {words.split()[0]: words.split()[1:] for words in node["property"]}
    methods = [name for name in node["method"] if not name.startswith("_")]
    assert sorted(written) == sorted([*hints, *methods]), (written, hints, methods)
    without = [name for name, hint in hints.items() if int(hint[0]) not in (hint_range, hint_exp_range, hint_enum, hint_resource_type)]
    assert without == ["foam", "velocities", "time_s", "playing"], without
print(f"the image is {apart:.2f} off")
