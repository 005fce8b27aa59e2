#!/usr/bin/env python3
"""Compiles the C# package and its tests with mcs, and runs them under mono. Expected values are the
golden hashes, and results that ctypes obtains from the C interface.

usage: runtime_test.py C_COMPILER LIBRARY PELAGIC OUTPUT_FOLDER [TEST...]
"""
import ctypes
import json
import os
import pathlib
import struct
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(SOURCE / "tools/bindings"), str(SOURCE / "tests/bindings")]
sys.dont_write_bytecode = True

import c_layout  # noqa: E402
import header as generator  # noqa: E402
import pelagic_ctypes as pelagic  # noqa: E402
from pelagic_ctypes import sized  # noqa: E402

GOLDEN = SOURCE / "tests/golden"


class CInterface:
    def __init__(self, file):
        self.library = pelagic.load(file)

    def call(self, name, *arguments):
        if getattr(self.library, name)(*arguments) != pelagic.PELAGIC_OK:
            sys.exit(f"{name}: {self.library.pelagic_last_error().decode()}")

    def query_lines(self):
        """Samples at the points of QueryTests.cs, as bits."""
        sea, options, ocean = sized(pelagic.pelagic_sea), sized(pelagic.pelagic_ocean_options, queries=1, velocities=1, foam=1), ctypes.c_void_p()
        self.call("pelagic_sea_preset", b"storm", sea)
        self.call("pelagic_ocean_create", sea, options, ctypes.byref(ocean))
        self.call("pelagic_ocean_schedule", ocean, 12.34)
        self.call("pelagic_ocean_complete", ocean, sized(pelagic.pelagic_frame))
        count = 500
        x = (ctypes.c_double * count)(*(i * 37.77 % 1200 - 600 for i in range(count)))
        z = (ctypes.c_double * count)(*(i * 12.345 % 1000 - 500 for i in range(count)))
        height, normal_y, velocity_x, foam = ((ctypes.c_float * count)() for _ in range(4))
        converged = (ctypes.c_uint8 * count)()
        samples = sized(pelagic.pelagic_samples, height_m=height, normal_y=normal_y, velocity_x_mps=velocity_x, foam=foam, converged=converged)
        for interpolation in (pelagic.PELAGIC_INTERPOLATION_LINEAR, pelagic.PELAGIC_INTERPOLATION_CUBIC):
            self.call("pelagic_ocean_query", ocean, sized(pelagic.pelagic_points, count=count, x=x, z=z, interpolation=interpolation), samples)
            for i in range(count):
                bits = "".join(struct.pack(">f", values[i]).hex() for values in (height, normal_y, velocity_x, foam))
                yield f"query {interpolation} {i} {bits}{converged[i]}"
        self.library.pelagic_ocean_destroy(ocean)

    def job_query_lines(self):
        """Samples at the points of OceanQueriesTests.cs, as bits."""
        sea, options, ocean = sized(pelagic.pelagic_sea), sized(pelagic.pelagic_ocean_options, queries=1, velocities=1), ctypes.c_void_p()
        self.call("pelagic_sea_preset", b"storm", sea)
        self.call("pelagic_ocean_create", sea, options, ctypes.byref(ocean))
        self.call("pelagic_ocean_schedule", ocean, 12.34)
        self.call("pelagic_ocean_complete", ocean, sized(pelagic.pelagic_frame))
        count = 500
        x = (ctypes.c_double * count)(*(i * 37.75 % 1200 - 600 for i in range(count)))
        z = (ctypes.c_double * count)(*(i * 12.25 % 1000 - 500 for i in range(count)))
        names = ("height_m", "normal_x", "normal_y", "normal_z", "velocity_x_mps", "velocity_y_mps", "velocity_z_mps")
        results = {name: (ctypes.c_float * count)() for name in names}
        self.call("pelagic_ocean_query", ocean, sized(pelagic.pelagic_points, count=count, x=x, z=z), sized(pelagic.pelagic_samples, **results))
        for i in range(count):
            yield f"job query {i} " + "".join(struct.pack(">f", values[i]).hex() for values in results.values())
        self.library.pelagic_ocean_destroy(ocean)

    def frame_loop_lines(self):
        """The frames of the sample FrameLoop."""
        sea, ocean, found = sized(pelagic.pelagic_sea), ctypes.c_void_p(), ctypes.c_uint64()
        self.call("pelagic_sea_defaults", sea)
        sea.wind_speed_mps = 9
        self.call("pelagic_ocean_create", sea, None, ctypes.byref(ocean))
        for n in range(5):
            self.call("pelagic_ocean_schedule", ocean, n / 90)
            self.call("pelagic_ocean_complete", ocean, sized(pelagic.pelagic_frame))
            self.call("pelagic_ocean_hash", ocean, found)
            yield f"frame loop {n} {found.value:016x}"
        self.library.pelagic_ocean_destroy(ocean)

    def dynamic_waves_line(self):
        """The waves of GoldenTests.cs."""
        options, waves = sized(pelagic.pelagic_dynamic_waves_options), ctypes.c_void_p()
        self.call("pelagic_dynamic_waves_defaults", options)
        options.resolution = 64
        self.call("pelagic_dynamic_waves_create", options, None, ctypes.byref(waves))
        boat, stone, number, found = sized(pelagic.pelagic_disturbance), sized(pelagic.pelagic_disturbance), ctypes.c_uint32(), ctypes.c_uint64()
        self.call("pelagic_disturbance_defaults", boat)
        boat.shape, boat.x_m, boat.length_m, boat.height_m, boat.velocity_x_mps = pelagic.PELAGIC_SHAPE_HULL, -10, 4, -0.5, 6
        self.call("pelagic_disturbance_defaults", stone)
        stone.mode, stone.height_m = pelagic.PELAGIC_DISTURBANCE_IMPULSE, 0.4
        self.call("pelagic_dynamic_waves_advance", waves, 0)
        self.call("pelagic_dynamic_waves_add_source", waves, boat, number)
        self.call("pelagic_dynamic_waves_add_impulse", waves, stone)
        self.call("pelagic_dynamic_waves_advance", waves, 0.25)
        self.call("pelagic_dynamic_waves_advance", waves, 0.5)
        self.call("pelagic_dynamic_waves_hash", waves, found)
        self.library.pelagic_dynamic_waves_destroy(waves)
        return f"dynamic waves {found.value:x}"

    def bodies_lines(self):
        """The bodies of BodiesTests.cs, as bits."""
        sea, waves, ocean = sized(pelagic.pelagic_sea), sized(pelagic.pelagic_dynamic_waves_options), ctypes.c_void_p()
        self.call("pelagic_sea_preset", b"rough", sea)
        sea.resolution = 32
        self.call("pelagic_dynamic_waves_defaults", waves)
        waves.resolution, waves.side_m, waves.border_m = 64, 32, 4
        self.call("pelagic_ocean_create", sea, sized(pelagic.pelagic_ocean_options, queries=1, velocities=1, dynamic_waves=ctypes.addressof(waves)), ctypes.byref(ocean))
        corners = (ctypes.c_double * 24)(*(number for x in (-2, 2) for y in (-0.5, 0.5) for z in (-1, 1) for number in (x, y, z)))
        triangles = (ctypes.c_uint32 * 36)(0, 1, 3, 0, 3, 2, 4, 6, 7, 4, 7, 5, 0, 4, 5, 0, 5, 1, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3)
        options, hull, bodies = sized(pelagic.pelagic_hull_options), ctypes.c_void_p(), ctypes.c_void_p()
        self.call("pelagic_hull_defaults", options)
        centre = (ctypes.c_double * 3)(0, -0.1, 0)
        options.mass_kg, options.roll_damping, options.centre_of_mass_m = 2500, 0.1, centre
        mesh = sized(pelagic.pelagic_hull_mesh, vertex_count=8, vertices_m=corners, triangle_count=12, triangles=triangles)
        self.call("pelagic_hull_create", mesh, options, ctypes.byref(hull))
        self.call("pelagic_bodies_create", ocean, sized(pelagic.pelagic_bodies_options, wakes=1), ctypes.byref(bodies))
        state, number = sized(pelagic.pelagic_hull_state), ctypes.c_uint32()
        for x, z, heading in ((1, -2, 0.3), (-5, 4, 0)):
            self.call("pelagic_hull_at_rest", hull, x, z, heading, state)
            self.call("pelagic_bodies_add", bodies, hull, state, number)
        inputs = sized(pelagic.pelagic_hull_inputs)
        inputs.force.force_n[0], inputs.wind_mps[2] = 900, 5
        self.call("pelagic_bodies_set_inputs", bodies, number, inputs)
        for tick in range(40):
            self.call("pelagic_ocean_schedule", ocean, tick * (1 / 60))
            self.call("pelagic_ocean_complete", ocean, sized(pelagic.pelagic_frame))
            self.call("pelagic_bodies_press", bodies, 1 / 60)
            self.call("pelagic_bodies_step", bodies, 1 / 60, None)
        for number in (1, 2):
            self.call("pelagic_bodies_get_state", bodies, number, state)
            numbers = (*state.position_m, *state.orientation, *state.velocity_mps, *state.angular_velocity_radps)
            yield f"body {number} " + struct.pack(">13d", *numbers).hex()
        loads = sized(pelagic.pelagic_hull_loads)
        self.call("pelagic_bodies_get_loads", bodies, 2, loads)
        yield "body 2 force " + struct.pack(">d", loads.total.force_n[1]).hex()
        self.library.pelagic_bodies_destroy(bodies)
        self.library.pelagic_hull_destroy(hull)
        self.library.pelagic_ocean_destroy(ocean)


