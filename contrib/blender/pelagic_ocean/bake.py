"""An ocean on disk, which plays in a Blender without Pelagic.

The folder has vertices.pc2 (for the Mesh Cache modifier), foam_0001.png and so on (a pixel a vertex, for the material), and sea.json:
the sea, as `pelagic query --config` reads it, and of each frame the sea's time and hash. sea.json comes last, when all is there.
Until then bake.journal has what is baked, and a line for each frame that is done: the next run goes on behind the last of them."""
import dataclasses
import hashlib
import json
import os

import bpy
import numpy

from . import grid, library, material, sea_object, shore
from .exr import exr
from .grey_png import grey_png
from .pc2_file import Pc2Writer, whole_frames

modifier_name = "Pelagic Bake"


class BakeError(Exception):
    """One line for the artist."""


def folder_of(object):
    settings = object.pelagic
    if settings.bake_folder.startswith("//") and not bpy.data.filepath:
        raise BakeError(f"Folder is {settings.bake_folder}, which lies beside the .blend: save that first, or choose another")
    return os.path.join(bpy.path.abspath(settings.bake_folder), bpy.path.clean_name(object.name))


def image_name(frame):
    return f"foam_{frame:04d}.png"


def reject_keys(object):
    """Time Offset may be keyed; what else makes the sea stands still in a bake."""
    animation = object.animation_data
    if not animation:
        return
    curves = [*(animation.action.fcurves if animation.action else ()), *animation.drivers]
    for curve in curves:
        if curve.data_path.startswith("pelagic.") and (curve.data_path != "pelagic.time_offset" or curve in animation.drivers[:]):
            raise BakeError(f"{curve.data_path} is animated, and a bake knows keys of Time Offset alone: remove the others")


def what_is_baked(object, scene):
    """All that the files depend on."""
    settings = object.pelagic
    size, resolution, place = sea_object.square_of(settings)
    baked = {"version": library.pelagic.__version__, "sea": sea_object.record_of(settings),
             "mesh": {"size_m": size, "resolution": resolution, "place_m": list(place), "foam": settings.foam}}
    keys = sea_object.keys_of(settings)
    if keys.waves:
        baked["dynamic_waves"] = {"side_m": keys.waves.grid.side_m, "resolution": keys.waves.grid.resolution,
                                  "middle_m": list(keys.waves.center), "events": digest_of(keys.waves.events_text.encode()),
                                  "rain": dataclasses.asdict(keys.waves.rain), "rain_start_s": keys.waves.start_s}
    if keys.ocean.floor:
        floor = shore.floors[keys.ocean.floor]
        baked["shore"] = {"floor": digest_of(floor.heights.tobytes()), "size_m": floor.size_m, "middle_m": list(floor.middle_m)}
    baked["frames"] = [{"frame": frame, "time_s": sea_object.sea_time(settings, scene, frame)}
                       for frame in range(settings.bake_start, settings.bake_end + 1)]
    return baked


def digest_of(content):
    return hashlib.blake2b(content, digest_size=8).hexdigest()


def inputs_of(settings):
    """Returns the files that the command line needs beside sea.json: by name, their content."""
    keys, files = sea_object.keys_of(settings), {}
    if keys.waves and keys.waves.events_text:
        files["events.csv"] = keys.waves.events_text.encode()
    if keys.ocean.floor:
        files["floor.exr"] = exr(shore.floors[keys.ocean.floor].heights)
    return files


def run(object, scene):
    """Bakes and then lets the object play the bake. Yields (frames done, frames) after each, so that whoever waits can show it or stop;
    raises BakeError, and what is done stays for the next run."""
    settings = object.pelagic
    if library.problem:
        raise BakeError(library.problem)
    if settings.bake_end < settings.bake_start:
        raise BakeError(f"Bake End is {settings.bake_end}, expected {settings.bake_start} or more, where it starts")
    reject_keys(object)
    folder = folder_of(object)
    try:
        baked = what_is_baked(object, scene)
        os.makedirs(folder, exist_ok=True)
        if not is_whole(folder, baked):
            yield from write_frames(settings, folder, baked)
    except OSError as error:
        raise BakeError(f"{error.filename or folder}: {error.strerror}") from error
    except (ValueError, MemoryError, RuntimeError) as error:
        raise BakeError(sea_object.line_of(error)) from error
    play(object, folder, baked)


def is_whole(folder, baked):
    try:
        with open(os.path.join(folder, "sea.json"), encoding="utf-8") as file:
            record = json.load(file)
        for frame in record["frames"]:
            del frame["hash"]
    except (OSError, ValueError, KeyError, TypeError):
        return False
    return record == baked


