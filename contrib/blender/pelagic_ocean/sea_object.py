"""Computes the mesh of an ocean object from its settings: sea, ocean, vertices."""
import contextlib
import dataclasses
import math
import typing

import bpy
import numpy

from . import dynamic_waves, grid, library, shore
from .typed_numbers import typed, typed_degrees


class OceanKey(typing.NamedTuple):
    """All that an ocean depends on. Objects with equal keys share one ocean, unless they have foam:
    after a jump in time foam takes as long as ten to twenty frames, and objects may show different
    times."""
    sea: typing.Any
    foam: bool
    velocity: bool
    owner: str
    grid: typing.Any  # of dynamic waves, or None
    floor: typing.Optional[str]  # key of shore.floors


oceans = {}
kept = {}  # by a scene's name, its keys in oceans, dynamic_waves.players and shore.floors
references = {}  # the last few squares of reference points


class Moved(typing.NamedTuple):
    """A mesh at one time: float32 arrays, a row per vertex, in Blender's axes."""
    vertices: numpy.ndarray
    foam: typing.Optional[numpy.ndarray]
    velocity: typing.Optional[numpy.ndarray]
    frame: typing.Any  # pelagic.Frame, valid until the ocean's next one
    used: set  # keys


is_quiet = False


@contextlib.contextmanager
def quiet():
    """Suspends updates of meshes. The caller updates them once afterwards."""
    global is_quiet
    is_quiet = True
    try:
        yield
    finally:
        is_quiet = False


def is_live(object):
    settings = object.pelagic
    # A linked object belongs to its own file. In edit mode the mesh must not change.
    return (settings.is_ocean and not settings.is_baked and object.type == "MESH" and not object.library
            and not object.data.library and object.mode != "EDIT")


class Setting(typing.NamedTuple):
    """A property of an ocean object and its field of the library's sea."""
    name: str
    field: str
    panel: str
    needs: str  # "", or the seas on which it has an effect, as in schema/sea.toml

    def is_of(self, sea):
        return self.needs in ("", "no_pond", "height") or (self.needs in ("analytic", "no_spectrum")) != has_spectrum(sea)

    def take(self, settings, sea):
        """Takes the value of a preset."""
        value = getattr(sea, self.field)
        setattr(settings, self.name, str(value) if self.field == "resolution" else value)

    def value_in(self, settings):
        value = getattr(settings, self.name)
        if self.field.endswith("_rad"):
            return math.radians(typed_degrees(value))
        if self.field == "resolution":
            return int(value)
        return typed(value) if isinstance(value, float) else value


SETTINGS = (
    # generated from schema/sea.toml: blender-settings
    Setting("spectrum", "spectrum", "spectrum", "spectrum"),
    Setting("spreading", "spreading", "spectrum", "spectrum"),
    Setting("cascades", "cascades", "cascades", ""),
    Setting("cascade_resolution", "resolution", "cascades", ""),
    Setting("cascade_side", "patch_size_m", "cascades", ""),
    Setting("wind_speed", "wind_speed_mps", "waves", ""),
    Setting("wind_direction", "wind_direction_rad", "waves", ""),
    Setting("fetch", "fetch_m", "waves", "fetch"),
    Setting("peak_period", "peak_period_s", "waves", "height"),
    Setting("peak_enhancement", "peak_enhancement", "spectrum", "jonswap"),
    Setting("depth", "depth_m", "waves", ""),
    Setting("choppiness", "choppiness", "waves", "no_pond"),
    Setting("short_wave_cutoff", "short_wave_cutoff", "spectrum", "spectrum"),
    Setting("wind_alignment", "wind_alignment", "spectrum", "paper_spreading"),
    Setting("swell_height", "swell_height_m", "swell", "spectrum"),
    Setting("swell_period", "swell_period_s", "swell", "swell"),
    Setting("swell_direction", "swell_direction_rad", "swell", "swell"),
    Setting("swell_spread", "swell_spread_rad", "swell", "swell"),
    Setting("loop_period", "loop_period_s", "waves", ""),
    Setting("seed", "seed", "waves", "spectrum"),
    Setting("wave_strength", "wave_strength", "waves", "analytic"),
    Setting("wave_height", "wave_height_m", "waves", "height"),
    # end of generated
)

SYSTEM_SETTINGS = (
    # generated from schema/wave_system.toml: blender-settings
    Setting("spectrum", "spectrum", "systems", ""),
    Setting("spreading", "spreading", "systems", ""),
    Setting("wind_speed", "wind_speed_mps", "systems", ""),
    Setting("fetch", "fetch_m", "systems", ""),
    Setting("height", "height_m", "systems", ""),
    Setting("peak_period", "peak_period_s", "systems", ""),
    Setting("peak_enhancement", "peak_enhancement", "systems", ""),
    Setting("direction", "direction_rad", "systems", ""),
    Setting("spread", "spread_rad", "systems", ""),
    # end of generated
)


def take_preset(settings, name):
    """Sets waves, swell, systems and cascades to those of a named sea."""
    sea = library.pelagic.preset(name)
    settings.preset = name
    for setting in SETTINGS:
        setting.take(settings, sea)
    settings.systems.clear()
    for system in sea.systems:
        added = settings.systems.add()
        for setting in SYSTEM_SETTINGS:
            setting.take(added, system)


def sea_of(settings):
    """Returns the preset's sea with the panel's options. Raises ValueError with one line."""
    sea = library.pelagic.preset(settings.preset)
    changes = {setting.field: setting.value_in(settings) for setting in SETTINGS if setting.is_of(sea)}
    if has_spectrum(sea):
        changes["systems"] = tuple(
            library.pelagic.WaveSystem(**{setting.field: setting.value_in(system) for setting in SYSTEM_SETTINGS})
            for system in settings.systems)
    return dataclasses.replace(sea, **changes)


