# The node PelagicHull in Godot: states of 200 steps in waves that equal those of the C interface bit
# for bit. Invalid values and freed nodes are reported in one line and change nothing.
# usage: hulls_test.py PROJECT LIBRARY
import ctypes
import json
import math
import struct
import sys
import tempfile
from pathlib import Path

from engine import run_headless, single

here = Path(__file__).parent
sys.path.append(str(here.parents[1] / "python/pelagic"))
sys.dont_write_bytecode = True
import _native as pelagic  # noqa: E402
from _native import make  # noqa: E402
from c_bodies import CBodies  # noqa: E402

project, library_file = sys.argv[1:]
steps, step_s = 200, 1 / 60

# A box of 4 x 1 x 2 m.
box = [4, 1, 2]
mass_of_box = 0.3 * 8 * 1025

# A boat with a pointed bow, whose coordinates are exact in floats: sides that share vertices, and a
# bottom and a deck whose triangles share none.
outline = [(-3, 1.25), (1, 1.25), (3.5, 0), (1, -1.25), (-3, -1.25)]
rings = [(x, -0.75, z / 2) for x, z in outline] + [(x, 0.75, z) for x, z in outline]
sides = [triangle for i in range(5) for j in [(i + 1) % 5] for triangle in ((i, j, j + 5), (i, j + 5, i + 5))]
caps = [triangle for i in range(1, 4) for triangle in ((5, 5 + i, 6 + i), (0, i + 1, i))]


def surface(vertices, triangles):
    """Returns the arrays of a surface with the engine's winding."""
    return {"vertices": [number for vertex in vertices for number in vertex],
            "numbers": [number for a, b, c in triangles for number in (a, c, b)]}


def reversed_winding(surface):
    numbers = surface["numbers"]
    return {**surface, "numbers": [number for i in range(0, len(numbers), 3) for number in (numbers[i], numbers[i + 2], numbers[i + 1])]}


boat = [surface(rings, sides), surface([rings[v] for a, b, c in caps for v in (a, c, b)], [])]
mass_kg, centre_of_mass_m, inertia_kgm2, force_n = 5000, [-0.25, -0.125, 0.0625], [4096, 16384, 20480], [900, 0, -250]
corners = [(x, y, z) for x in (-2, 2) for y in (-0.5, 0.5) for z in (-1, 1)]
faces = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4), (1, 5, 7), (1, 7, 3)]
closed = surface(corners, faces)


def mesh(*surfaces):
    return {"is": "mesh", "surfaces": surfaces}


def moved(x):
    return {**closed, "vertices": [x, *closed["vertices"][1:]]}


def vector(*numbers):
    return {"is": "vector", "numbers": numbers}


