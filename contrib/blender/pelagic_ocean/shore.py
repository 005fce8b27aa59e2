"""The sea floor of an ocean object: heights of a mesh object, sampled on a grid from above."""
import hashlib
import typing

import numpy
from mathutils import Vector
from mathutils.bvhtree import BVHTree

from . import library

samples_per_side = 256


class Floor(typing.NamedTuple):
    """Heights as `pelagic query --floor` reads an image of them: the first row has the lowest z."""
    heights: numpy.ndarray  # (rows, columns), metres above the rest level, float32
    size_m: float  # length of a row
    middle_m: tuple  # x, z

    def options(self):
        rows, columns = self.heights.shape
        metres = self.size_m / columns
        x, z = self.middle_m
        return library.pelagic.ShoreOptions(self.heights, corner_x_m=x - 0.5 * metres * (columns - 1),
                                            corner_z_m=z - 0.5 * metres * (rows - 1), metres_per_sample=metres)


floors = {}  # by key


def key_of(settings, place):
    """Returns a digest of the floor's mesh and its position in the sea, or None without a floor.
    Raises ValueError with one line.

    The mesh is the object's data without modifiers, because a viewport and a render may have
    different ones. place: position in the sea of the ocean object's origin"""
    floor = settings.floor
    if not floor:
        return None
    mesh = floor.original.data if floor.type == "MESH" else None
    if not mesh or not mesh.polygons:
        raise ValueError(f"Floor {floor.name}: must be a mesh with faces")
    coordinates = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", coordinates)
    corners = numpy.empty(len(mesh.loops), numpy.int32)
    mesh.loops.foreach_get("vertex_index", corners)
    to_sea = numpy.array(settings.id_data.matrix_world.inverted_safe() @ floor.matrix_world)
    to_sea[:2, 3] += place
    key = hashlib.blake2b(coordinates.tobytes() + corners.tobytes() + to_sea.tobytes(), digest_size=16).hexdigest()
    if key not in floors:
        vertices = coordinates.reshape(-1, 3) @ to_sea[:3, :3].T + to_sea[:3, 3]
        floors[key] = sampled(vertices, [tuple(polygon.vertices) for polygon in mesh.polygons])
    return key


def sampled(vertices, polygons):
    """Samples the highest face at each position. A position without a face has the height of the
    lowest vertex.

    vertices: in Blender's axes around the sea's origin"""
    low, high = vertices.min(axis=0), vertices.max(axis=0)
    width, length = high[:2] - low[:2]
    if not (width > 0 and length > 0):
        raise ValueError(f"Floor of {width:g} x {length:g} m: must have an area seen from above")
    columns = samples_per_side if width >= length else max(2, round(samples_per_side * width / length))
    metres = width / columns
    rows = max(2, round(length / metres))
    middle = (low + high) / 2
    heights = numpy.full((rows, columns), low[2], numpy.float32)
    tree = BVHTree.FromPolygons((vertices - middle).tolist(), polygons)
    above, down = high[2] - middle[2] + 1, Vector((0, 0, -1))
    for row in range(rows):
        y = (0.5 * (rows - 1) - row) * metres
        for column in range(columns):
            hit, *_ = tree.ray_cast(Vector(((column - 0.5 * (columns - 1)) * metres, y, above)), down)
            if hit:
                heights[row, column] = hit.z + middle[2]
    return Floor(heights, float(width), (float(middle[0]), float(-middle[1])))