def quadtree_lines(program, folder):
    """Patches of the viewers of QuadtreeTests.cs: triangles, by level, by stitching."""
    file = folder / "quadtree.json"
    for quality in ("low", "high"):
        for number, viewer in enumerate(("0,2,0", "313.7,1.7,-271.3", "-9000.25,180,4500.5")):
            x, y, z = viewer.split(",")
            subprocess.run([program, "quadtree", "--all", "--quality", quality, "--camera", viewer, "--target", f"{float(x) + 9},{y},{z}",
                            "--resolution", "16", "--json", file], check=True, stdout=subprocess.DEVNULL)
            found = json.loads(file.read_text())
            batches = {batch["stitches"]: batch["instances"] for batch in found["batches"]}
            levels, stitches = (level["patches"] for level in found["patches_by_level"]), (batches.get(i, 0) for i in range(16))
            yield f"quadtree {quality} {number} {found['triangles']}:{','.join(map(str, levels))}:{','.join(map(str, stitches))}"


def expected_lines(compiler, library):
    header = generator.read_pelagic_header()
    yield from (f"layout {name} {number}" for name, number in c_layout.compiled_layout(header, SOURCE / "capi", compiler).items())
    for prefix, file in (("golden", "hashes.txt"), ("displacement", "displacement_hashes.txt"), ("shore", "shore.txt")):
        yield from (f"{prefix} {line}" for line in (GOLDEN / file).read_text().splitlines())
    for line in (GOLDEN / "wave_inputs.txt").read_text().splitlines():
        name, *hashes = line.split()
        yield from (f"input {name} {i} {value}" for i, value in enumerate(hashes))
    c_interface = CInterface(library)
    yield from c_interface.query_lines()
    yield from c_interface.job_query_lines()
    yield from c_interface.frame_loop_lines()
    yield c_interface.dynamic_waves_line()
    yield from c_interface.bodies_lines()


