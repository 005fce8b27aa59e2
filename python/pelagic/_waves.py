"""Dynamic waves of an ocean, and the dynamic waves and the shore of a frame."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _native as c
from ._library import call, library, saved_by
from ._numbers import bytes_of, identifier_of, instance_of, number_of
from ._options import Disturbance, Rain
from ._structs import disturbance_struct, rain_struct
from ._views import view_of

if TYPE_CHECKING:
    from ._frame import Frame
    from ._ocean import Ocean

_A_SOURCE = "a number that add_source() returned"


class DynamicWaves:
    """The dynamic waves of an ocean. Commands take effect at the next schedule(), in the order of
    the calls. Identical times with identical commands give bit-identical waves. A time before the
    last one does not change the waves, and a jump ahead computes at most half a second."""

    def __init__(self, ocean: Ocean) -> None:
        self._ocean = ocean

    def _call(self, function: Any, *arguments: Any) -> None:
        with self._ocean._turn:
            self._ocean._need_open()
            call(function, self._ocean._waves, *arguments)

    def add_impulse(self, disturbance: Disturbance) -> None:
        """Acts once, in the next tick. At most 4096 impulses can be pending."""
        self._call(library.pelagic_dynamic_waves_add_impulse, disturbance_struct(instance_of(Disturbance, disturbance, "disturbance")))

    def add_source(self, source: Disturbance) -> int:
        """Acts in every tick, moving at its velocity, until it is removed. Returns its number. At
        most 4096 sources at once."""
        number = ctypes.c_uint32()
        self._call(library.pelagic_dynamic_waves_add_source, disturbance_struct(instance_of(Disturbance, source, "source")), ctypes.byref(number))
        return number.value

    def set_source(self, number: int, source: Disturbance) -> None:
        """Replaces a source. Does nothing if there is no source of that number."""
        number = identifier_of(number, _A_SOURCE)
        self._call(library.pelagic_dynamic_waves_set_source, number, disturbance_struct(instance_of(Disturbance, source, "source")))

    def remove_source(self, number: int) -> None:
        """Does nothing if there is no source of that number."""
        self._call(library.pelagic_dynamic_waves_remove_source, identifier_of(number, _A_SOURCE))

    def set_center(self, x_m: float, z_m: float) -> None:
        """Moves the grid's centre to within half a texel of the point. New texels
        are flat."""
        self._call(library.pelagic_dynamic_waves_set_center, number_of(x_m, "x_m"), number_of(z_m, "z_m"))

    def set_rain(self, rain: Rain) -> None:
        """Sets the rain from the next tick on; drops_per_m2_s = 0 ends it."""
        self._call(library.pelagic_dynamic_waves_set_rain, rain_struct(instance_of(Rain, rain, "rain")))

    def save_state(self) -> bytes:
        """Returns everything that later ticks depend on, except commands since the last schedule().
        No frame may be in flight."""
        with self._ocean._turn:
            self._ocean._need_no_frame_in_flight()
            return saved_by(library.pelagic_dynamic_waves_save_state, self._ocean._waves)

    def restore_state(self, saved: bytes) -> None:
        """Continues from a saved state of waves with equal options, and drops commands since the
        last schedule(). No frame may be in flight."""
        saved = bytes_of(saved, "save_state")
        with self._ocean._turn:
            self._ocean._need_no_frame_in_flight()
            call(library.pelagic_dynamic_waves_restore_state, self._ocean._waves, saved, len(saved))


class DynamicWavesView:
    """The dynamic waves of a frame, whose height adds to that of the cascades at the displaced
    position.

    Texel (i, j) of the world is at x = i texel_m, z = j texel_m and is element [j mod N, i mod N].
    The grid has first_x <= i < first_x + N, and j likewise. np.roll(array, (-first_z, -first_x),
    (0, 1)) begins with the lowest texel. Arrays are views; the other values stay valid when the
    frame is over.
    """

    def __init__(self, frame: Frame, struct: Any) -> None:
        self._frame, self._struct = frame, struct

    def _array(self, address: int, type_: str) -> NDArray[Any]:
        return view_of(self._frame, address, type_, (self._struct.resolution, self._struct.resolution))

    @property
    def height_m(self) -> NDArray[np.float32]:
        """(N, N), a view."""
        return self._array(self._struct.height_m, "<f4")

    @property
    def vertical_velocity_mps(self) -> NDArray[np.float32]:
        """(N, N), a view."""
        return self._array(self._struct.vertical_velocity_mps, "<f4")

    @property
    def foam(self) -> NDArray[np.uint8]:
        """(N, N), a view: 0 (no foam) to 255 (covered)."""
        return self._array(self._struct.foam, "|u1")

    @property
    def resolution(self) -> int:
        """N, texels along a side."""
        return int(self._struct.resolution)

    @property
    def texel_m(self) -> float:
        """Side of a texel."""
        return float(self._struct.texel_m)

    @property
    def first_x(self) -> int:
        """The lowest texel along x."""
        return int(self._struct.first_x)

    @property
    def first_z(self) -> int:
        """The lowest texel along z."""
        return int(self._struct.first_z)

    @property
    def height_min_m(self) -> float:
        """Lower bound of the heights."""
        return float(self._struct.height_min_m)

    @property
    def height_max_m(self) -> float:
        """Upper bound of the heights."""
        return float(self._struct.height_max_m)

    @property
    def hash(self) -> int:
        """XXH3 of the position and the arrays: dynamic_waves_hash in sea.json."""
        return self._frame._hash(c.PELAGIC_HASH_DYNAMIC_WAVES)


class ShoreSurface:
    """The shore of a frame: a rectangle with a sea floor, where cascades are attenuated and waves
    over the floor are added.

    Element [j, i] is at x = x_m + i texel_m, z = z_m + j texel_m. Arrays are views; the other
    values stay valid when the frame is over.
    """

    def __init__(self, frame: Frame, struct: Any) -> None:
        self._frame, self._struct = frame, struct

    def _array(self, address: int, type_: str, *last: int) -> NDArray[Any]:
        return view_of(self._frame, address, type_, (self._struct.rows, self._struct.columns, *last))

    @property
    def columns(self) -> int:
        """Texels along x."""
        return int(self._struct.columns)

    @property
    def rows(self) -> int:
        """Texels along z."""
        return int(self._struct.rows)

    @property
    def texel_m(self) -> float:
        """Side of a texel."""
        return float(self._struct.texel_m)

    @property
    def x_m(self) -> float:
        """Position of element [0, 0]."""
        return float(self._struct.x_m)

    @property
    def z_m(self) -> float:
        """Position of element [0, 0]."""
        return float(self._struct.z_m)

    @property
    def depth_m(self) -> NDArray[np.float32]:
        """(rows, columns), a view: depth of still water, negative on land."""
        return self._array(self._struct.depth_m, "<f4")

    @property
    def weights_rgba8(self) -> NDArray[np.uint8]:
        """(rows, columns, 4), a view: weight of cascade t in [..., t], 255 for 1."""
        return self._array(self._struct.weights_rgba8, "|u1", 4)

    @property
    def height_m(self) -> NDArray[np.float32]:
        """(rows, columns), a view: height that adds to the cascades."""
        return self._array(self._struct.height_m, "<f4")

    @property
    def vertical_velocity_mps(self) -> NDArray[np.float32]:
        """(rows, columns), a view."""
        return self._array(self._struct.vertical_velocity_mps, "<f4")

    @property
    def potential_m2ps(self) -> NDArray[np.float32]:
        """(rows, columns), a view: velocity potential of these waves at the surface."""
        return self._array(self._struct.potential_m2ps, "<f4")

    @property
    def reach_m(self) -> NDArray[np.float32]:
        """(rows, columns), a view: envelope of the crests. Sand below it is wet."""
        return self._array(self._struct.reach_m, "<f4")

    @property
    def foam(self) -> NDArray[np.uint8]:
        """(rows, columns), a view: foam of breaking waves, 0 (no foam) to 255 (covered)."""
        return self._array(self._struct.foam, "|u1")

    @property
    def height_min_m(self) -> float:
        """Lower bound of the heights."""
        return float(self._struct.height_min_m)

    @property
    def height_max_m(self) -> float:
        """Upper bound of the heights."""
        return float(self._struct.height_max_m)

    @property
    def weights_change_per_m(self) -> float:
        """Upper bound of the change of a weight over a metre."""
        return float(self._struct.weights_change_per_m)

    @property
    def hash(self) -> int:
        """XXH3 of the arrays."""
        return self._frame._hash(c.PELAGIC_HASH_SHORE)
