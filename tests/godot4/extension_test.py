# The extension for Godot 4 in the stand-in: 50 cycles of load, use and unload. Its sea is that of the golden hashes, its
# hull moves as that of the C interface, its scene and shader name what the library registers.
# usage: extension_test.py STAND_IN EXTENSION LIBRARY SOURCE
import ctypes
import re
import struct
import subprocess
import sys
from pathlib import Path

stand_in, extension, library, source = sys.argv[1:]
source = Path(source)
sys.dont_write_bytecode = True
sys.path += [str(source / "tests/godot3"), str(source / "python/pelagic")]
import _native as pelagic  # noqa: E402
from _native import make  # noqa: E402
from c_bodies import CBodies  # noqa: E402

cycles = 50


def run(*arguments):
    return subprocess.run([stand_in, *map(str, arguments)], capture_output=True, text=True)


def single(number):
    """The text of a number that the stand-in prints, as a float of the engine."""
    return struct.pack("f", float(number))


def hull_of_the_c_interface():
    """Position of the box of stand_in.cpp after its 60 steps, and the hash of its waves."""
    bodies = CBodies(library)
    sea = make(pelagic.pelagic_sea, wind_direction_rad=30 * (3.14159265358979323846 / 180), resolution=32)
    waves = make(pelagic.pelagic_dynamic_waves_options, resolution=64)
    options = make(pelagic.pelagic_ocean_options, queries=1, depth=1, slopes=1, foam=1, dynamic_waves=ctypes.addressof(waves))
    ocean, handle, of_waves, kind = (ctypes.c_void_p() for _ in range(4))
    bodies.call("ocean_create", ctypes.byref(sea), ctypes.byref(options), ctypes.byref(ocean))
    bodies.call("ocean_dynamic_waves", ocean, ctypes.byref(of_waves))
    number = ctypes.c_uint32()
    source_of_waves = make(pelagic.pelagic_disturbance, shape=1, x_m=3, height_m=-0.2, length_m=2)
    bodies.call("dynamic_waves_add_source", of_waves, ctypes.byref(source_of_waves), ctypes.byref(number))
    bodies.call("dynamic_waves_remove_source", of_waves, number)
    rain = make(pelagic.pelagic_rain, drops_per_m2_s=1)
    bodies.call("dynamic_waves_set_rain", of_waves, ctypes.byref(rain))
    corners = [(x, y, z) for x in (-2, 2) for y in (-0.5, 0.5) for z in (-1, 1)]
    faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
    mesh = make(pelagic.pelagic_hull_mesh, vertex_count=8, vertices_m=bodies.address(ctypes.c_double, [c for corner in corners for c in corner]),
                triangle_count=12, triangles=bodies.address(ctypes.c_uint32, [v for face in faces for v in face]))
    hull_options = make(pelagic.pelagic_hull_options, mass_kg=0.3 * 8 * 1025, centre_of_mass_m=bodies.address(ctypes.c_double, [0, -0.25, 0]))
    bodies.call("hull_create", ctypes.byref(mesh), ctypes.byref(hull_options), ctypes.byref(kind))
    state = pelagic.pelagic_hull_state()
    bodies.call("hull_at_rest", kind, ctypes.c_double(0), ctypes.c_double(0), ctypes.c_double(0), ctypes.byref(state))
    set_options = make(pelagic.pelagic_bodies_options, wakes=1)
    inputs = make(pelagic.pelagic_hull_inputs)
    inputs.force.force_n[0] = 500
    frame = pelagic.pelagic_frame()
    for tick in range(60):
        if tick:
            bodies.call("bodies_press", handle, ctypes.c_double(1 / 60))
        bodies.call("ocean_schedule", ocean, ctypes.c_double(tick / 60))
        bodies.call("ocean_complete", ocean, ctypes.byref(frame))
        if not tick:
            bodies.call("bodies_create", ocean, ctypes.byref(set_options), ctypes.byref(handle))
            bodies.call("bodies_add", handle, kind, ctypes.byref(state), ctypes.byref(number))
            bodies.call("bodies_set_inputs", handle, number, ctypes.byref(inputs))
        bodies.call("bodies_step", handle, ctypes.c_double(1 / 60), None)
    bodies.call("bodies_get_state", handle, number, ctypes.byref(state))
    digest = ctypes.c_uint64()
    bodies.call("dynamic_waves_hash", of_waves, ctypes.byref(digest))
    position = list(state.position_m)
    bodies.library.pelagic_bodies_destroy(handle)
    bodies.library.pelagic_hull_destroy(kind)
    bodies.library.pelagic_ocean_destroy(ocean)
    return position, f"{digest.value:016x}"


