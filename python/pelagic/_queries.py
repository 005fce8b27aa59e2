"""Queries of frames at points and along rays. Points have shape (..., 2), results (...) or (..., 3)."""

from __future__ import annotations

import ctypes
import math
import time
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
_empty, _FLOAT, _BOOL = np.empty, np.dtype(np.float32), np.dtype(np.bool_)  # type: Any, Any, Any
_addressof, _from_buffer = ctypes.addressof, ctypes.c_char.from_buffer  # type: Any, Any
_maximum, _minimum = np.maximum.reduce, np.minimum.reduce
_ocean_query = library.pelagic_ocean_query
_IN_ONE_JOB = 512  # points that one thread queries
# Limits of a piece of a series: points at all times, and the time that it takes.
_IN_A_PIECE, _PIECE_S = 65536, 0.1


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
            self.xz = (array if array.ndim == 2 else array.reshape(-1, 2)).T.copy()
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
        all_ = self.xz.reshape(-1)  # x and z together, and argmax, are quicker
        if all_.item(all_.argmax()) - all_.item(all_.argmin()) <= repeat_m:
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


def tolerance_of(tolerance_m: float) -> float:
    number = tolerance_m if type(tolerance_m) is float else number_of(tolerance_m, "tolerance_m")
    if not 1e-6 <= number <= 1000:
        raise ValueError(invalid("tolerance_m", number_text(number), "[1e-6, 1000]"))
    return number


def interpolation_of(name: str) -> int:
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


def _empty_results(names: Tuple[str, ...], times: Tuple[int, ...], positions: _Positions) -> Any:
    """Returns arrays for the results of one time or of several, one after another."""
    shape = times + positions.shape
    return {name: _empty((*shape, 3) if name in _VECTORS else shape, _BOOL if name == "converged" else _FLOAT) for name in names}


def _write(results: Any, points: int, first: int, times: int, samples: Any, query: Any, *arguments: Any) -> Any:
    """Calls query(*arguments), which writes the results of some times where `samples` points. Returns
    its result.

    points  their number
    first   index of the first time
    """
    count, scattered = times * points, []
    for name, array in results.items() if count else ():
        address = _addressof(_from_buffer(array))
        if name in _ARRAYS:
            setattr(samples, _ARRAYS[name], address + first * points * array.itemsize)
            continue
        if count == 1:
            address += 12 * first
        else:  # the library writes x, y and z apart
            rows = _empty((3, count), _FLOAT)
            address = _addressof(_from_buffer(rows))
            scattered.append((array, rows))
        x, y, z = _VECTORS[name]
        setattr(samples, x, address)
        setattr(samples, y, address + 4 * count)
        setattr(samples, z, address + 8 * count)
    result = query(*arguments)
    for array, rows in scattered:
        out = array.reshape(-1, 3)[first * points:first * points + count].T
        if count < 256:
            out[...] = rows
        else:  # quicker by axis
            out[0], out[1], out[2] = rows
    return result


def footprint_of(footprint_m: float, ocean: Ocean) -> float:
    number = number_of(footprint_m, "footprint_m")
    if not 0 <= number < math.inf:
        raise ValueError(invalid("footprint_m", number_text(number), "0 or more"))
    if number > 0 and not ocean._has_depth:
        raise ValueError("footprint_m needs water below the surface: create the ocean with depth=True")
    return number


def _call_of(names: Tuple[str, ...], positions: _Positions, tolerance_m: float, interpolation: int, footprint_m: float, frame: int) -> _Call:
    idle = _idle_calls[names]
    try:
        call = idle.pop()
    except IndexError:
        call = _Call()
    points = call.points
    points.count = count = positions.count
    points.x, points.z, points.frame = positions.x, positions.z, frame
    points.interpolation, points.tolerance_m, points.parallel = interpolation, tolerance_m, count > _IN_ONE_JOB
    points.footprint_m = footprint_m
    return call