refused = [
    ("property", "mesh", 3, "mesh is 3, expected a Mesh"),
    ("property", "mesh", {"is": "new", "class": "SpatialMaterial"}, None),
    ("property", "mesh", {"is": "new", "class": "ArrayMesh"}, "the hull has 0 triangles, expected 4 to 4096"),
    ("property", "mesh", {"is": "new", "class": "QuadMesh"}, "the hull has 2 triangles, expected 4 to 4096"),
    ("property", "mesh", {"is": "new", "class": "SphereMesh"}, "the hull has 4224 triangles, expected 4 to 4096"),
    ("property", "mesh", {"is": "new", "class": "PointMesh"},
     "surface 0 of the mesh has other primitives, expected PRIMITIVE_TRIANGLES"),
    ("property", "mesh", {**mesh(closed), "is": "lines"},
     "surface 0 of the mesh has other primitives, expected PRIMITIVE_TRIANGLES"),
    ("property", "mesh", mesh(surface(corners, faces[1:])),
     "the hull is open at the edge between vertices 0 and 3, expected a closed mesh (close an open boat with a lid)"),
    ("property", "mesh", mesh(reversed_winding(closed)), "the hull's volume is -8 m^3: its triangles are wound inwards"),
    ("property", "mesh", mesh(closed, reversed_winding(closed)),
     "two triangles of the hull pass the edge between vertices 0 and 1 in the same direction, expected a consistent winding "
     "and two triangles an edge"),
    ("property", "mesh", mesh(surface([(x / 2**11, y / 2**11, z / 2**11) for x, y, z in corners], faces)),
     f"the hull's volume is {8 / 2**33} m^3, expected at least 1e-9"),
    ("property", "mesh", mesh(moved(2000)), "vertex 0: x 2000 is out of range [-1000, 1000] m"),
    ("property", "mesh", {**mesh(closed), "is": "nan"}, "vertex 0: y nan is out of range [-1000, 1000] m"),
    ("property", "mass_kg", 0, "mass_kg 0 is out of range [1e-6, 1e10]"),
    ("property", "mass_kg", {"is": "number", "text": "nan"}, "mass_kg nan is out of range [1e-6, 1e10]"),
    ("property", "mass_kg", "heavy", "mass_kg heavy is out of range [1e-6, 1e10]"),
    ("property", "heave_damping", 1, "heave_damping 1 is out of range [0, 0.999]"),
    ("property", "centre_of_mass_m", vector(9, 0, 0),
     "centre_of_mass_m.x is 9, expected a position within the mesh, -3 to 3.5"),
    ("property", "centre_of_mass_m", 3, "centre_of_mass_m is 3, expected a Vector3 or null"),
    ("property", "inertia_kgm2", vector(1, 0, 1), "inertia_kgm2.y 0 is out of range [1e-15, 1e16]"),
    ("property", "force_n", vector(1e20, 0, 0), "the hull's input force_n is out of range [-1e15, 1e15]"),
    ("property", "wind_mps", vector(0, 0, 2000), "the hull's input wind_mps is out of range [-1e3, 1e3]"),
    ("property", "torque_nm", None, "torque_nm is Null, expected a Vector3"),
    ("property", "ocean", 3, "ocean is 3, expected the path of a PelagicOcean"),
    ("method", "step", [-0.1], "step_s -0.1 is out of range [0, inf) s"),
    ("method", "step", [{"is": "number", "text": "nan"}], "step_s nan is out of range [0, inf) s"),
    ("method", "step", [], "step is called as step(step_s)"),
    ("method", "restore_state", [3], "restore_state is called as restore_state(saved)"),
]
unusable = [
    "the node is outside of the scene tree, expected a node of a scene",
    "mesh is null, expected a closed Mesh",
    "the node's scale is 2, 1, 1, expected 1, 1, 1 and no shear: scale the mesh",
    "ocean is ../boat, expected the path of a PelagicOcean",
    "ocean is empty, expected the path of a PelagicOcean",
    "ocean is ., expected the path of a PelagicOcean",
    "the ocean has no depth: set depth to true",
]
restored = [
    "the saved bodies are damaged, expected the bytes that save_state() returned",
    "the number of saved bodies is 2, expected 1",
    "the saved body is not the first of its set, as that of a PelagicHull is",
]
not_in_tree, no_ocean = unusable[0], "ocean is ../sea, expected the path of a PelagicOcean"