def record_of(settings):
    """Returns the sea as in sea.json, for `pelagic query --config`: angles in degrees."""
    record = dataclasses.asdict(sea_of(settings))
    record["systems"] = list(record["systems"])
    for part in (record, *record["systems"]):
        for name in [name for name in part if name.endswith("_rad")]:
            part[name[:-len("rad")] + "deg"] = round(math.degrees(part.pop(name)), 4) + 0.0
    return record


def has_spectrum(sea):
    return sea.waves == "spectrum"


class Keys(typing.NamedTuple):
    ocean: OceanKey
    waves: typing.Optional[dynamic_waves.WavesKey]


def keys_of(settings):
    owner, sea = settings.id_data.name if settings.foam else "", sea_of(settings)
    waves = dynamic_waves.key_of(settings, sea, typed(time_offset_in(settings, settings.first_frame)))
    floor = shore.key_of(settings, square_of(settings)[2])
    waves_grid = waves.grid if waves else None
    return Keys(OceanKey(sea, settings.foam, settings.velocity, owner, waves_grid, floor), waves)


def ocean_of(key):
    if key not in oceans:
        floor = shore.floors[key.floor].options() if key.floor else None
        oceans[key] = library.pelagic.Ocean(key.sea, queries=False, foam=key.foam, velocities=key.velocity,
                                            dynamic_waves=key.grid, shore=floor)
    return oceans[key]


def sea_time(settings, scene, frame=None):
    """Returns the sea's time in seconds at a frame, by default the current one and subframe."""
    at = scene.frame_current + scene.frame_subframe if frame is None else frame
    offset = settings.time_offset if frame is None else time_offset_in(settings, frame)
    frames_per_second = scene.render.fps / typed(scene.render.fps_base)
    return typed(offset) + (at - settings.first_frame) * typed(settings.speed) / frames_per_second


def time_offset_in(settings, frame):
    animation = settings.id_data.animation_data
    curve = animation and animation.action and animation.action.fcurves.find("pelagic.time_offset")
    return curve.evaluate(frame) if curve else settings.time_offset


def square_of(settings):
    """Returns side, faces along a side, and the position in the sea of the mesh's centre."""
    return typed(settings.size), settings.resolution, tuple(typed(part) for part in settings.place)


class Reference(typing.NamedTuple):
    """Undisplaced vertices of a square, a row each."""
    points: numpy.ndarray    # x and z in Pelagic's axes, in double
    vertices: numpy.ndarray  # in Blender's axes around the object's origin, in double
    position: numpy.ndarray  # in Blender's axes around the sea's origin, float32: rest_position


def reference_of(settings):
    square = square_of(settings)
    if square not in references:
        if len(references) >= 8:
            references.pop(next(iter(references)))
        size, resolution, _ = square
        references[square] = Reference(grid.reference_points(*square),
                                       grid.reference_vertices(size, resolution, (0, 0)),
                                       grid.reference_vertices(*square).astype(numpy.float32))
    return references[square]


def moved(settings, time_s):
    """Returns the mesh at a time. Raises ValueError with one line for invalid options."""
    if library.problem:
        raise ValueError(library.problem)
    reference = reference_of(settings)
    keys = keys_of(settings)
    ocean = ocean_of(keys.ocean)
    if keys.waves:
        ocean.dynamic_waves.restore_state(dynamic_waves.state_at(keys.waves, time_s))
    frame = ocean.frame_at(time_s)
    water = frame.sample_undisplaced(reference.points)
    vertices = (reference.vertices + grid.from_pelagic(water["displacement"])).astype(numpy.float32)
    velocity = grid.from_pelagic(water["velocity"]) * numpy.float32(settings.speed) if settings.velocity else None
    return Moved(vertices, water["foam"] if settings.foam else None, velocity, frame, used_by(keys))


def used_by(keys):
    return {key for key in (keys.ocean, keys.waves, keys.ocean.floor) if key is not None}


def update(object, scene, settings):
    """Updates the mesh to the scene's time. If that fails, the mesh stays as it was and the
    object's error is set. Returns the keys that were used.

    settings: those of the object, or of its evaluated copy in a render"""
    try:
        now = moved(settings, sea_time(settings, scene))
    except (ValueError, MemoryError, RuntimeError) as error:
        note_error(object, line_of(error))
        return set()
    note_error(object, "")
    if not grid.has_resolution(object.data, settings.resolution):
        grid.fill(object.data, settings.resolution, now.vertices)
    grid.write(object.data, reference_of(settings).position, now.vertices, now.foam, now.velocity)
    return now.used


def line_of(error):
    return str(error).splitlines()[0] if str(error) else "Out of memory"


def note_error(object, line):
    settings = object.pelagic
    if settings.error != line:
        settings.error = line
        if line:
            print(f"Pelagic: {object.name}: {line}")


def keys_in(scene):
    """Returns the keys that the scene's objects use."""
    used = set()
    for object in scene.objects:
        if is_live(object):
            try:
                used |= used_by(keys_of(object.pelagic))
            except ValueError:
                pass
    return used


def keep(scene, keys):
    """Frees what neither these keys nor those of other scenes use. Scenes may take turns."""
    kept[scene.name] = keys
    for name in [name for name in kept if name not in bpy.data.scenes]:
        del kept[name]
    used = set().union(*kept.values())
    for held in (oceans, dynamic_waves.players, shore.floors):
        for key in [key for key in held if key not in used]:
            del held[key]


def forget_all():
    for held in (oceans, dynamic_waves.players, shore.floors):
        held.clear()
    kept.clear()
    references.clear()
