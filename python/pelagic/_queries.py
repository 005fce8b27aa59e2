"""Queries of frames at points and along rays. Points have shape (..., 2), results (...) or (..., 3)."""

from __future__ import annotations

import ctypes
import math
from collections import defaultdict
from typing import TYPE_CHECKING, Any, Callable, Dict, Iterable, List, Literal, Optional, Tuple, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native as c
from ._library import error_of, last_message, library
from ._numbers import address_of, doubles_of, invalid, list_of, number_of, number_text, rows_of, warn

if TYPE_CHECKING:
    from ._frame import Frame
    from ._ocean import Ocean

Field = Literal["height", "normal", "jacobian", "velocity", "foam", "converged", "error"]
Interpolation = Literal["linear", "cubic"]


class SurfaceSamples(TypedDict, total=False):
    """The results of a query, for each point."""

    height: NDArray[np.float32]  #: metres
    normal: NDArray[np.float32]  #: (..., 3), unit vectors
    jacobian: NDArray[np.float32]  #: 1 undisplaced, small at sharp crests, < 0 if overturned
    velocity: NDArray[np.float32]  #: (..., 3), m/s; requires Ocean(velocities=True)
    foam: NDArray[np.float32]  #: 0 to 1; requires Ocean(foam=True)
    converged: NDArray[np.bool_]  #: the error is within the tolerance
    error: NDArray[np.float32]  #: horizontal distance of the sampled point, metres


class UndisplacedSamples(TypedDict, total=False):
    """The water at n reference positions. Velocity and foam require an ocean that has them."""

    displacement: NDArray[np.float32]  #: (n, 3), displacement in metres
    velocity: NDArray[np.float32]  #: (n, 3), m/s
    foam: NDArray[np.float32]  #: (n,), 0 to 1


class Hits(TypedDict):
    """The first intersection of each ray with the water."""

    hit: NDArray[np.bool_]
    distance: NDArray[np.float64]  #: inf without a hit
    position: NDArray[np.float64]  #: (..., 3), nan without a hit
    normal: NDArray[np.float32]  #: (..., 3), normal of the surface, equal from above and below
    from_below: NDArray[np.bool_]


_FIELDS = ("height", "normal", "jacobian", "velocity", "foam", "converged", "error")
_INTERPOLATIONS = {"linear": c.PELAGIC_INTERPOLATION_LINEAR, "cubic": c.PELAGIC_INTERPOLATION_CUBIC}
# Fields of pelagic_samples, by the names of results.
_ARRAYS = {"height": "height_m", "jacobian": "jacobian", "foam": "foam", "error": "error_m", "converged": "converged"}
_VECTORS = {"normal": ("normal_x", "normal_y", "normal_z"), "velocity": ("velocity_x_mps", "velocity_y_mps", "velocity_z_mps")}
_addressof, _from_buffer = ctypes.addressof, ctypes.c_char.from_buffer  # type: Any, Any
_maximum, _minimum = np.maximum.reduce, np.minimum.reduce
_ocean_query = library.pelagic_ocean_query
_IN_ONE_JOB = 512  # points that one thread queries


class _Call:
    """Structs of a query for results of some names, with pointers to them, which calls use again."""

    __slots__ = ("points", "samples", "pointers")

    def __init__(self) -> None:
        self.points, self.samples = c.sized(c.pelagic_points), c.sized(c.pelagic_samples)
        self.pointers = ctypes.byref(self.points), ctypes.byref(self.samples)


# By the names of results.
_idle_calls: Dict[Tuple[str, ...], List[_Call]] = defaultdict(list)


class _Positions:
    """Points as two contiguous rows, x and z."""

    __slots__ = ("shape", "count", "xz", "x", "z")

    def __init__(self, points: Any, z: Any) -> None:
        if z is None:
            array = doubles_of(points, "points")
            shape = array.shape
            if not shape or shape[-1] != 2:
                raise ValueError(invalid("points.shape", str(shape), "(..., 2): x and z of each point"))
            self.shape: Tuple[int, ...] = shape[:-1]
            self.xz = array.reshape(-1, 2).T.copy()
        else:
            both = np.broadcast_arrays(doubles_of(points, "x"), doubles_of(z, "z"))
            self.shape = both[0].shape
            self.xz = np.empty((2, both[0].size))
            self.xz[0], self.xz[1] = both[0].ravel(), both[1].ravel()
        self.count = count = self.xz.shape[1]
        self.x = _addressof(_from_buffer(self.xz)) if count else None
        self.z = self.x + 8 * count if count else None

    def warn_of_span(self, repeat_m: float) -> None:
        """Warns if the points span more than the sea's repeat length."""
        if self.count < 2:
            return
        (x_max, z_max), (x_min, z_min) = _maximum(self.xz, 1).tolist(), _minimum(self.xz, 1).tolist()
        if x_max - x_min <= repeat_m and z_max - z_min <= repeat_m:
            return
        finite = [row[np.isfinite(row)] for row in self.xz]
        if any(row.size and row.max() - row.min() > repeat_m for row in finite):
            # Without the span: Python shows and stores warnings of equal text once for each line
            # of a program.
            warn(f"the points span more than the {number_text(repeat_m)} m after which the longest waves repeat")

    def check(self, name: Callable[[int], str]) -> None:
        """Raises ValueError for positions beyond 1e9 m."""
        if self.count == 0 or (_minimum(self.xz, None) >= -1e9 and _maximum(self.xz, None) <= 1e9):
            return
        near = np.abs(self.xz) <= 1e9
        point = int(np.argmin(near.all(axis=0)))
        value = self.xz[int(np.argmin(near[:, point])), point]
        raise ValueError(invalid(name(point), number_text(float(value)), "[-1e9, 1e9]"))


