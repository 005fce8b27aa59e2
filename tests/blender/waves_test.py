"""Dynamic waves and shores match the command line's: recorded objects, events files, rain, a sea
floor, a bake.

usage: blender -b -P waves_test.py -- PELAGIC FOLDER"""
import json
import math
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import numpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
from beside_query import ask, compare, run, values_of, vertices_of

from pelagic_ocean import dynamic_waves, library, sea_object

pelagic, folder = sys.argv[sys.argv.index("--") + 1:]
folder = Path(folder)
bpy.ops.wm.read_homefile(use_empty=True)
scene = bpy.context.scene
scene.render.fps, scene.frame_start, scene.frame_end = 24, 1, 72


def add(preset, **settings):
    assert bpy.ops.pelagic.add_ocean(preset=preset) == {"FINISHED"}
    ocean = bpy.context.object
    ocean.pelagic.resolution = 64
    for name, value in settings.items():
        setattr(ocean.pelagic, name, value)
    assert not ocean.pelagic.error, ocean.pelagic.error
    return ocean


def waves_hash_of(flags, time_s):
    with tempfile.TemporaryDirectory() as out:
        run(pelagic, "export", "--out", out, *flags, "--start", repr(time_s), "--frames", 1,
            "--maps", "displacement", "--half")
        return json.loads((Path(out) / "sea.json").read_text())["frames"][0]["dynamic_waves_hash"]


def waves_hash(ocean):
    time_s = sea_object.sea_time(ocean.pelagic, scene)
    return f"{sea_object.moved(ocean.pelagic, time_s).frame.dynamic_waves.hash:016x}"


def key_locations(object, *keys):
    for frame, location, turn in keys:
        object.location, object.rotation_euler.z = location, turn
        object.keyframe_insert("location", frame=frame)
        object.keyframe_insert("rotation_euler", frame=frame)


def check_in_another_process(name, frames):
    """Saves the scene and checks that its frames have equal vertices, loaded and rendered.

    frames: vertices by frame, those of the current frame first"""
    blend, kept = str(folder / f"{name}.blend"), str(folder / f"{name}.npz")
    bpy.ops.wm.save_as_mainfile(filepath=blend)
    numpy.savez(kept, **{str(frame): vertices for frame, vertices in frames.items()})
    check = """
import bpy, numpy, sys
sys.path.insert(0, sys.argv[-2])
from beside_query import vertices_of
kept = numpy.load(sys.argv[-1])
scene, ocean = bpy.context.scene, bpy.data.objects["Ocean"]
for frame in [*kept.files, kept.files[0]]:
    scene.frame_set(int(frame))
    assert vertices_of(ocean).tobytes() == kept[frame].tobytes(), f"frame {frame} differs"
scene.frame_set(7)
scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
scene.collection.objects.link(scene.camera)
scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
scene.render.resolution_x = scene.render.resolution_y = 16
scene.render.filepath = sys.argv[-1]
rendered = {}
def remember(scene, depsgraph=None):
    rendered[scene.frame_current] = vertices_of(ocean).tobytes()
bpy.app.handlers.frame_change_post.append(remember)
for frame in kept.files:
    scene.frame_start = scene.frame_end = int(frame)
    bpy.ops.render.render(animation=True)
    assert rendered[int(frame)] == kept[frame].tobytes(), f"frame {frame} has other vertices in a render"
    assert not ocean.pelagic.error, ocean.pelagic.error
print("equal vertices")
"""
    command = [bpy.app.binary_path, "-b", blend, "--python-exit-code", "1", "--python-expr", check, "--",
               str(Path(__file__).resolve().parent), kept]
    loaded = subprocess.run(command, capture_output=True, text=True)
    assert loaded.returncode == 0 and "equal vertices" in loaded.stdout, loaded.stdout + loaded.stderr


def message_about(**options):
    """The library's message about options, with the accepted range."""
    try:
        library.pelagic.DynamicWavesOptions(**options)
    except ValueError as error:
        return str(error)


