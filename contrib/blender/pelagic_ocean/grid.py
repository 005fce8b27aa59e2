"""The mesh of an ocean object: a square grid of faces around the object's origin.

Pelagic's y is up, x east and z south; Blender's z is up. Pelagic's (x, y, z) is Blender's
(x, -z, y), a rotation about x."""
import numpy


def reference_points(size, resolution, place):
    """Returns undisplaced x and z of the vertices in Pelagic's axes, in double. Vertex
    i + j (resolution + 1) lies i faces along +X and j along +Y."""
    steps = (numpy.arange(resolution + 1) / resolution - 0.5) * size
    points = numpy.empty(((resolution + 1) ** 2, 2))
    points[:, 0] = numpy.tile(steps + place[0], resolution + 1)
    points[:, 1] = -numpy.repeat(steps + place[1], resolution + 1)
    return points


def reference_vertices(size, resolution, place):
    """Returns the undisplaced vertices in Blender's axes, in double."""
    points = reference_points(size, resolution, place)
    return numpy.column_stack([points[:, 0], -points[:, 1], numpy.zeros(len(points))])


def from_pelagic(vectors):
    """Returns vectors of Pelagic's axes in Blender's axes."""
    rotated = numpy.empty_like(vectors)
    rotated[:, 0] = vectors[:, 0]
    rotated[:, 1] = -vectors[:, 2]
    rotated[:, 2] = vectors[:, 1]
    return rotated


def fill(mesh, resolution, vertices):
    """Replaces the mesh by such a grid. Its materials stay."""
    side = resolution + 1
    first = (numpy.arange(resolution)[None, :] + numpy.arange(resolution)[:, None] * side).ravel()
    corners = numpy.stack([first, first + 1, first + side + 1, first + side], axis=1).astype(numpy.int32)
    mesh.clear_geometry()
    mesh.vertices.add(side * side)
    mesh.vertices.foreach_set("co", vertices.ravel())
    mesh.loops.add(corners.size)
    mesh.loops.foreach_set("vertex_index", corners.ravel())
    mesh.polygons.add(len(corners))
    mesh.polygons.foreach_set("loop_start", numpy.arange(0, corners.size, 4, dtype=numpy.int32))
    mesh.polygons.foreach_set("loop_total", numpy.full(len(corners), 4, numpy.int32))
    mesh.polygons.foreach_set("use_smooth", numpy.ones(len(corners), bool))
    mesh.update(calc_edges=True)
    # Vertices lie at pixel centres of an image that has a pixel per vertex.
    uv = mesh.uv_layers.new(name="UVMap")
    places = numpy.stack([corners % side, corners // side], axis=2)
    uv.data.foreach_set("uv", ((places + 0.5) / side).astype(numpy.float32).ravel())


def has_resolution(mesh, resolution):
    return len(mesh.vertices) == (resolution + 1) ** 2 and len(mesh.polygons) == resolution ** 2


def write(mesh, rest, vertices, foam, velocity):
    """Moves the vertices and sets the point attributes `rest_position`, `foam` and `velocity`.
    Removes `foam` or `velocity` if it is None."""
    mesh.vertices.foreach_set("co", vertices.ravel())
    set_attribute(mesh, "rest_position", "FLOAT_VECTOR", "vector", rest)
    set_attribute(mesh, "foam", "FLOAT", "value", foam)
    set_attribute(mesh, "velocity", "FLOAT_VECTOR", "vector", velocity)
    mesh.update()


def set_attribute(mesh, name, kind, field, values):
    attribute = mesh.attributes.get(name)
    if attribute and (values is None or attribute.domain != "POINT" or attribute.data_type != kind):
        mesh.attributes.remove(attribute)
        attribute = None
    if values is None:
        return
    if not attribute:
        attribute = mesh.attributes.new(name, kind, "POINT")
    attribute.data.foreach_set(field, values.ravel())