def _tolerance(tolerance_m: float) -> float:
    number = tolerance_m if type(tolerance_m) is float else number_of(tolerance_m, "tolerance_m")
    if not 1e-6 <= number <= 1000:
        raise ValueError(invalid("tolerance_m", number_text(number), "[1e-6, 1000]"))
    return number


def _interpolation(name: str) -> int:
    number = _INTERPOLATIONS.get(name)
    if number is None:
        raise ValueError(invalid("interpolation", str(name), "linear or cubic"))
    return number


def _wanted(fields: Optional[Iterable[Any]], ocean: Ocean) -> Tuple[str, ...]:
    """Returns the names of results, in their order."""
    if fields is None:
        return ocean._default_fields
    if isinstance(fields, str) or not hasattr(fields, "__iter__"):
        raise TypeError(invalid("fields", repr(fields), "a list of names"))
    names = {str(name) for name in fields}
    for name in names.difference(_FIELDS):
        raise ValueError(invalid("fields", name, list_of(_FIELDS)))
    return tuple(name for name in _FIELDS if name in names)


class _Results:
    """Result arrays of one time or of several, one after another."""

    __slots__ = ("names", "results", "count", "arrays", "vectors")

    def __init__(self, names: Tuple[str, ...], times: Tuple[int, ...], positions: _Positions) -> None:
        shape, count = times + positions.shape, positions.count
        self.names, self.count = names, count
        self.results: Any = {}
        self.arrays: List[Tuple[str, int, int]] = []  # field, address of the first time, bytes a time
        self.vectors: List[Tuple[Tuple[str, str, str], int, Any, Any]] = []  # fields, address, x y z in rows, results in rows
        for name in names:
            if name in _VECTORS:
                rows = np.empty((3, count), np.float32)
                if count == 1 and not times:  # rows are results
                    vectors = rows.reshape(*shape, 3)
                    self.vectors.append((_VECTORS[name], _addressof(_from_buffer(rows)), None, None))
                else:
                    vectors = np.empty((*shape, 3), np.float32)
                    self.vectors.append((_VECTORS[name], _addressof(_from_buffer(rows)) if count else 0, rows, vectors.reshape(-1, 3)))
                self.results[name] = vectors
            else:
                array: Any = np.empty(shape, np.bool_ if name == "converged" else np.float32)
                self.arrays.append((_ARRAYS[name], _addressof(_from_buffer(array)) if array.size else 0, array.itemsize * count))
                self.results[name] = array

    def sample(self, handle: int, call: _Call, time: int) -> int:
        """Writes the results of a time. Returns the status. `call` has everything else."""
        samples, count = call.samples, self.count
        for field, address, size in self.arrays:
            setattr(samples, field, address + time * size)
        for (x, y, z), address, _, _ in self.vectors:
            setattr(samples, x, address)
            setattr(samples, y, address + 4 * count)
            setattr(samples, z, address + 8 * count)
        status: int = _ocean_query(handle, *call.pointers)
        for _, _, rows, vectors in self.vectors:
            if rows is None:
                continue
            out = vectors[time * count:(time + 1) * count].T
            if count < 256:
                out[...] = rows
            else:  # quicker by axis
                out[0], out[1], out[2] = rows
        return status


def _call_of(names: Tuple[str, ...], positions: _Positions, tolerance_m: float, interpolation: int, frame: int) -> _Call:
    idle = _idle_calls[names]
    try:
        call = idle.pop()
    except IndexError:
        call = _Call()
    points = call.points
    points.count = count = positions.count
    points.x, points.z, points.frame = positions.x, positions.z, frame
    points.interpolation, points.tolerance_m, points.parallel = interpolation, tolerance_m, count > _IN_ONE_JOB
    return call