# Defaults of the settings are those of the package, and ranges those of the library.
options = {
    "waves_side": ("DynamicWavesOptions", "side_m"), "waves_resolution": ("DynamicWavesOptions", "resolution"),
    "rain": ("Rain", "drops_per_m2_s"), "rain_radius": ("Rain", "radius_m"), "rain_depth": ("Rain", "height_m")}
ocean = add("moderate", size=60)
settings = ocean.pelagic
for name, (of, field) in options.items():
    default = getattr(getattr(library.pelagic, of), field)
    known = settings.bl_rna.properties[name]
    assert abs(float(known.default) - default) < 1e-6, (name, known.default, default)
sides = settings.bl_rna.properties["waves_side"]
assert message_about(side_m=-1) == f"side_m -1 is out of range [{sides.hard_min:g}, {sides.hard_max:g}]", message_about(side_m=-1)
resolutions = [item.identifier for item in settings.bl_rna.properties["waves_resolution"].enum_items]
assert re.findall(r"\d+", message_about(resolution=7)) == ["7", *resolutions], message_about(resolution=7)

# Two objects are recorded: a boat that turns, and a stone that falls into the water and sinks.
still = {}
for frame in (1, 30, 72):
    scene.frame_set(frame)
    still[frame] = vertices_of(ocean).tobytes()
bpy.ops.mesh.primitive_cube_add()
boat = bpy.context.object
boat.scale = 3, 1, 0.6
key_locations(boat, (1, (-20, -6, 0), 0), (40, (0, -2, 0), 0.7), (72, (14, 14, 0), 1.2))
bpy.ops.mesh.primitive_uv_sphere_add(radius=0.8)
stone = bpy.context.object
key_locations(stone, (10, (6, -12, 1.5), 0), (30, (6, -12, -1.5), 0))
fleet = bpy.data.collections.new("fleet")
scene.collection.children.link(fleet)
for each in (boat, stone):
    fleet.objects.link(each)
bpy.context.view_layer.objects.active = ocean
settings.sources, settings.place = fleet, (100.5, -30.25)
ocean.location = 2, 3, 0.25
bpy.context.view_layer.update()
scene.frame_set(30)
assert bpy.ops.pelagic.record() == {"FINISHED"} and scene.frame_current == 30 and not settings.error, settings.error
rows = [line.split(",") for line in settings.events.as_string().splitlines()]
assert rows.pop(0) == "time,x,z,radius,height,velocity,heading,duration,length,mode".split(",")
first = [float(cell) for cell in rows[0][:9]]
# The boat begins at (-20, -6) in the world, 22 and 9 m from the ocean's origin. Its keel is 0.6 m
# below its centre, which is 0.25 m below the ocean's rest level.
expected = [0, 100.5 - 22, -(-30.25 - 9), 1, -(0.6 + 0.25), 0, 1 / 24, 3]
numpy.testing.assert_allclose(first[:5] + first[6:], expected, atol=1e-5)
deep = [float(row[4]) for row in rows if float(row[8]) < 1]
assert len(rows) - len(deep) == 71 and 1 < len(deep) < 12 and -1.6 <= min(deep) < -1.2 and max(deep) > -0.6, deep
turned = [float(row[6]) for row in rows if float(row[0]) > 2.9 and float(row[8]) > 1]
assert abs(turned[-1] + math.degrees(1.2)) < 1, turned

events = folder / "events.csv"
events.write_text(settings.events.as_string())
sea = ["--preset", "moderate", "--events", str(events), "--events-at", "100.5,30.25"]
seen = {}
for frame, subframe in ((30, 0), (72, 0), (2, 0), (71, 0.5), (30, 0), (1, 0), (72, 0), (45, 0.25), (2, 0)):
    scene.frame_set(frame, subframe=subframe)
    now = vertices_of(ocean).tobytes(), waves_hash(ocean)
    assert seen.setdefault((frame, subframe), now) == now, f"frame {frame} differs when it is shown again"