def write_frames(settings, folder, baked):
    frames, points = baked["frames"], (settings.resolution + 1) ** 2
    cache, record = os.path.join(folder, "vertices.pc2"), os.path.join(folder, "sea.json")
    journal_path = os.path.join(folder, "bake.journal")
    if os.path.exists(record):
        os.remove(record)  # of another bake
    for name, content in inputs_of(settings).items():
        write_whole(os.path.join(folder, name), content)
    plan = json.dumps(baked)
    hashes = hashes_of_journal(journal_path, plan)[:whole_frames(cache, points)]
    write_whole(journal_path, "".join(line + "\n" for line in [plan, *hashes]).encode())
    writer = Pc2Writer(cache, points, frames[0]["frame"], len(frames), len(hashes))
    try:
        with open(journal_path, "a", encoding="utf-8") as journal:
            for frame in frames[len(hashes):]:
                moved = sea_object.moved(settings, frame["time_s"])
                if settings.foam:
                    write_whole(os.path.join(folder, image_name(frame["frame"])), foam_view(moved.foam, settings.resolution))
                writer.add(moved.vertices)
                hashes.append(f"{moved.frame.hash:016x}")
                print(hashes[-1], file=journal, flush=True)
                yield len(hashes), len(frames)
        writer.finish()
    finally:
        writer.stop()
    done = baked | {"frames": [frame | {"hash": hash} for frame, hash in zip(frames, hashes)]}
    write_whole(record, json.dumps(done, indent=1).encode())
    os.remove(journal_path)


def hashes_of_journal(path, plan):
    """Of the frames that an earlier run of the same bake did; a last line without an end is none."""
    try:
        with open(path, encoding="utf-8") as file:
            first, *lines = file.read().split("\n")[:-1]
    except (OSError, ValueError):
        return []
    return lines if first == plan else []


def write_whole(path, content):
    """A file that is there whole or not at all."""
    part = path + ".part"
    with open(part, "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    os.replace(part, path)


def foam_view(foam, resolution):
    """The vertex farthest in +Y stands in the uppermost row, as texture coordinates have it."""
    greys = numpy.floor(foam.reshape(resolution + 1, resolution + 1) * 255 + 0.5).astype(numpy.uint8)
    return grey_png(greys[::-1])


def play(object, folder, baked):
    """From now on the files move the mesh: nothing that plays needs this add-on."""
    settings, frames = object.pelagic, baked["frames"]
    settings.is_baked = True
    if not grid.has_resolution(object.data, settings.resolution):
        grid.fill(object.data, settings.resolution, sea_object.reference_of(settings).vertices.astype(numpy.float32))
    remove_modifier(object)
    cache = object.modifiers.new(modifier_name, "MESH_CACHE")
    cache.cache_format = "PC2"
    cache.filepath = beside_the_blend(os.path.join(folder, "vertices.pc2"))
    cache.frame_start = frames[0]["frame"]
    cache.interpolation = "LINEAR"
    while object.modifiers[0] != cache:  # before those that the artist put there
        with bpy.context.temp_override(object=object):
            bpy.ops.object.modifier_move_up(modifier=modifier_name)
    grid.set_attribute(object.data, "rest_position", "FLOAT_VECTOR", "vector", sea_object.reference_of(settings).position)
    # The mesh itself stands still from now on, and an attribute of one moment would stay.
    grid.set_attribute(object.data, "foam", "FLOAT", "value", None)
    grid.set_attribute(object.data, "velocity", "FLOAT_VECTOR", "vector", None)
    if settings.foam:
        first = frames[0]["frame"]
        image = beside_the_blend(os.path.join(folder, image_name(first)))
        change_material(object, material.live_name, material.baked_water(f"{material.live_name} {object.name}", image, first, len(frames)))


def go_live(object):
    """The sea moves the mesh again; the files stay."""
    object.pelagic.is_baked = False
    remove_modifier(object)
    change_material(object, f"{material.live_name} {object.name}", material.water())


def remove_modifier(object):
    old = object.modifiers.get(modifier_name)
    if old:
        object.modifiers.remove(old)


def change_material(object, name, by):
    for slot in object.material_slots:
        if slot.material and (slot.material.name == name or slot.material == by):
            slot.material = by


def beside_the_blend(path):
    """A .blend and its bake may move together."""
    return bpy.path.relpath(path) if bpy.data.filepath else path