done = run(extension, cycles)
assert done.returncode == 0, done.stdout + done.stderr
lines = done.stdout.splitlines()
found = {line.split()[0]: line.split()[1:] for line in lines}

golden = dict(line.split() for line in (source / "tests/golden/hashes.txt").read_text().splitlines() if line.count(" ") == 1)
assert int(found["hash"][0], 16) == int(golden["preset-moderate@12.34"], 16), found["hash"]

position, waves = hull_of_the_c_interface()
assert [single(number) for number in found["hull"]] == [single(number) for number in position], (found["hull"], position)
assert found["waves"] == [waves], (found["waves"], waves)

# Less than the smallest object of the C interface in each cycle: the rest are caches of the allocator and the loader.
grown = int(found["grown"][0])
assert grown < 1000 * (cycles - 10), f"{grown} bytes more after {cycles - 10} cycles"

refused = [line.removeprefix("refused ") for line in lines if line.startswith("refused ")]
assert "PelagicOcean: wind_speed_mps -3 is out of range (0, 60]" in refused, refused
assert "PelagicOcean: the ocean has no dynamic waves: set dynamic_waves to true" in refused, refused
assert all(len(line) < 300 for line in refused)

# The shader has the uniforms that the mesh sets, and no others but colours.
shader = (source / "contrib/godot4/project/addons/pelagic/sea.gdshader").read_text()
declared = set(re.findall(r"^uniform \w+ (\w+)", shader, re.M))
given = {line.split()[1] for line in lines if line.startswith("uniform ")}
assert declared - given == {"water_colour", "crest_colour", "foam_colour"} and given <= declared, declared ^ given

# The scene's nodes are of registered classes or the engine's, and have a parent.
scene = (source / "contrib/godot4/project/demo.tscn").read_text()
registered = {line.split()[1] for line in lines if line.startswith("class ")}
nodes = re.findall(r'^\[node name="(\w+)" type="(\w+)"(?: parent="([\w/.]+)")?', scene, re.M)
paths = {"."} | {f"{parent}/{name}".removeprefix("./") for name, _, parent in nodes if parent}
assert all(parent in paths for _, _, parent in nodes if parent)
assert {type_ for _, type_, _ in nodes if type_.startswith("Pelagic")} == registered, registered
project = source / "contrib/godot4/project"
listed = (project / ".godot/extension_list.cfg").read_text().splitlines()  # which the engine loads before any scene
assert listed == ["res://addons/pelagic/pelagic.gdextension"] and (project / listed[0].removeprefix("res://")).exists(), listed
description = (source / "contrib/godot4/project/addons/pelagic/pelagic.gdextension").read_text()
assert 'entry_symbol = "pelagic_godot4_init"' in description and f"addons/pelagic/{Path(extension).name}" in description

# What cannot be loaded: one line each.
for arguments, line in [((extension, 1, "GODOT_4_0"), "Pelagic: the engine is Godot 4.0, expected 4.1 or later\n"),
                        ((extension, 1, "ref_set_object"),
                         "Pelagic: ref_set_object is not in the engine's interface, expected Godot 4.1 or later\n")]:
    refused = run(*arguments)
    assert refused.returncode == 1 and refused.stderr == line, refused
refused = run(Path(extension).with_name("libpelagic_godot5.so"), 1)
assert refused.returncode == 1 and re.fullmatch(r"stand_in: cannot load the library: .*libpelagic_godot5\.so: cannot open .*\n", refused.stdout), refused