def query(frame: Frame, points: Any, z: Any, fields: Any, tolerance_m: float, interpolation: str) -> SurfaceSamples:
    ocean, number = frame._ocean, frame._number
    ocean._enter_library(number)
    try:
        tolerance, of_interpolation = _tolerance(tolerance_m), _interpolation(interpolation)
        positions = _Positions(points, z)
        if positions.count > 1:
            positions.warn_of_span(frame._cascades[0].side_m)
        names = _wanted(fields, ocean)
        results = _Results(names, (), positions)
        call = _call_of(names, positions, tolerance, of_interpolation, number)
        status = results.sample(ocean._handle, call, 0)
        _idle_calls[names].append(call)
    finally:
        ocean._leave(math.inf)
    if status:
        raise ocean._error_of(status, number)
    return results.results  # type: ignore[no-any-return]


def _need_no_repetition(times_s: List[float], loop_s: float) -> None:
    """Raises ValueError if the times span more than the loop, and names a loop that fits."""
    span_s = max(times_s) - min(times_s)
    if span_s <= loop_s:
        return
    fits_s = math.ceil(span_s + span_s / (len(times_s) - 1))
    longer = f"loop_period_s={fits_s} is long enough, and" if fits_s <= 86400 else "no loop is longer than 86400 s;"
    raise ValueError(f"times span {number_text(span_s)} s, but the sea repeats after {number_text(loop_s)} s: {longer} repeats=True permits repetition")


def series(ocean: Ocean, points: Any, times: Any, fields: Any, tolerance_m: float, interpolation: str, repeats: bool) -> SurfaceSamples:
    tolerance, of_interpolation = _tolerance(tolerance_m), _interpolation(interpolation)
    positions = _Positions(points, None)
    moments = doubles_of(times, "times")
    if moments.ndim != 1:
        raise ValueError(invalid("times.shape", str(moments.shape), "(n,): seconds"))
    times_s: List[float] = moments.tolist()
    for time_s in times_s:
        if not math.isfinite(time_s):
            raise ValueError(invalid("times", number_text(time_s), "finite numbers of seconds"))
    ocean._need_open()
    if not repeats and times_s:
        _need_no_repetition(times_s, number_of(ocean._sea.loop_period_s, "loop_period_s"))
    names = _wanted(fields, ocean)
    results = _Results(names, (len(times_s),), positions)
    call = _call_of(names, positions, tolerance, of_interpolation, 0)
    handle = ocean._handle

    def sample(i: int) -> int:
        if i == 0:
            positions.warn_of_span(ocean._repeat_length_m())
        return results.sample(handle, call, i)

    with ocean._turn:
        _sample_frames(ocean, times_s, sample)
    _idle_calls[names].append(call)
    return results.results  # type: ignore[no-any-return]


def _sample_frames(ocean: Ocean, times_s: List[float], sample: Callable[[int], int]) -> None:
    """Calls sample(i), which returns a status, with the frame of each time, while the next frame is
    computed. The ocean's turn is held."""
    frame = c.sized(c.pelagic_frame)
    last = len(times_s) - 1
    if times_s:
        ocean._begin(times_s[0])
    for i in range(len(times_s)):
        ocean._end(frame)
        if i != last:
            ocean._begin(times_s[i + 1])
        try:
            status = sample(i)
            if status:
                raise error_of(status)
        except BaseException:
            if i != last:
                ocean._end(frame)
            raise


_RAY = np.dtype({"names": ["origin", "direction", "reach"], "formats": ["(3,)f8", "(3,)f8", "f8"],
                 "offsets": [c.pelagic_ray.origin_m.offset, c.pelagic_ray.direction.offset, c.pelagic_ray.reach_m.offset],
                 "itemsize": ctypes.sizeof(c.pelagic_ray)})
_HIT = np.dtype({"names": ["hit", "from_below", "normal", "distance", "position"], "formats": ["i4", "i4", "(3,)f4", "f8", "(3,)f8"],
                 "offsets": [getattr(c.pelagic_hit, name).offset for name in ("is_hit", "from_below", "normal", "distance_m", "position_m")],
                 "itemsize": ctypes.sizeof(c.pelagic_hit)})