for frame, subframe in seen:
    scene.frame_set(frame, subframe=subframe)
    time_s = (frame + subframe - 1) / 24
    there, is_seen = compare(pelagic, sea, time_s, ocean, place=(100.5, -30.25))
    assert numpy.abs(values_of(ocean, "foam") - there["foam"])[is_seen].max() < 1e-3
    assert waves_hash(ocean) == waves_hash_of(sea, time_s), f"frame {frame} has other dynamic waves"
assert len({hash_ for _, hash_ in seen.values()}) == len(seen)
scene.frame_set(72)
reach = sea_object.moved(settings, 71 / 24).frame.dynamic_waves
assert reach.height_min_m < -0.05 and reach.height_max_m > 0.05, "the boat has no wake"

# Velocities include the dynamic waves.
settings.velocity = True
there, _ = compare(pelagic, sea, 71 / 24, ocean, place=(100.5, -30.25))
velocity = values_of(ocean, "velocity", "vector", 3)
assert numpy.abs(velocity - numpy.stack([there["vx"], -there["vz"], there["vy"]], axis=1)).max() < 1e-3
settings.velocity = False

# States are kept and thinned; a replay from any of them gives equal waves.
(player,) = dynamic_waves.players.values()
player.most_kept = 4
hashes = {}
for time_s in (9.7, 0.4, 5.2, 2.9, 9.7, 5.2, 0.4, 7.9):
    hash_ = sea_object.moved(settings, time_s).frame.dynamic_waves.hash
    assert hashes.setdefault(time_s, hash_) == hash_
    assert len(player.kept) <= 6 and player.first_tick in player.kept
assert player.spacing > 60 and f"{hashes[7.9]:016x}" == waves_hash_of(sea, 7.9)
try:
    sea_object.moved(settings, 4000.0)
    assert False, "replayed more than an hour"
except ValueError as error:
    assert "must be at most 3600 s later" in str(error) and "\n" not in str(error)

scene.frame_set(30)
shown = {frame: numpy.frombuffer(seen[frame, 0][0], numpy.float32) for frame in (30, 72, 2)}
check_in_another_process("waves", shown)

# Without its events the sea is the one of the wind.
settings.events = None
settings.place = 0, 0
for frame, vertices in still.items():
    scene.frame_set(frame)
    assert vertices_of(ocean).tobytes() == vertices and not dynamic_waves.players

# A text by hand: any order of columns, empty cells, every mode, any heading.
written = bpy.data.texts.new("splash.csv")
written.write("mode,time,z,x,height,radius,duration,heading,velocity,length\n"
              ",0.25,2.5,-3.25,0.4,1.1,,,,\n\n"
              "relaxation,0.4, 7,1,-0.3,1.5,2,33.3,-2.7,\n"
              "pressure,-0.3,-9,4,-0.8,1.2,1.9,-123.4,5.5,4.5\n"
              "foam,0.1,12,-8,0.5,3,0.5,20,4,5\n"
              "foam,0.7,-20,15,0.35,4,,,,\n")
settings.events, settings.waves_side, settings.waves_resolution = written, 90, "128"
assert not settings.error, settings.error
events.write_text(written.as_string())
sea = ["--preset", "moderate", "--events", str(events), "--events-side", "90", "--events-resolution", "128",
       "--events-at", "0,0"]
for frame in (60, 5, 20):
    scene.frame_set(frame)
    compare(pelagic, sea, (frame - 1) / 24, ocean)
    assert waves_hash(ocean) == waves_hash_of(sea, (frame - 1) / 24), frame
# Both foams have been added and fade. They make no waves.
foamy, vertices = values_of(ocean, "foam"), vertices_of(ocean).tobytes()
written.from_string("".join(line + "\n" for line in written.as_string().splitlines() if "foam" not in line))
settings.events = written
assert vertices_of(ocean).tobytes() == vertices
for x, z in ((-8, 12), (15, -20)):
    near = numpy.hypot(vertices_of(ocean)[:, 0] - x, vertices_of(ocean)[:, 1] + z) < 2
    assert near.any() and (foamy - values_of(ocean, "foam"))[near].max() > 0.1, (x, z)