class CInterface(CBodies):
    """The boat in the sea of the C interface."""

    def __init__(self):
        super().__init__(library_file)
        sea, self.ocean, self.hull = make(pelagic.pelagic_sea), ctypes.c_void_p(), ctypes.c_void_p()
        sea.cascades, sea.resolution, sea.wind_speed_mps = 2, 32, 12
        self.call("ocean_create", sea, make(pelagic.pelagic_ocean_options, queries=1, depth=1), ctypes.byref(self.ocean))
        options = make(pelagic.pelagic_hull_options)
        options.mass_kg, options.roll_damping = mass_kg, 0.125
        options.centre_of_mass_m, options.inertia_kgm2 = (self.address(ctypes.c_double, of) for of in (centre_of_mass_m, inertia_kgm2))
        vertices = boat[0]["vertices"] + boat[1]["vertices"]
        triangles = sides + [(i, i + 2, i + 1) for i in range(10, len(vertices) // 3, 3)]
        numbers = [number for triangle in triangles for number in triangle]
        self.call("hull_create", make(pelagic.pelagic_hull_mesh, vertex_count=len(vertices) // 3, vertices_m=self.address(ctypes.c_double, vertices),
                                       triangle_count=len(triangles), triangles=self.address(ctypes.c_uint32, numbers)),
                  options, ctypes.byref(self.hull))

    def at_rest(self, x_m, z_m, heading_rad=0.0):
        """The state in which the mesh's origin is at a position."""
        state, centre = pelagic.pelagic_hull_state(), centre_of_mass_m
        cosine, sine = math.cos(heading_rad), math.sin(heading_rad)
        self.call("hull_at_rest", self.hull, x_m + cosine * centre[0] - sine * centre[2], z_m + sine * centre[0] + cosine * centre[2],
                  heading_rad, state)
        return state

    def bodies(self, *states):
        bodies, number = ctypes.c_void_p(), ctypes.c_uint32()
        self.call("bodies_create", self.ocean, None, ctypes.byref(bodies))
        for state in states:
            self.call("bodies_add", bodies, self.hull, state, ctypes.byref(number))
        return bodies

    def push(self, bodies, force_n, torque_nm, wind_mps):
        inputs = make(pelagic.pelagic_hull_inputs)
        inputs.force.force_n[:], inputs.force.torque_nm[:], inputs.wind_mps[:] = force_n, torque_nm, wind_mps
        self.call("bodies_set_inputs", bodies, 1, inputs)

    def steps(self, bodies):
        """Yields the saved state of each step."""
        for step in range(steps):
            self.call("ocean_schedule", self.ocean, step / 60.0)
            self.call("ocean_complete", self.ocean, pelagic.pelagic_frame())
            if step == steps // 2:
                self.push(bodies, [-500, 0, 250], [0, 64, 0], [0, 0, 8])
            self.call("bodies_step", bodies, step_s, None)
            yield self.saved(bodies)


def pose_in(saved):
    """The position of the centre of mass, and the hull's axes, in a saved state of one body."""
    x, y, z, qw, qx, qy, qz = struct.unpack_from("<7d", saved, 40 + 32)
    axes = [(1 - 2 * (qy * qy + qz * qz), 2 * (qx * qy + qz * qw), 2 * (qx * qz - qy * qw)),
            (2 * (qx * qy - qz * qw), 1 - 2 * (qx * qx + qz * qz), 2 * (qy * qz + qx * qw)),
            (2 * (qx * qz + qy * qw), 2 * (qy * qz - qx * qw), 1 - 2 * (qx * qx + qy * qy))]
    return (x, y, z), axes


with tempfile.TemporaryDirectory() as folder:
    work = Path(folder)
    there = CInterface()
    # Above the water, heeled and under way.
    tossed = there.at_rest(-7, 12, 1.0)
    tossed.position_m[1] += 2
    tossed.orientation[:] = [0.48, 0.0, 0.6, 0.64]
    tossed.velocity_mps[:], tossed.angular_velocity_radps[:] = [3, -1, 0.5], [0.1, 0, -0.2]
    tossed_bodies = there.bodies(tossed)
    there.push(tossed_bodies, [100, 0, 50], [0, -32, 0], [0, 0, -4])
    (work / "start").write_bytes(there.saved(tossed_bodies))
    (work / "two").write_bytes(there.saved(there.bodies(tossed, tossed)))
    second = there.bodies(tossed, tossed)
    there.call("bodies_remove", second, 1)
    (work / "second").write_bytes(there.saved(second))

    given = {"still_sea": {"resolution": 32, "cascades": 1, "patch_size_m": 100, "wind_speed_mps": 0.01, "depth": True, "playing": False},
             "origin_sea": {"cascades": 2, "resolution": 32, "wind_speed_mps": 12, "depth": True, "playing": False,
                            "dynamic_waves": True, "dynamic_waves_resolution": 64, "dynamic_waves_border_m": 8},
             "sea": {"cascades": 2, "resolution": 32, "wind_speed_mps": 12, "depth": True, "playing": False},
             "box": box, "mass_of_box": mass_of_box, "boat": boat, "mass_kg": mass_kg, "centre_of_mass_m": centre_of_mass_m,
             "inertia_kgm2": inertia_kgm2, "force_n": force_n, "steps": steps, "refused": [wrong[:3] for wrong in refused],
             "pose": [1, 0, 0, 0, 1, 0, 0, 0, 1, 3, 0.5, 4],
             # The bow heels over: the heading is that of (-0.6, 0.48).
             "turned_pose": [-0.6, 0.64, 0.48, 0.5, 0.7684, -0.3996, -0.62459, 0.00024, -0.78109, 3, 2, -5]}
    says = run_headless(project, here / "hulls.gd", work, {"GIVEN": json.dumps(given), "FILES": folder}, fps=60)

    # A prism of 64 sides on a circle of 1 m, 2 m high; a cylinder of 1 m and a ball, 64 sides.
    volumes_m3 = {name: float(number) for name, number in (words.split() for words in says["volume"])}
    assert abs(volumes_m3["CylinderMesh"] / (64 * math.sin(2 * math.pi / 64)) - 1) < 1e-6, volumes_m3
    assert abs(volumes_m3["CapsuleMesh"] / (math.pi + 4 / 3 * math.pi) - 1) < 0.01, volumes_m3
    assert single(says, "round") == "[]"

    assert abs(float(single(says, "level")) / (mass_of_box / 1025 / 8) - 1) < 0.005, says["level"]

    # floats of 2 km are 1.2e-4 m apart
    assert all(abs(float(single(says, f"origin_{of}"))) < 1e-3 for of in ("at_once", "boat", "water")), says
    assert float(single(says, "origin_went")) > 0.05 and single(says, "origin_hash") == single(says, "origin_null") == "True"
    assert json.loads(single(says, "origin_refused")) == ["origin_x_m 200000000 is out of range [-1e8, 1e8]"], says["origin_refused"]

    compared = 0
    poses = [words.split() for words in says["pose"]]
    for case, bodies in (("launched", there.bodies(there.at_rest(3, 4))), ("restored", tossed_bodies)):
        if case == "launched":
            there.push(bodies, force_n, [0, 0, 0], [0, 0, 0])
        states = (work / case).read_bytes()
        size = len(states) // steps
        expected = list(there.steps(bodies))
        for step, state in enumerate(expected):
            assert states[size * step:size * (step + 1)] == state, (case, step)
            compared += 1
        assert len(set(expected)) == steps and len(states) == size * steps
        # The node has the pose of the state.
        rows = {int(step): list(map(float, numbers)) for of, step, *numbers in poses if of == case}
        assert len(rows) == 10
        for step, numbers in rows.items():
            position, axes = pose_in(expected[step])
            origin = [position[i] - sum(axes[j][i] * centre_of_mass_m[j] for j in range(3)) for i in range(3)]
            apart = max(abs(a - b) for a, b in zip(numbers, [*axes[0], *axes[1], *axes[2], *origin]))
            assert apart < 3e-6, (case, step, apart)  # floats of 10 m
        assert max(abs(pose_in(state)[1][1][0]) + abs(pose_in(state)[1][1][2]) for state in expected) > 0.02, "waves rock the hull"
    assert single(says, "inputs") == "(100, 0, 50) (0, -32, 0) (0, 0, -4)", says["inputs"]
    assert single(says, "no_errors") == "[]"
    # A launch makes the hull upright, and keeps the heading of the bow.
    here_position, here_axes = pose_in((work / "turned").read_bytes())
    heading = math.atan2(struct.unpack("<f", struct.pack("<f", 0.48))[0], struct.unpack("<f", struct.pack("<f", -0.6))[0])
    position, axes = pose_in(there.saved(there.bodies(there.at_rest(3, -5, heading))))
    for one, other in zip([here_position, *here_axes], [position, *axes]):
        assert max(abs(a - b) for a, b in zip(one, other)) < 1e-12, (one, other)

    assert len(says["refused"]) == len(refused)
    for (_, _, _, line), said in zip(refused, says["refused"]):
        assert line is None or json.loads(said) == [line], (said, line)
        for only in json.loads(said):
            assert "\n" not in only and "PelagicHull: " + only in says["lines"], only
    assert says["answer"] == ["True"] * sum(wrong[0] == "method" for wrong in refused)
    assert json.loads(single(says, "restore")) == restored, (says["restore"], restored)
    assert single(says, "unchanged") == "True"
    assert json.loads(single(says, "unusable")) == unusable, (says["unusable"], unusable)
    assert single(says, "untouched") == "True"
    assert single(says, "usable") == "[] True"
    assert json.loads(single(says, "emptied")) == ["mesh is null, expected a closed Mesh"], says["emptied"]

    assert all(float(word) < 1e-6 for word in single(says, "kept").split()), says["kept"]
    assert single(says, "derived").split(" ", 1)[0] == "True", says["derived"]
    freed, kept = single(says, "freed").rsplit(" ", 1)
    assert json.loads(freed) == [not_in_tree, no_ocean, no_ocean] and kept == "True", says["freed"]
    assert single(says, "again") == "[] True", says["again"]
    assert single(says, "mesh_freed") == "True []", says["mesh_freed"]
    once, still = single(says, "once").rsplit(" ", 1)
    assert json.loads(once) == ["the ocean has no depth: set depth to true"] and still == "True", says["once"]
    origin_m, water_m, up = map(float, single(says, "scene").split())
    assert abs(origin_m - water_m) < 1 and 0.8 < up < 1 and abs(origin_m) > 1e-3, says["scene"]
    assert single(says, "paused") == "True 1", says["paused"]
    assert "end" in says
print(f"{compared} states and {len(refused) + len(unusable) + len(restored)} errors agree")
