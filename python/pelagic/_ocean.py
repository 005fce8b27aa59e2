"""Oceans, whose objects may outlive one another: frames detect that their memory is reused, arrays
prevent it from being overwritten, and threads take turns.

An ocean has the memory of two frames: schedule() overwrites the frame before the one completed last.
It waits for readers of that frame, and raises BufferError if arrays view it. Locks are taken in the
order _turn, _state. Destructors, which may run within a locked section, take none.
"""

from __future__ import annotations

import ctypes
import math
import threading
from types import TracebackType
from typing import Any, Iterable, List, Optional, Tuple, Type, Union, get_args

from numpy.typing import ArrayLike

from . import _native as c
from . import _queries
from ._frame import Frame
from ._inputs import TakenInputs, WaveInput
from ._library import StaleFrame, call, error_of, library, quick_library, saved_by
from ._numbers import bytes_of, instance_of, invalid, iterable_of, number_of, number_text, whole_number_of, warn
from ._options import DynamicWavesOptions, ShoreOptions, SprayEmitter, SprayOptions
from ._queries import Field, Interpolation, SurfaceSamples
from ._sea import Sea, warnings_about
from ._structs import dynamic_waves_struct, sea_struct, shore_struct, spray_emitter_struct, spray_struct
from ._waves import DynamicWaves

_IN_LIBRARY = math.inf  # instead of a number: readers that the library waits for
# schedule() waits at most for readers in the library, which do not need the interpreter lock.
_schedule, _complete, _query_series = quick_library.pelagic_ocean_schedule, library.pelagic_ocean_complete, library.pelagic_ocean_query_series


def executor_of(threads: int) -> ctypes.c_void_p:
    """Returns an executor with a number of threads. The caller destroys it."""
    handle = ctypes.c_void_p()
    call(library.pelagic_executor_create, c.sized(c.pelagic_executor_options, threads=min(max(whole_number_of(threads, "threads"), -2**31), 2**31 - 1)),
         ctypes.byref(handle))
    return handle


def _textures(wanted: Optional[bool]) -> int:
    return c.PELAGIC_TEXTURES_DEFAULT if wanted is None else c.PELAGIC_TEXTURES_ON if wanted else c.PELAGIC_TEXTURES_OFF


def _velocities(wanted: Union[bool, str]) -> int:
    names = {False: c.PELAGIC_VELOCITIES_NONE, True: c.PELAGIC_VELOCITIES_DRAWN, "none": c.PELAGIC_VELOCITIES_NONE,
             "drawn": c.PELAGIC_VELOCITIES_DRAWN, "water": c.PELAGIC_VELOCITIES_WATER}
    if not isinstance(wanted, (bool, str)) or wanted not in names:
        raise ValueError(invalid("velocities", repr(wanted), "True, False, none, drawn or water"))
    return names[wanted]


def _sea_of(sea: Any, struct: Any) -> Sea:
    return sea if isinstance(sea, Sea) else Sea._of_library(struct)