# An invalid text: one line, and the mesh stays as it was. The command line rejects it, too.
scene.frame_set(20)
kept = vertices_of(ocean).tobytes()
for text, line in (
        ("time,x,z,radius\n", "splash.csv:1: column height is missing"),
        ("time,x,z,radius,height,colour\n", "splash.csv:1: column colour: must be one of time, "),
        ("time,x,z,radius,height\n", "splash.csv has no events: "),
        ("time,x,z,radius,height\n1,2,3,4\n", "splash.csv:2: 4 columns: must be 5, "),
        ("time,x,z,radius,height\n1,2,3,4,5\n\n1,2,3,wide,5\n", "splash.csv:4: radius wide is out of range "),
        ("time,x,z,radius,height\n1,2,3,0,5\n", "splash.csv:2: radius_m 0 is out of range [0.001, 1000]"),
        ("time,x,z,radius,height,velocity\n1,2,3,1,5,2\n", "splash.csv:2: velocity 2: must be 0 without a duration"),
        ("time,x,z,radius,height,duration,mode\n1,2,3,1,5,2,impulse\n", "splash.csv:2: mode impulse: must be "),
        ("time,x,z,radius,height,mode\n1,2,3,1,5,froth\n", "splash.csv:2: mode froth: must be pressure, relaxation or foam, ")):
    written.from_string(text)
    settings.events = written
    assert vertices_of(ocean).tobytes() == kept
    assert settings.error.startswith(line), (settings.error, line)
    events.write_text(text)
    refused = subprocess.run([pelagic, "query", *sea, "--points", "-"], input="0,0\n", capture_output=True, text=True)
    assert refused.returncode != 0 and "events.csv" in refused.stderr, refused.stderr
written.from_string("")  # no dynamic waves
settings.events = written
assert not settings.error and vertices_of(ocean).tobytes() != kept, settings.error
settings.events = None

# What cannot be recorded.
for settings.sources in (None, bpy.data.collections.new("empty")):
    try:
        bpy.ops.pelagic.record()
        assert False, "recorded nothing"
    except RuntimeError as error:
        assert "Objects: must be a collection" in str(error), error
settings.sources, settings.speed = fleet, 0
try:
    bpy.ops.pelagic.record()
    assert False, "recorded a sea that stands still"
except RuntimeError as error:
    assert "must advance from frame to frame" in str(error), error
settings.speed = 0.1
assert bpy.ops.pelagic.record() == {"FINISHED"}
slow = [line.split(",") for line in settings.events.as_string().splitlines()[1:]]
assert min(float(row[7]) for row in slow) >= 1 / 60, "rows shorter than a tick"
settings.events, settings.speed = None, 1