def rays(frame: Frame, origins: Any, directions: Any, reach: Any, tolerance_m: float) -> Hits:
    ocean, number = frame._ocean, frame._number
    ocean._enter(number)
    try:
        tolerance = _tolerance(tolerance_m)
        meaning = "x, y and z of each ray"
        from_, towards, far = np.broadcast_arrays(rows_of(origins, "origins", 3, meaning), rows_of(directions, "directions", 3, meaning),
                                                  doubles_of(reach, "reach")[..., None])
        shape, count = from_.shape[:-1], from_.size // 3
        ask, found = c.sized(c.pelagic_ray, frame=number, tolerance_m=tolerance), c.sized(c.pelagic_hit)
        of_c, hits_of_c = ((type(one) * count).from_buffer_copy(bytes(one) * count) for one in (ask, found))
        asked: Any = np.frombuffer(of_c, _RAY) if count else np.empty(0, _RAY)
        hits: Any = np.frombuffer(hits_of_c, _HIT) if count else np.empty(0, _HIT)
        asked["origin"], asked["direction"], asked["reach"] = from_.reshape(-1, 3), towards.reshape(-1, 3), far[..., 0].ravel()
        first_hit, handle = library.pelagic_ocean_first_hit, ocean._handle
        for i in range(count):
            status = first_hit(handle, of_c[i], hits_of_c[i])
            if status == c.PELAGIC_INVALID_ARGUMENT and last_message().startswith("ray."):
                raise ValueError(f"ray {i}: " + last_message().removeprefix("ray."))
            if status:
                raise error_of(status)
    finally:
        ocean._leave(frame._number)
    is_hit = hits["hit"].astype(np.bool_)
    return {"hit": is_hit.reshape(shape), "distance": np.where(is_hit, hits["distance"], np.inf).reshape(shape),
            "position": np.where(is_hit[:, None], hits["position"], np.nan).reshape(*shape, 3),
            "normal": np.where(is_hit[:, None], hits["normal"], np.float32(np.nan)).reshape(*shape, 3),
            "from_below": hits["from_below"].astype(np.bool_).reshape(shape)}


_AT_ONCE = 4096  # displacements as doubles, which stay in a processor's cache


def _undisplaced(frame: Frame, positions: _Positions, displacement: Any, velocity: Any, foam: Any, is_position: bool = False) -> None:
    """Writes to arrays, (n, 3), (n, 3) and (n,); None leaves one out. The frame is entered.

    is_position  add the reference positions to the displacement
    """
    doubles = np.empty((min(positions.count, _AT_ONCE), 3))
    points = c.sized(c.pelagic_points, frame=frame._number)
    pointers = [None if array is None else address_of(array) for array in (doubles if displacement is not None else None, velocity, foam)]
    for begin in range(0, positions.count, _AT_ONCE):
        end = min(begin + _AT_ONCE, positions.count)
        points.count, points.x, points.z = end - begin, (positions.x or 0) + 8 * begin, (positions.z or 0) + 8 * begin
        at = pointers[0], *(pointer and pointer + 4 * begin * width for pointer, width in ((pointers[1], 3), (pointers[2], 1)))
        status = library.pelagic_ocean_sample_undisplaced(frame._ocean._handle, points, *at)
        if status:
            raise error_of(status)
        if displacement is not None:
            found = doubles[:end - begin]
            if is_position:
                found[:, ::2] += positions.xz[:, begin:end].T
            displacement[begin:end] = found


def displaced(frame: Frame, points: Any, z: Any) -> NDArray[np.float32]:
    ocean = frame._ocean
    ocean._enter(frame._number)
    try:
        frame._need_planes()
        positions = _Positions(points, z)
        positions.check(lambda i: f"point {i}: a coordinate")
        moved = np.empty((positions.count, 3), np.float32)
        _undisplaced(frame, positions, moved, None, None, is_position=True)
    finally:
        ocean._leave(frame._number)
    return moved.reshape(*positions.shape, 3)


def displaced_foam(frame: Frame, points: Any, z: Any) -> NDArray[np.float32]:
    ocean = frame._ocean
    ocean._enter(frame._number)
    try:
        if not ocean._has_foam:
            frame._need_foam()
        frame._need_planes()
        positions = _Positions(points, z)
        positions.check(lambda i: f"point {i}: a coordinate")
        foam = np.empty(positions.shape, np.float32)
        _undisplaced(frame, positions, None, None, foam)
    finally:
        ocean._leave(frame._number)
    return foam


def sample_undisplaced(frame: Frame, points: Any) -> UndisplacedSamples:
    ocean = frame._ocean
    ocean._enter(frame._number)
    try:
        frame._need_planes()
        array = doubles_of(points, "points")
        if array.ndim != 2 or array.shape[1] != 2:
            raise ValueError("points has another shape, expected (n, 2): x and z of each point")
        positions = _Positions(array, None)
        positions.check(lambda i: f"points[{i}]: a coordinate")
        results: UndisplacedSamples = {"displacement": np.empty((positions.count, 3), np.float32)}
        if ocean._has_velocities:
            results["velocity"] = np.empty((positions.count, 3), np.float32)
        if ocean._has_foam:
            results["foam"] = np.empty(positions.count, np.float32)
        _undisplaced(frame, positions, results["displacement"], results.get("velocity"), results.get("foam"))
    finally:
        ocean._leave(frame._number)
    return results