def query(frame: Frame, points: Any, z: Any, fields: Any, tolerance_m: float, interpolation: str, footprint_m: float) -> SurfaceSamples:
    ocean, number = frame._ocean, frame._number
    ocean._enter_library(number)
    try:
        tolerance, of_interpolation = tolerance_of(tolerance_m), interpolation_of(interpolation)
        footprint = footprint_of(footprint_m, ocean) if footprint_m != 0 else 0.0
        positions = _Positions(points, z)
        if positions.count > 1:
            positions.warn_of_span(frame._cascades[0].side_m)
        names = _wanted(fields, ocean)
        results = _empty_results(names, (), positions)
        call = _call_of(names, positions, tolerance, of_interpolation, footprint, number)
        status = _write(results, positions.count, 0, 1, call.samples, _ocean_query, ocean._handle, *call.pointers)
        _idle_calls[names].append(call)
    finally:
        ocean._leave(math.inf)
    if status:
        raise ocean._error_of(status, number)
    return results  # type: ignore[no-any-return]


def _need_no_repetition(times: NDArray[np.float64], loop_s: float) -> None:
    """Raises ValueError if the times span more than the loop, and names a loop that fits."""
    span_s = float(times.max() - times.min())
    if span_s <= loop_s:
        return
    fits_s = math.ceil(span_s + span_s / (times.size - 1))
    longer = f"loop_period_s={fits_s} is long enough, and" if fits_s <= 86400 else "no loop is longer than 86400 s;"
    raise ValueError(f"times span {number_text(span_s)} s, but the sea repeats after {number_text(loop_s)} s: {longer} repeats=True permits repetition")


def series(
    ocean: Ocean, points: Any, times: Any, fields: Any, tolerance_m: float, interpolation: str, footprint_m: float, repeats: bool
) -> SurfaceSamples:
    tolerance, of_interpolation, footprint = tolerance_of(tolerance_m), interpolation_of(interpolation), footprint_of(footprint_m, ocean)
    positions = _Positions(points, None)
    moments = doubles_of(times, "times").copy()
    if moments.ndim != 1:
        raise ValueError(invalid("times.shape", str(moments.shape), "(n,): seconds"))
    finite = np.isfinite(moments)
    if not finite.all():
        raise ValueError(invalid("times", number_text(float(moments[np.argmin(finite)])), "finite numbers of seconds"))
    ocean._need_open()
    if not repeats and moments.size:
        _need_no_repetition(moments, number_of(ocean._sea.loop_period_s, "loop_period_s"))
    names = _wanted(fields, ocean)
    results = _empty_results(names, moments.shape, positions)
    call = _call_of(names, positions, tolerance, of_interpolation, footprint, 0)
    with ocean._turn:
        _sample_frames(ocean, moments, positions, results, call)
    _idle_calls[names].append(call)
    return results  # type: ignore[no-any-return]


def _sample_frames(ocean: Ocean, times: NDArray[np.float64], positions: _Positions, results: Any, call: _Call) -> None:
    """Writes the results of all times, in pieces between which Python handles signals. The ocean's
    turn is held."""
    count, done, piece = times.size, 0, 1
    if count == 0:
        return
    times_s, frame = address_of(times) or 0, c.sized(c.pelagic_frame)
    ocean._begin(float(times[0]), count)
    try:
        while done < count:
            piece = min(piece, max(1, _IN_A_PIECE // max(1, positions.count)), count - done)
            begun_s, end = time.perf_counter(), done + piece
            _write(results, positions.count, done, piece, call.samples, ocean._continue_series, times_s + 8 * done, piece,
                   times_s + 8 * end if end < count else None, call, frame)
            if done == 0:
                positions.warn_of_span(frame.patch_size_m)
            done, took_s = end, time.perf_counter() - begun_s
            piece = 2 * piece if took_s < _PIECE_S / 2 else piece if took_s < _PIECE_S else max(1, piece // 2)
    except BaseException:
        if ocean._in_flight:
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
        tolerance = tolerance_of(tolerance_m)
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
        if ocean._has_drawn_velocities:
            results["velocity"] = np.empty((positions.count, 3), np.float32)
        if ocean._has_foam:
            results["foam"] = np.empty(positions.count, np.float32)
        _undisplaced(frame, positions, results["displacement"], results.get("velocity"), results.get("foam"))
    finally:
        ocean._leave(frame._number)
    return results
