"""Bakes an ocean object to files that play without the add-on.

vertices.pc2    vertices, for Blender's modifier Mesh Cache
foam_0001.png   foam of each frame, a pixel per vertex, for the material
events.csv      events of dynamic waves, if there are any
floor.exr       heights of the sea floor, if there is one
sea.json        the sea, as `pelagic query --config` reads it; time and hash of each frame. It is
                written last, when all other files are complete.
bake.journal    exists until then: the options, and one line for each complete frame. The next run
                continues after the last of them.
"""
import dataclasses
import hashlib
import json
import os

import bpy
import numpy

from . import grid, library, material, sea_object, shore
from .exr import exr
from .grey_png import grey_png
from .pc2_file import Pc2Writer, complete_frames

modifier_name = "Pelagic Bake"


class BakeError(Exception):
    """A bake cannot start or continue. The message is one line."""


def folder_of(object):
    settings = object.pelagic
    if settings.bake_folder.startswith("//") and not bpy.data.filepath:
        raise BakeError(f"Folder {settings.bake_folder} is relative to the .blend: save the file first, "
                        "or choose another folder")
    return os.path.join(bpy.path.abspath(settings.bake_folder), bpy.path.clean_name(object.name))


def image_name(frame):
    return f"foam_{frame:04d}.png"


def reject_keys(object):
    """Raises BakeError if a setting other than Time Offset is animated."""
    animation = object.animation_data
    if not animation:
        return
    curves = [*(animation.action.fcurves if animation.action else ()), *animation.drivers]
    drivers = animation.drivers[:]
    for curve in curves:
        is_ours = curve.data_path.startswith("pelagic.")
        if is_ours and (curve.data_path != "pelagic.time_offset" or curve in drivers):
            raise BakeError(f"{curve.data_path} is animated: only Time Offset may have keys in a bake")


def what_is_baked(object, scene):
    """Returns a record of all that the files depend on."""
    settings = object.pelagic
    size, resolution, place = sea_object.square_of(settings)
    baked = {"version": library.pelagic.__version__, "sea": sea_object.record_of(settings),
             "mesh": {"size_m": size, "resolution": resolution, "place_m": list(place), "foam": settings.foam}}
    keys = sea_object.keys_of(settings)
    if keys.waves:
        baked["dynamic_waves"] = {
            "side_m": keys.waves.grid.side_m, "resolution": keys.waves.grid.resolution,
            "middle_m": list(keys.waves.center), "events": digest_of(keys.waves.events_text.encode()),
            "rain": dataclasses.asdict(keys.waves.rain), "rain_start_s": keys.waves.start_s}
    if keys.ocean.floor:
        floor = shore.floors[keys.ocean.floor]
        baked["shore"] = {"floor": digest_of(floor.heights.tobytes()), "size_m": floor.size_m,
                          "middle_m": list(floor.middle_m)}
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
    """Bakes, then lets the object play the bake. Yields (complete frames, all frames) after each
    frame, so that the caller can show progress or stop. Raises BakeError; complete frames are kept
    for the next run."""
    settings = object.pelagic
    if library.problem:
        raise BakeError(library.problem)
    if settings.bake_end < settings.bake_start:
        raise BakeError(f"Bake End {settings.bake_end}: must be at least {settings.bake_start}, the bake's start")
    reject_keys(object)
    folder = folder_of(object)
    try:
        baked = what_is_baked(object, scene)
        os.makedirs(folder, exist_ok=True)
        if not is_complete(folder, baked):
            yield from write_frames(settings, folder, baked)
    except OSError as error:
        raise BakeError(f"{error.filename or folder}: {error.strerror}") from error
    except (ValueError, MemoryError, RuntimeError) as error:
        raise BakeError(sea_object.line_of(error)) from error
    play(object, folder, baked)


def is_complete(folder, baked):
    """Returns whether the folder has a complete bake of this record."""
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
        os.remove(record)  # it belongs to another bake
    for name, content in inputs_of(settings).items():
        write_complete(os.path.join(folder, name), content)
    plan = json.dumps(baked)
    hashes = hashes_of_journal(journal_path, plan)[:complete_frames(cache, points)]
    write_complete(journal_path, "".join(line + "\n" for line in [plan, *hashes]).encode())
    writer = Pc2Writer(cache, points, frames[0]["frame"], len(frames), len(hashes))
    try:
        with open(journal_path, "a", encoding="utf-8") as journal:
            for frame in frames[len(hashes):]:
                moved = sea_object.moved(settings, frame["time_s"])
                if settings.foam:
                    write_complete(os.path.join(folder, image_name(frame["frame"])),
                                   foam_image(moved.foam, settings.resolution))
                writer.add(moved.vertices)
                hashes.append(f"{moved.frame.hash:016x}")
                print(hashes[-1], file=journal, flush=True)
                yield len(hashes), len(frames)
        writer.finish()
    finally:
        writer.stop()
    done = baked | {"frames": [frame | {"hash": hash} for frame, hash in zip(frames, hashes)]}
    write_complete(record, json.dumps(done, indent=1).encode())
    os.remove(journal_path)


def hashes_of_journal(path, plan):
    """Returns the hashes of the frames that an earlier run of the same bake completed. A last line
    without a line feed does not count."""
    try:
        with open(path, encoding="utf-8") as file:
            first, *lines = file.read().split("\n")[:-1]
    except (OSError, ValueError):
        return []
    return lines if first == plan else []


def write_complete(path, content):
    """Writes a file that exists either complete or not at all."""
    part = path + ".part"
    with open(part, "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    os.replace(part, path)


def foam_image(foam, resolution):
    """Returns a PNG file. Its upper row is the vertices with the largest Y, as in texture
    coordinates."""
    greys = numpy.floor(foam.reshape(resolution + 1, resolution + 1) * 255 + 0.5).astype(numpy.uint8)
    return grey_png(greys[::-1])


def play(object, folder, baked):
    """Lets the files move the mesh. Playback does not need the add-on."""
    settings, frames = object.pelagic, baked["frames"]
    settings.is_baked = True
    if not grid.has_resolution(object.data, settings.resolution):
        flat = sea_object.reference_of(settings).vertices.astype(numpy.float32)
        grid.fill(object.data, settings.resolution, flat)
    remove_modifier(object)
    cache = object.modifiers.new(modifier_name, "MESH_CACHE")
    cache.cache_format = "PC2"
    cache.filepath = beside_the_blend(os.path.join(folder, "vertices.pc2"))
    cache.frame_start = frames[0]["frame"]
    cache.interpolation = "LINEAR"
    while object.modifiers[0] != cache:  # before the artist's own modifiers
        with bpy.context.temp_override(object=object):
            bpy.ops.object.modifier_move_up(modifier=modifier_name)
    position = sea_object.reference_of(settings).position
    grid.set_attribute(object.data, "rest_position", "FLOAT_VECTOR", "vector", position)
    # The mesh itself does not change any more, so these attributes would stay those of one frame.
    grid.set_attribute(object.data, "foam", "FLOAT", "value", None)
    grid.set_attribute(object.data, "velocity", "FLOAT_VECTOR", "vector", None)
    if settings.foam:
        first = frames[0]["frame"]
        image = beside_the_blend(os.path.join(folder, image_name(first)))
        baked_water = material.baked_water(f"{material.live_name} {object.name}", image, first, len(frames))
        change_material(object, material.live_name, baked_water)


def go_live(object):
    """Lets the sea move the mesh again. The files stay."""
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
    """Returns a path relative to the .blend, so that it and its bake can be moved together."""
    return bpy.path.relpath(path) if bpy.data.filepath else path
