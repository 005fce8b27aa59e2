"""Records the motion of objects as events of dynamic waves."""
import math

import numpy

from . import sea_object
from .typed_numbers import typed

header = "time,x,z,radius,height,velocity,heading,duration,length,mode"
ticks_per_s = 60
types = ("MESH", "CURVE", "SURFACE", "META", "FONT")


def objects_of(settings):
    if not settings.sources:
        return []
    return [each for each in settings.sources.all_objects if each.type in types and not each.pelagic.is_ocean]


def record(object, scene, depsgraph_of_frame):
    """Returns the text of the events file of the scene's frames. Raises ValueError with one line.

    depsgraph_of_frame  goes to a frame and returns its evaluated dependency graph"""
    settings = object.pelagic
    sources = objects_of(settings)
    if not sources:
        raise ValueError("Objects: must be a collection with a mesh, curve, surface, metaball or text object")
    frames = range(scene.frame_start, scene.frame_end + 1)
    times = [sea_object.sea_time(settings, scene, frame) for frame in frames]
    shortest_s = min((later - earlier for earlier, later in zip(times, times[1:])), default=0)
    if not shortest_s > 0:
        raise ValueError("The sea's time stops or goes back: must advance from frame to frame")
    # A row lasts at least a tick, because two rows of an object in one tick would act twice.
    stride = max(1, math.ceil(1 / ticks_per_s / shortest_s - 1e-6))
    poses, kept_times = [], times[::stride]
    for frame in frames[::stride]:
        depsgraph = depsgraph_of_frame(frame)
        to_local = object.evaluated_get(depsgraph).matrix_world.inverted_safe()
        poses.append([pose_of(source.evaluated_get(depsgraph), to_local, settings.place) for source in sources])
    rows = [header]
    for time_s, next_s, now, then in zip(kept_times, kept_times[1:], poses, poses[1:]):
        for here, there in zip(now, then):
            if here.draught > 0:
                rows.append(row_of(time_s, next_s - time_s, here, there, settings.source_mode))
    if len(rows) == 1:
        raise ValueError(f"Objects {settings.sources.name}: at least one must cut the sea's rest level, Z 0 of "
                         f"{object.name}, in frames {scene.frame_start} to {scene.frame_end}")
    return "\n".join(rows) + "\n"


class pose_of:
    """The half ellipsoid of an object's bounding box, in Pelagic's axes."""

    def __init__(self, source, to_local, place):
        to_sea = numpy.array(to_local @ source.matrix_world)
        corners = numpy.array(source.bound_box) @ to_sea[:3, :3].T + to_sea[:3, 3]
        low, high = corners.min(axis=0), corners.max(axis=0)
        centre = (low + high) / 2
        self.draught = -low[2] if low[2] < 0 < high[2] else 0.0
        self.x, self.z = centre[0] + typed(place[0]), -(centre[1] + typed(place[1]))
        # The length lies along the box's axis that is longest seen from above.
        box = numpy.array(source.bound_box)
        axes = to_sea[:2, :3] * (box.max(axis=0) - box.min(axis=0)) / 2
        axis = axes[:, numpy.linalg.norm(axes, axis=0).argmax()]
        along = axis / max(numpy.linalg.norm(axis), 1e-30)
        offsets = corners[:, :2] - centre[:2]
        self.length = numpy.abs(offsets @ along).max()
        self.radius = numpy.abs(offsets @ (-along[1], along[0])).max()
        self.along = along[0], -along[1]


def row_of(time_s, duration_s, here, there, mode):
    """Returns a row. Its velocity is the one along the length; the other component of a motion
    advances from row to row."""
    velocity = ((there.x - here.x) * here.along[0] + (there.z - here.z) * here.along[1]) / duration_s
    heading = math.degrees(math.atan2(here.along[1], here.along[0]))
    metres = [here.x, here.z, max(here.radius, 0.001), -here.draught, velocity, heading]
    text = [repr(round(float(number), 6) + 0.0) for number in metres]
    length = max(round(float(here.length), 6), 0.001)
    return ",".join([repr(round(time_s, 9)), *text, repr(round(duration_s, 9)), repr(length), mode])