def main():
    compiler, library, program, folder, *tests = sys.argv[1:]
    folder = pathlib.Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    flags = ["mcs", "-unsafe", "-langversion:7.2", "-warnaserror", "-optimize", "-d:ENABLE_UNITY_COLLECTIONS_CHECKS"]
    runtime, here = SOURCE / "unity/Runtime", pathlib.Path(__file__).parent
    core, engine, component = (folder / f"{name}.dll" for name in ("Pelagic", "Stubs", "Pelagic.Unity"))

    def build(target, sources, *references):
        kind = "-target:library" if target.suffix == ".dll" else "-target:exe"
        others = [f"-r:{reference}" for reference in references]
        subprocess.run([*flags, kind, f"-out:{target}", *others, *sorted(sources)], check=True)

    stubs = here / "Stubs.cs"
    build(core, runtime.glob("*.cs"))
    build(engine, [stubs])
    build(component, (runtime / "Unity").glob("*.cs"), core, engine)
    build(folder / "Tests.exe", [*(SOURCE / "unity/Samples~").rglob("*.cs"), *(set(here.glob("*.cs")) - {stubs})], core, engine, component)
    (folder / "expected.txt").write_text("\n".join([*expected_lines(compiler, library), *quadtree_lines(program, folder)]) + "\n")
    environment = os.environ | {"LD_LIBRARY_PATH": str(pathlib.Path(library).parent)}
    run = ["mono", folder / "Tests.exe", folder / "expected.txt"]
    # The end of a frame in flight takes 2 s; 44 s without the guard, when mono gives up its
    # threads.
    for test in ("ReloadTests.AProcessWithAFrameInFlightEnds", "CallbackTests.AProcessWhoseCallbacksRanOnThreadsEnds"):
        subprocess.run([*run, test], env=environment, check=True, timeout=40)
    sys.exit(subprocess.run([*run, *tests], env=environment).returncode)


main()
