"""What stands between an object's settings and its mesh: the sea that the settings ask for, an ocean that makes it, vertices."""
import contextlib
import dataclasses
import math
import typing

import bpy
import numpy

from . import grid, library
from .typed_numbers import typed, typed_degrees


class OceanKey(typing.NamedTuple):
    """What an ocean is made of. Objects that ask for the same share one, but for foam: a jump of time makes foam
    anew, which takes as long as ten to twenty frames, and each object has a time of its own."""
    sea: typing.Any
    foam: bool
    velocity: bool
    owner: str


oceans = {}
kept = {}  # by scenes' names, the keys of oceans that they use
rests = {}  # the last few squares of reference points


class Moved(typing.NamedTuple):
    """One moment of a mesh: float32 arrays, a row a vertex, in Blender's axes."""
    vertices: numpy.ndarray
    foam: typing.Optional[numpy.ndarray]
    velocity: typing.Optional[numpy.ndarray]
    frame: typing.Any  # of the library, as long as the ocean makes no later ones


is_quiet = False


@contextlib.contextmanager
def quiet():
    """Many settings change, and the mesh is brought up to date once, by whoever changes them."""
    global is_quiet
    is_quiet = True
    try:
        yield
    finally:
        is_quiet = False


def is_live(object):
    settings = object.pelagic
    # A linked object belongs to its own file, and a mesh in edit mode to its editor.
    return (settings.is_ocean and not settings.is_baked and object.type == "MESH" and not object.library
            and not object.data.library and object.mode != "EDIT")


def sea_of(settings):
    """The preset's sea with the panel's options. Raises ValueError with one line."""
    sea = library.pelagic.preset(settings.preset)
    changes = {
        "wind_speed_mps": typed(settings.wind_speed),
        "wind_direction_rad": math.radians(typed_degrees(settings.wind_direction)),
        "choppiness": typed(settings.choppiness),
        "loop_period_s": typed(settings.loop_period),
        "cascades": settings.cascades,
        "resolution": int(settings.cascade_resolution),
        "patch_size_m": typed(settings.cascade_side),
    }
    if has_spectrum(sea):
        changes |= {
            "spectrum": settings.spectrum,
            "spreading": settings.spreading,
            "fetch_m": typed(settings.fetch),
            "depth_m": typed(settings.depth),
            "wind_alignment": typed(settings.wind_alignment),
            "short_wave_cutoff": typed(settings.short_wave_cutoff),
            "swell_height_m": typed(settings.swell_height),
            "swell_period_s": typed(settings.swell_period),
            "swell_direction_rad": math.radians(typed_degrees(settings.swell_direction)),
            "swell_spread_rad": math.radians(typed_degrees(settings.swell_spread)),
            "seed": settings.seed,
        }
    else:
        changes |= {"wave_strength": typed(settings.wave_strength), "wave_height_m": typed(settings.wave_height)}
    return dataclasses.replace(sea, **changes)


def record_of(settings):
    """The sea as sea.json has it, for `pelagic query --config` and the like: angles in degrees."""
    record = dataclasses.asdict(sea_of(settings))
    for name in [name for name in record if name.endswith("_rad")]:
        record[name[:-len("rad")] + "deg"] = round(math.degrees(record.pop(name)), 4) + 0.0
    return record


def has_spectrum(sea):
    return sea.waves == "spectrum"


def key_of(settings):
    owner = settings.id_data.name if settings.foam else ""
    return OceanKey(sea_of(settings), settings.foam, settings.velocity, owner)


def ocean_of(settings):
    key = key_of(settings)
    if key not in oceans:
        oceans[key] = library.pelagic.Ocean(key.sea, queries=False, foam=key.foam, velocities=key.velocity)
    return oceans[key]


def sea_time(settings, scene, frame=None):
    """The sea's time in seconds at the scene's moment, or in a frame; in double, as frame_current_final is not."""
    at = scene.frame_current + scene.frame_subframe if frame is None else frame
    offset = settings.time_offset if frame is None else time_offset_in(settings, frame)
    frames_a_second = scene.render.fps / typed(scene.render.fps_base)
    return typed(offset) + (at - settings.first_frame) * typed(settings.speed) / frames_a_second


def time_offset_in(settings, frame):
    animation = settings.id_data.animation_data
    curve = animation and animation.action and animation.action.fcurves.find("pelagic.time_offset")
    return curve.evaluate(frame) if curve else settings.time_offset


def square_of(settings):
    """Side and faces a side of the mesh, and which place of the sea its middle shows."""
    return typed(settings.size), settings.resolution, tuple(typed(part) for part in settings.place)


class Reference(typing.NamedTuple):
    """Where the vertices of a square rest, a row each."""
    points: numpy.ndarray    # x and z of Pelagic's world, in double
    vertices: numpy.ndarray  # in Blender, in double: around the origin, whatever the place in the sea
    position: numpy.ndarray  # the same in the sea: the attribute rest_position, float32


def reference_of(settings):
    square = square_of(settings)
    if square not in rests:
        if len(rests) >= 8:
            rests.pop(next(iter(rests)))
        size, resolution, _ = square
        rests[square] = Reference(grid.reference_points(*square), grid.reference_vertices(size, resolution, (0, 0)),
                             grid.reference_vertices(*square).astype(numpy.float32))
    return rests[square]


def moved(settings, time_s):
    """The sea's points at a time. Raises ValueError with one line for options that make no sea."""
    if library.problem:
        raise ValueError(library.problem)
    rest = reference_of(settings)
    frame = ocean_of(settings).frame_at(time_s)
    water = frame.sample_undisplaced(rest.points)
    vertices = (rest.vertices + grid.from_pelagic(water["displacement"])).astype(numpy.float32)
    velocity = grid.from_pelagic(water["velocity"]) * numpy.float32(settings.speed) if settings.velocity else None
    return Moved(vertices, water["foam"] if settings.foam else None, velocity, frame)


def update(object, scene, settings):
    """Brings the mesh to the scene's moment. What can't be made leaves the mesh as it was, and its reason in the object's error.
    Returns the key of the ocean that was used, or None.

    settings: the object's, or those of its copy that a render evaluated"""
    try:
        now = moved(settings, sea_time(settings, scene))
    except (ValueError, MemoryError, RuntimeError) as error:
        note_error(object, line_of(error))
        return None
    note_error(object, "")
    if not grid.has_resolution(object.data, settings.resolution):
        grid.fill(object.data, settings.resolution, now.vertices)
    grid.write(object.data, reference_of(settings).position, now.vertices, now.foam, now.velocity)
    return key_of(settings)


def line_of(error):
    return str(error).splitlines()[0] if str(error) else "There is not enough memory"


def note_error(object, line):
    settings = object.pelagic
    if settings.error != line:
        settings.error = line
        if line:
            print(f"Pelagic: {object.name}: {line}")


def keys_in(scene):
    """Of the oceans that its objects ask for."""
    keys = set()
    for object in scene.objects:
        if is_live(object):
            try:
                keys.add(key_of(object.pelagic))
            except ValueError:
                pass
    return keys


def keep(scene, keys):
    """Of the scene's oceans only these, and those of other scenes, which may take turns with it."""
    kept[scene.name] = keys
    for name in [name for name in kept if name not in bpy.data.scenes]:
        del kept[name]
    used = set().union(*kept.values())
    for key in [key for key in oceans if key not in used]:
        del oceans[key]


def forget_all():
    oceans.clear()
    kept.clear()
    rests.clear()