# Rain begins at the first frame, and is that of an ocean that is advanced tick by tick.
settings.time_offset, settings.rain, settings.rain_radius, settings.rain_depth = 3.7, 0.5, 1, 0.3
assert not settings.error, settings.error
grid = library.pelagic.DynamicWavesOptions(resolution=128, side_m=90, border_m=90 * 0.1875, depth_m=4000)
rain = {}
with library.pelagic.Ocean(library.pelagic.Sea(resolution=16, patch_size_m=16), dynamic_waves=grid) as other:
    other.dynamic_waves.set_rain(library.pelagic.Rain(0.5, 1, 0.3))
    for tick in range(222, 222 + 101):
        frame = other.frame_at(tick / 60)
        if (tick - 222) % 50 == 0:
            rain[1 + (tick - 222) * 24 // 60] = f"{frame.dynamic_waves.hash:016x}"
assert list(rain) == [1, 21, 41] and len(set(rain.values())) == 3
for frame in (41, 1, 21):
    scene.frame_set(frame)
    assert waves_hash(ocean) == rain[frame], f"frame {frame} has other rain"
settings.rain_radius = 50
assert settings.error.startswith("radius_m 50 is out of range [0.001, 5.625]"), settings.error
settings.rain = 0
assert not settings.error and not dynamic_waves.players
settings.rain_radius, settings.time_offset = 0.25, 0

# A floor: a beach that rises along +X and -Y, with an island, rotated and moved.
bpy.ops.mesh.primitive_grid_add(x_subdivisions=60, y_subdivisions=40, size=2)
floor = bpy.context.object
floor.scale, floor.rotation_euler.z, floor.location = (300, 200, 1), 0.2, (40, -20, -6)
for vertex in floor.data.vertices:
    x, y = vertex.co.x, vertex.co.y
    vertex.co.z = 11 * x - 4 * y + 16 * math.exp(-30 * ((x + 0.1) ** 2 + (y - 0.1) ** 2))
bpy.context.view_layer.update()
settings.size, settings.place = 500, (12.5, -40)
ocean.location = 0, 0, 0.5
bpy.context.view_layer.update()
settings.floor = floor
assert not settings.error, settings.error
settings.events = bpy.data.texts.new("rings.csv")
settings.events.write("time,x,z,radius,height\n0.1,2,30,2,0.8\n")
settings.bake_start, settings.bake_end, settings.bake_folder = 20, 22, str(folder / "bake")
scene.frame_set(21)
assert not settings.error, settings.error
vertices, foam = vertices_of(ocean), values_of(ocean, "foam")
check_in_another_process("shore", {21: vertices})
bpy.context.view_layer.objects.active = ocean
assert bpy.ops.pelagic.bake() == {"FINISHED"}
into = folder / "bake" / "Ocean"
record = json.loads((into / "sea.json").read_text())
shore, waves = record["shore"], record["dynamic_waves"]
x_m, z_m = shore["middle_m"]
over = ["--config", str(into / "sea.json"), "--shore", "--floor", str(into / "floor.exr"),
        "--floor-size", repr(shore["size_m"]), f"--floor-middle={x_m!r},{z_m!r}"]
both = [*over, "--events", str(into / "events.csv"), "--events-side", repr(waves["side_m"]),
        "--events-resolution", str(waves["resolution"]), "--events-at={!r},{!r}".format(*waves["middle_m"])]
there, is_seen = compare(pelagic, [*both, "--foam"], 20 / 24, ocean, place=(12.5, -40), vertices=vertices)
assert (there["depth"] < 0).sum() > 100 and (there["depth"] > 3).sum() > 100, "no beach"
assert numpy.abs(foam - there["foam"])[is_seen].max() < 2e-3
cached = numpy.frombuffer((into / "vertices.pc2").read_bytes()[32:], "<f4").reshape(3, -1, 3)
assert cached[1].tobytes() == vertices.tobytes()

# The floor has the heights of the mesh, seen from the ocean's rest level.
positions = numpy.array([vertex.co for vertex in floor.data.vertices])[[700, 1000, 1300, 1500, 1777]]
world = positions @ numpy.array(floor.matrix_world)[:3, :3].T + numpy.array(floor.matrix_world)[:3, 3]
depths = ask(pelagic, over, 0.0, numpy.stack([world[:, 0] + 12.5, -(world[:, 1] - 40)], axis=1))["depth"]
# The field is sampled at other positions than vertices, and again at the shore's texels.
assert numpy.abs(depths + world[:, 2] - 0.5).max() < 0.15, (depths, world[:, 2])
assert depths.max() - depths.min() > 5

# A bake of another floor begins anew; one of the same is left alone.
stamp = (into / "vertices.pc2").stat().st_mtime_ns
assert bpy.ops.pelagic.bake() == {"FINISHED"} and (into / "vertices.pc2").stat().st_mtime_ns == stamp
floor.location.z = -5
bpy.context.view_layer.update()
assert bpy.ops.pelagic.bake() == {"FINISHED"} and (into / "vertices.pc2").stat().st_mtime_ns != stamp
bpy.ops.pelagic.go_live()

# Invalid floors.
settings.cascades = 1
assert settings.error.startswith("cascades "), settings.error
settings.cascades = 0
floor.data.clear_geometry()
settings.floor = floor
assert settings.error == f"Floor {floor.name}: must be a mesh with faces", settings.error
settings.floor = None
assert not settings.error, settings.error
print("waves_test passed")
