"""Events of dynamic waves: the CSV file of `pelagic query --events` (tools/events/event_file.hpp).

The first line names the columns, in any order; each further line is an event:

  time, x, z         seconds, metres in Pelagic's axes: when and where; required
  radius, height     metres; a height below 0 is a depth; required
  velocity, heading  m/s, and degrees from +x towards +z: motion of a source
  duration           seconds of a source; 0 or empty: an impulse
  length             metres: half the length of a hull; 0 or empty: a round shape
  mode               impulse, pressure, relaxation or foam; by default impulse, of a source pressure
"""
import functools
import math
import typing

from . import library

required = ("time", "x", "z", "radius", "height")
# Largest absolute values. pelagic.Disturbance checks values again.
ranges = {"time": 1e9, "x": 1e8, "z": 1e8, "radius": 1000, "height": 100, "velocity": 1000, "heading": 360,
          "duration": 86400, "length": 1000}
not_negative = ("radius", "duration", "length")
modes = ("impulse", "pressure", "relaxation", "foam")


class Event(typing.NamedTuple):
    time_s: float
    duration_s: float
    disturbance: typing.Any  # pelagic.Disturbance


@functools.lru_cache(maxsize=16)
def parse(name, text):
    """Returns the events of a text, at least one. Raises ValueError with one line that has the
    text's name, the line and the value."""
    lines = [(number, [cell.strip() for cell in line.split(",")])
             for number, line in enumerate(text.removeprefix("\ufeff").splitlines(), 1) if line.strip()]
    if not lines:
        raise ValueError(f"{name} is empty: must name the columns time,x,z,radius,height in its first line")
    (first, columns), rows = lines[0], lines[1:]
    for column in columns:
        if column not in (*ranges, "mode") or columns.count(column) > 1:
            names = ", ".join((*ranges, "mode"))
            raise ValueError(f"{name}:{first}: column {column}: must be one of {names}, each once")
    for column in required:
        if column not in columns:
            raise ValueError(f"{name}:{first}: column {column} is missing")
    if not rows:
        raise ValueError(f"{name} has no events: must have rows below its first line")
    return tuple(event_of(name, number, columns, cells) for number, cells in rows)


def event_of(name, number, columns, cells):
    where = f"{name}:{number}: "
    if len(cells) != len(columns):
        raise ValueError(f"{where}{len(cells)} columns: must be {len(columns)}, as in the first line")
    row = dict(zip(columns, cells))
    mode = row.pop("mode", "")
    of = {column: number_of(where, column, cell) for column, cell in row.items() if cell or column in required}
    optional = ("duration", "velocity", "heading", "length")
    duration, velocity, heading, length = (of.get(column, 0.0) for column in optional)
    mode = mode or ("pressure" if duration > 0 else "impulse")
    if mode not in modes or (duration > 0 and mode == "impulse"):
        raise ValueError(f"{where}mode {mode}: must be pressure, relaxation or foam, or impulse without a duration")
    if velocity != 0 and duration == 0:
        raise ValueError(f"{where}velocity {velocity:g}: must be 0 without a duration")
    sine, cosine = sine_cosine_of_turns(heading / 360)
    try:
        disturbance = library.pelagic.Disturbance(
            shape="hull" if length > 0 else "gauss", mode=mode, x_m=of["x"], z_m=of["z"],
            radius_m=of["radius"], length_m=length if length > 0 else of["radius"],
            heading_rad=heading * (math.pi / 180), height_m=of["height"],
            velocity_x_mps=velocity * cosine, velocity_z_mps=velocity * sine)
    except ValueError as error:
        raise ValueError(where + str(error)) from None
    return Event(of["time"], duration, disturbance)


def number_of(where, column, cell):
    largest, smallest = ranges[column], 0 if column in not_negative else -ranges[column]
    try:
        value = float("nan" if "_" in cell else cell)
    except ValueError:
        value = math.nan
    if not smallest <= value <= largest:
        raise ValueError(f"{where}{column} {cell[:40]} is out of range [{smallest:g}, {largest:g}]")
    return value


def commands(events, ticks_per_s):
    """Returns (tick, adds, index of the event) in order. An event begins in the first tick that is
    not before it; a source ends in a command with adds = False."""
    def tick_at(time_s):
        return math.ceil(time_s * ticks_per_s - 2 ** -16)  # event_player.cpp

    found = []
    for index, event in enumerate(events):
        begin = tick_at(event.time_s)
        found.append((begin, True, index))
        if event.duration_s > 0:
            found.append((max(begin + 1, tick_at(event.time_s + event.duration_s)), False, index))
    return sorted(found)


def sine_cosine_of_turns(turns):
    """Returns sin(2 pi turns) and cos(2 pi turns), bit-identical to simd/det_math.cpp. libm differs
    between systems."""
    quarters = math.floor(4 * turns + 0.5)
    angle = (turns - quarters * 0.25) * (2 * math.pi)
    z = angle * angle
    sine = cosine = 1.0
    for term in range(16, 1, -2):
        sine = 1 - sine * z / (term * (term + 1))
        cosine = 1 - cosine * z / (term * (term - 1))
    sine *= angle
    return ((sine, cosine), (cosine, -sine), (-sine, -cosine), (-cosine, sine))[quarters & 3]