class Ocean:
    """A sea that computes frames. Use it in a `with` statement, or call close().

    It has the memory of two frames. While an array views a frame, the second schedule() or
    frame_at() after that frame's raises BufferError instead of overwriting it. close(), or the last
    view after it, frees the memory.
    """

    def __init__(
        self,
        sea: Sea,
        *,
        # generated from schema/ocean.toml: python-parameters
        queries: bool = True,
        velocities: Union[bool, str] = False,
        depth: bool = False,
        gradients: Optional[bool] = None,
        slopes: Optional[bool] = None,
        foam: bool = False,
        planes: bool = True,
        threads: int = 0,
        isa: Optional[str] = None,
        largest_peak_m: float = 0.0,
        dynamic_waves: Optional[DynamicWavesOptions] = None,
        shore: Optional[ShoreOptions] = None,
        spray: Optional[SprayOptions] = None,
        inputs: Iterable[WaveInput] = (),
        # end of generated
    ) -> None:
        """Creates an ocean.

        .. generated from schema/ocean.toml: python-arguments
        queries: enables queries of points and rays. N^2 / 8 bytes for each cascade of a frame.
        velocities: velocities of frames and queries. Drawn: the derivatives of the drawn
            displacement in time, in planes of 12 N^2 bytes for each cascade of a frame, with
            about twice as many transforms. Water: the water's own at the surface by linear
            theory, for queries, with a quarter of the transforms more; waves shorter than four
            texels are left out.
        depth: adds pressure and velocity below the surface, which hulls need. 8 N^2 bytes for
            each cascade of a frame, and about a quarter of its time. Waves of a pond do not
            decrease with depth and move no water.
        gradients: gradients of each cascade: normals, Jacobian and smoothness. By default a sea
            with cascades 1 has them, and an ocean whose slopes are off. Slopes and gradients
            cannot both be off.
        slopes: slopes and moments of each cascade, which add over cascades. By default all
            oceans have them but those of a sea with cascades 1 that have gradients and no foam.
            Foam needs them.
        foam: enables foam of breaking waves, which drifts and fades over 2.8 seconds. A frame
            with a tick (five a second) takes about twice as long. A jump in time computes 16
            ticks, which take as long as ten to twenty frames. 49 N^2 bytes for each cascade.
        planes: keeps displacement as planes of floats. Without them frames have textures and
            bounds only. That moves fewer bytes and takes about 12 N^2 bytes less for each
            cascade; the textures are bit-identical. Queries, velocities, dynamic waves, a
            shore, spray and wave inputs need planes.
        threads: maximum threads of a frame, including the calling thread. 0: one per core.
        isa: instruction set: sse4.2, avx2, avx512 or neon. By default that of the environment
            variable PELAGIC_ISA, else the widest of the CPU. Results are bit-identical.
        largest_peak_m: longest peak wavelength that the cascades support, for a sea of a later
            transition: its report().peak_wavelength_m. 0: that of the first sea. A warning
            names the shortest wave that is left if it is twice as long as without.
        dynamic_waves: the grid of dynamic waves, which are added to the cascades and queries.
            With 256 texels a tick, of 60 a second, takes about three quarters of a frame of one
            cascade of 256. By default none.
        shore: a sea floor that refracts waves. The sea needs 2 to 4 cascades and cannot change.
            Construction takes about a second of one core longer, and 290 bytes for each of the
            shore's texels. By default none.
        spray: droplets of breaking crests and emitters. A frame with a tick (eleven a second,
            of which every second is a tick of foam too) computes the displacement once more. A
            jump in time computes 19 ticks, which take as long as ten to twenty frames. 3.8 MB.
            By default none.
        inputs: wave inputs, which are added to the waves of the wind in this order. They change
            the hash. None may belong to another ocean. By default none.
        .. end of generated
        """
        self._turn = threading.Lock()  # held while the ocean works
        self._state = threading.Lock()  # of all members below but _views and _left
        self._readers_left = threading.Condition(self._state)
        self._handles: List[int] = []  # the handle, until it is destroyed
        self._readers: "dict[float, int]" = {}  # readers of each frame, by its number
        self._views: "dict[int, Tuple[int, float]]" = {}  # number and time of the frame of each view
        self._left: List[Any] = []  # handles of bodies, which the next call destroys
        self._is_closed = self._in_flight = False
        self._is_over = False  # closed, and without readers
        self._newest = self._oldest = 0  # numbers of the frame completed last, and of the oldest in memory
        self._has_changes = False
        first = sea_struct(sea)
        self._sea = _sea_of(sea, first)
        kind_of_velocities = _velocities(velocities)
        self._has_velocities, self._has_depth = kind_of_velocities != c.PELAGIC_VELOCITIES_NONE, bool(depth)
        self._has_drawn_velocities, self._has_whitecaps = kind_of_velocities == c.PELAGIC_VELOCITIES_DRAWN, bool(foam)
        known: List[Tuple[str, Any, type, Any]] = [
            ("dynamic_waves", dynamic_waves, DynamicWavesOptions, dynamic_waves_struct), ("shore", shore, ShoreOptions, shore_struct),
            ("spray", spray, SprayOptions, spray_struct)]
        parts = {name: struct_of(instance_of(cls, given, name)) for name, given, cls, struct_of in known if given is not None}
        self._has_dynamic_waves, self._has_shore, self._has_spray = (name in parts for name in ("dynamic_waves", "shore", "spray"))
        if isa is not None and not isinstance(isa, str):
            raise TypeError(invalid("isa", repr(isa), "sse4.2, avx2, avx512 or neon"))
        options = c.sized(c.pelagic_ocean_options, queries=bool(queries), velocities=kind_of_velocities, depth=bool(depth), foam=bool(foam), gradients=_textures(gradients),
                          slopes=_textures(slopes), textures_only=not planes, isa=isa.encode() if isa is not None else None,
                          **{name: ctypes.addressof(struct) for name, struct in parts.items()})
        largest_peak_m = number_of(largest_peak_m, "largest_peak_m")
        forecast = c.sized(c.pelagic_forecast, first=ctypes.pointer(first), largest_peak_m=largest_peak_m)
        with TakenInputs(inputs, self) as handles:
            options.input_count, options.inputs = len(handles), ctypes.addressof(handles)
            executor = executor_of(threads)
            options.executor = executor
            try:
                if largest_peak_m > 0:
                    self._warn_of_cascades(first, largest_peak_m)
                handle = ctypes.c_void_p()
                call(library.pelagic_ocean_create_forecast, forecast, options, ctypes.byref(handle))
            finally:
                library.pelagic_executor_destroy(executor)
            self._handle: int = handle.value or 0
            self._handles.append(self._handle)
        self._info = c.sized(c.pelagic_ocean_info)
        call(library.pelagic_ocean_describe, self._handle, self._info)
        self._has_foam = self._has_whitecaps or self._has_dynamic_waves or self._has_shore
        self._default_fields = tuple(name for name in get_args(Field)
                                     if (name != "velocity" or self._has_velocities) and (name != "foam" or self._has_foam))
        self._waves = ctypes.c_void_p()
        if self._has_dynamic_waves:
            call(library.pelagic_ocean_dynamic_waves, self._handle, ctypes.byref(self._waves))

    @staticmethod
    def _warn_of_cascades(first: Any, largest_peak_m: float) -> None:
        alone = warnings_about(first)
        for text in warnings_about(first, largest_peak_m):
            if text not in alone:
                warn(text)

    # ---- turns, readers and views ----

    def _need_open(self) -> None:
        if self._is_closed:
            raise ValueError("the ocean is closed")

    def _need_no_frame_in_flight(self) -> None:
        if self._is_closed:
            self._need_open()
        if self._in_flight:
            raise RuntimeError("a frame is in flight; call complete() first")

    def _need_alive(self, number: int) -> None:
        self._need_open()
        if number < self._oldest:
            raise StaleFrame("the frame's memory holds a later one: a frame lasts until the second schedule() or frame_at() after its own")

    def _enter(self, number: int) -> None:
        """Begins to read a frame, for which schedule() and close() wait. _leave() must follow."""
        with self._state:
            if self._is_closed or number < self._oldest:
                self._need_alive(number)
            self._readers[number] = self._readers.get(number, 0) + 1

    def _enter_library(self, number: int) -> None:
        """As _enter(), for a single call of the library, which waits for it without the interpreter
        lock. _leave(_IN_LIBRARY) must follow."""
        with self._state:
            if self._is_closed or number < self._oldest:
                self._need_alive(number)
            self._readers[_IN_LIBRARY] = self._readers.get(_IN_LIBRARY, 0) + 1

    def _error_of(self, status: int, number: int) -> Exception:
        """Returns the error of a call after _enter_library()."""
        if status == c.PELAGIC_WRONG_ORDER:
            self._need_alive(number)
        return error_of(status)

    def _leave(self, number: float) -> None:
        with self._state:
            self._readers[number] -= 1
            if self._readers[number] == 0:
                del self._readers[number]
                if number < self._oldest or self._is_closed:
                    self._readers_left.notify_all()

    def _call_of_frame(self, number: int, function: Any, *arguments: Any) -> None:
        """Calls a function of the library that reads a frame, with the ocean as its first argument."""
        self._enter_library(number)
        try:
            status = function(self._handle, *arguments)
        finally:
            self._leave(_IN_LIBRARY)
        if status:
            raise self._error_of(status, number)

    def _hash(self, number: int, kind: int) -> int:
        hash_ = ctypes.c_uint64()
        self._call_of_frame(number, library.pelagic_ocean_frame_hash, number, kind, ctypes.byref(hash_))
        return hash_.value

    def _destroy(self, destroy: Any = library.pelagic_ocean_destroy) -> None:
        try:
            handle = self._handles.pop()
        except IndexError:
            return
        destroy(handle)

    def _destroy_if_unused(self) -> None:
        if self._is_over and not self._views:
            self._destroy()

    def _destroy_left(self, destroy: Any = library.pelagic_bodies_destroy) -> None:
        """Destroys sets of bodies that are no longer referenced, and removes their pressures."""
        while self._left:
            destroy(self._left.pop())

    def __del__(self) -> None:
        if "_handles" in vars(self):
            self._destroy_left()
            self._destroy()

    def _begin(self, time_s: float, frames: int = 1) -> None:
        """Schedules the first of a number of frames, which follow it. The turn is held."""
        if self._left:
            self._destroy_left()
        with self._state:
            self._need_no_frame_in_flight()
            if not math.isfinite(time_s):
                raise ValueError(invalid("time_s", number_text(time_s), "a finite number"))
            self._end_before(self._newest + (frames > 1))
        status = _schedule(self._handle, time_s)
        if status:
            raise error_of(status)
        self._in_flight = True

    def _end_before(self, oldest: int) -> None:
        """Ends the frames before one and waits for their readers. The state is held."""
        for number, time_of_view_s in list(self._views.values()):
            if number < oldest:
                raise BufferError(f"an array of the frame of {number_text(time_of_view_s)} s is still in use, and the next frame needs its memory: "
                                  "drop the array, or keep a copy() of it")
        self._oldest = max(oldest, self._oldest)  # a series that failed has ended the newest frame, too
        if self._readers:
            self._readers_left.wait_for(lambda: all(number >= self._oldest for number in self._readers))

    def _continue_series(self, times_s: int, count: int, next_s: Optional[int], call: Any, frame: Any) -> None:
        """Samples frames of a series, the first of which is in flight. The turn is held.

        times_s, next_s  addresses; None: no frame follows
        """
        self._in_flight = next_s is not None
        status = _query_series(self._handle, times_s, count, next_s, *call.pointers, frame)
        if status:
            self._in_flight = False
            raise error_of(status)
        self._newest = frame.number

    def _end(self, frame: Any) -> None:
        """Completes a frame and writes its struct. The turn is held."""
        if self._is_closed:
            self._need_open()
        if not self._in_flight:
            raise RuntimeError("no frame is in flight; call schedule() first")
        self._in_flight = False
        status = _complete(self._handle, frame)
        if status:
            raise error_of(status)
        self._newest = frame.number

    def _completed(self) -> Frame:
        struct = c.sized(c.pelagic_frame)
        self._end(struct)
        return Frame(self, struct)

    # ---- the interface ----

    def __enter__(self) -> Ocean:
        self._need_open()
        return self

    def __exit__(self, kind: Optional[Type[BaseException]], error: Optional[BaseException], trace: Optional[TracebackType]) -> None:
        self.close()

    def close(self) -> None:
        """Waits for readers of frames and frees the memory. Afterwards frames raise ValueError;
        arrays stay valid."""
        with self._turn:
            with self._state:
                self._is_closed = True
                self._readers_left.wait_for(lambda: not self._readers)
            self._is_over = True
            self._destroy_left()
            self._destroy_if_unused()

    @property
    def is_closed(self) -> bool:
        """True after close(), or after the end of a with statement."""
        return self._is_closed

    def schedule(self, time_s: float) -> None:
        """Starts the frame of a time and returns at once."""
        time_s = number_of(time_s, "time_s")
        with self._turn:
            self._begin(time_s)

    def is_ready(self) -> bool:
        """True if complete() would not wait for other threads."""
        ready = ctypes.c_int32()
        with self._turn:
            self._need_open()
            call(library.pelagic_ocean_poll, self._handle, ctypes.byref(ready))
        return bool(ready.value)

    def complete(self) -> Frame:
        """Waits for the scheduled frame, and helps to compute it."""
        with self._turn:
            return self._completed()

    def frame_at(self, time_s: float) -> Frame:
        """Calls schedule() and complete()."""
        time_s = number_of(time_s, "time_s")
        with self._turn:
            self._begin(time_s)
            return self._completed()

    def series(
        self,
        points: ArrayLike,
        times: ArrayLike,
        *,
        fields: Optional[Iterable[Field]] = None,
        tolerance_m: float = 0.001,
        interpolation: Interpolation = "cubic",
        footprint_m: float = 0.0,
        repeats: bool = False,
    ) -> SurfaceSamples:
        """Returns the results of frame_at(time).query(points) for each of n times, while other
        threads run: arrays of shape (n, ...), vectors of shape (n, ..., 3), for points of shape
        (..., 2). Earlier frames become stale.

        Raises ValueError if the times span more than the sea's loop, unless repeats is True. Warns
        like query().
        """
        return _queries.series(self, points, times, fields, tolerance_m, interpolation, footprint_m, repeats)

    def schedule_sea(self, sea: Sea, from_s: float, over_s: float, swell_from_m: float = 0.0) -> None:
        """Schedules a transition to another sea, from a time on and over a number of seconds.
        Cascades, depth, loop and seed must be the same. A transition from before the frame computed
        last starts at that frame's time. If swell_from_m, the distance of the swell's origin in
        metres, is not 0, long waves arrive first."""
        struct = sea_struct(sea)
        change = c.sized(c.pelagic_change, sea=ctypes.pointer(struct), from_s=number_of(from_s, "from_s"), over_s=number_of(over_s, "over_s"),
                         swell_from_m=number_of(swell_from_m, "swell_from_m"))
        with self._turn:
            self._need_open()
            call(library.pelagic_ocean_schedule_change, self._handle, change)
            self._has_changes = True
            self._sea = _sea_of(sea, struct)

    def set_water_frame(self, sea_level_m: float = 0.0, current_mps: Tuple[float, float] = (0.0, 0.0)) -> None:
        """Sets the sea level, [-1000, 1000], and the velocity of a uniform current along x and z,
        each [-10, 10], for frames that are scheduled from now on. Queries and dynamic waves then
        use positions in the world, and the current carries the water; the other data of frames do
        not change. Raises ValueError with a shore."""
        x_mps, z_mps = current_mps
        water = c.sized(c.pelagic_water_frame, sea_level_m=number_of(sea_level_m, "sea_level_m"), current_x_mps=number_of(x_mps, "current_mps"),
                        current_z_mps=number_of(z_mps, "current_mps"))
        with self._turn:
            self._need_open()
            call(library.pelagic_ocean_set_water_frame, self._handle, water)

    def set_origin(self, x_m: float, z_m: float) -> None:
        """Shifts the world's origin to a position of the world as it was before any shift, each
        [-1e8, 1e8]. It counts for frames that are scheduled from now on, for commands of dynamic waves
        and for spray. A position in the old coordinates plus the old origin minus the new one is that
        in the new ones: Bodies.shift() moves bodies."""
        x_m, z_m = number_of(x_m, "x_m"), number_of(z_m, "z_m")
        with self._turn:
            self._need_open()
            call(library.pelagic_ocean_set_origin, self._handle, x_m, z_m)

    def _need_spray(self, of: str = "ocean") -> None:
        if not self._has_spray:
            raise ValueError(f"the {of} has no spray: create the ocean with spray=pelagic.SprayOptions()")

    def set_spray_center(self, x_m: float, z_m: float) -> None:
        """Sets the centre of the spray of crests, usually the camera. It takes effect at the next
        schedule(), for the ticks computed from then on. Requires Ocean(spray=...)."""
        self._need_spray()
        x_m, z_m = number_of(x_m, "x_m"), number_of(z_m, "z_m")
        with self._turn:
            self._need_open()
            call(library.pelagic_ocean_set_spray_center, self._handle, x_m, z_m)

    def emit(self, emitters: Iterable[SprayEmitter]) -> None:
        """Adds droplets of emitters to frames that are scheduled from now on, at most 8192 in a call.
        Requires Ocean(spray=...)."""
        self._need_spray()
        all_ = [spray_emitter_struct(instance_of(SprayEmitter, each, f"emitters[{i}]"))
                for i, each in enumerate(iterable_of(emitters, "emitters", "a list of pelagic.SprayEmitter"))]
        array = (c.pelagic_spray_emitter * len(all_))(*all_)
        with self._turn:
            self._need_open()
            call(library.pelagic_ocean_emit, self._handle, array, len(all_))

    def save_spray(self) -> bytes:
        """Returns the droplets of emitters. No frame may be in flight."""
        self._need_spray()
        with self._turn:
            self._need_no_frame_in_flight()
            return saved_by(library.pelagic_ocean_save_spray, self._handle)

    def restore_spray(self, saved: bytes) -> None:
        """Replaces the droplets of emitters. No frame may be in flight."""
        self._need_spray()
        saved = bytes_of(saved, "save_spray")
        with self._turn:
            self._need_no_frame_in_flight()
            call(library.pelagic_ocean_restore_spray, self._handle, saved, len(saved))

    @property
    def dynamic_waves(self) -> DynamicWaves:
        """The dynamic waves. Requires Ocean(dynamic_waves=...)."""
        self._need_open()
        if not self._has_dynamic_waves:
            raise ValueError("the ocean has no dynamic waves: create the ocean with dynamic_waves=pelagic.DynamicWavesOptions()")
        return DynamicWaves(self)

    def _fact(self, name: str) -> Any:
        self._need_open()
        return getattr(self._info, name)

    @property
    def sea(self) -> Sea:
        """The sea after the last transition."""
        self._need_open()
        return self._sea

    @property
    def resolution(self) -> int:
        """Texels along a side of each cascade."""
        return int(self._fact("resolution"))

    @property
    def cascade_count(self) -> int:
        """Number of cascades of every frame."""
        return int(self._fact("cascade_count"))

    @property
    def threads(self) -> int:
        """Maximum threads of a frame, including the calling thread."""
        return int(self._fact("threads"))

    @property
    def memory_bytes(self) -> int:
        """Bytes that the ocean allocated."""
        info = c.sized(c.pelagic_ocean_info)
        with self._turn:
            self._need_open()
            call(library.pelagic_ocean_describe, self._handle, info)
        return int(info.memory_bytes)

    @property
    def isa(self) -> str:
        """The instruction set in use."""
        return str(self._fact("isa").decode())
