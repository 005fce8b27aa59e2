"""Frames and their cascades."""

from __future__ import annotations

import ctypes
from typing import Any, Iterable, List, Optional, Tuple, TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native as c
from . import _queries, _water
from ._library import call, quick_library
from ._numbers import invalid, whole_number_of
from ._queries import Field, Hits, Interpolation, SurfaceSamples, UndisplacedSamples
from ._sea import Sea
from ._views import view_of
from ._water import WaterSamples
from ._waves import DynamicWavesView, ShoreSurface

if TYPE_CHECKING:
    from ._ocean import Ocean

_DROPLET = [("position", "<f8", (3,)), ("velocity", "<f4", (3,)), ("radius", "<f4"), ("opacity", "<f4"), ("age", "<f4")]


class Bounds:
    """Extremes of displacements, in metres."""

    __slots__ = ("_bounds",)

    def __init__(self, bounds: Any) -> None:
        self._bounds = bounds

    @property
    def height_min_m(self) -> float:
        """The lowest trough."""
        return float(self._bounds.height_min_m)

    @property
    def height_max_m(self) -> float:
        """The highest crest."""
        return float(self._bounds.height_max_m)

    @property
    def horizontal_x_max_m(self) -> float:
        """The largest |Dx|."""
        return float(self._bounds.horizontal_x_max_m)

    @property
    def horizontal_z_max_m(self) -> float:
        """The largest |Dz|."""
        return float(self._bounds.horizontal_z_max_m)

    def __repr__(self) -> str:
        names = ("height_min_m", "height_max_m", "horizontal_x_max_m", "horizontal_z_max_m")
        return f"Bounds({', '.join(f'{name}={np.float32(getattr(self, name))!s}' for name in names)})"


class Cascade:
    """A cascade of a frame: a band of waves on a square that repeats over the whole sea. The
    displacements of a frame's cascades add. With cascades=1 a frame has `gradient` and `foam`, and
    its foam is that; otherwise it has `slopes` and `compression`, whose sums have the waves' foam.

    Element [j, i] has the reference position x = (c i - s j) L/N, z = (s i + c j) L/N, where c and
    s are `rotation`, L is `patch_size_m` and N is `resolution`. A view is read-only memory of the
    ocean; a copy belongs to the caller and is writable.
    """

    __slots__ = ("_frame", "_struct")
    _frame: Frame

    def __init__(self, frame: Frame, struct: Any) -> None:
        self._frame, self._struct = frame, struct

    def _alive(self) -> Any:
        self._frame._need_alive()
        return self._struct

    def _plane(self, name: str, option: str) -> NDArray[np.float32]:
        """Returns the blocks of a plane as an array."""
        frame, plane = self._frame, getattr(self._struct, name)
        frame._ocean._enter(frame._number)
        try:
            if not plane.data:
                raise ValueError(f"the frame does not have it: create the ocean with {option}")
            side, columns, block, row = plane.resolution, plane.block_columns, plane.block_stride, plane.row_stride
            blocks = side // columns
            count = (blocks - 1) * block + (side - 1) * row + columns
            memory = (ctypes.c_float * count).from_address(plane.data)
            view: NDArray[np.float32] = np.ndarray((side, blocks, columns), np.float32, memory, 0, (4 * row, 4 * block, 4))
            return view.copy("C").reshape(side, side)
        finally:
            frame._ocean._leave(frame._number)

    def _level(self, chain: str, level: int, option: str) -> NDArray[np.uint8]:
        struct = self._alive()
        address, level = getattr(struct, chain), whole_number_of(level, "level")
        if not address:
            raise ValueError(f"the frame does not have it: create the ocean with {option}")
        if not 0 <= level < struct.levels:
            raise ValueError(invalid("level", str(level), f"0 to {struct.levels - 1}"))
        side = struct.resolution >> level
        return view_of(self._frame, address + 4 * struct.level_offset[level], "|u1", (side, side, 4))

    @property
    def displacement(self) -> NDArray[np.float16]:
        """(N, N, 4), a view: Dx, height, Dz in metres, 0."""
        side = self._struct.resolution
        return view_of(self._frame, self._struct.displacement_rgba16f, "<f2", (side, side, 4))

    @property
    def height(self) -> NDArray[np.float32]:
        """(N, N), a copy, metres."""
        return self._plane("height", "planes=True")

    @property
    def dx(self) -> NDArray[np.float32]:
        """(N, N), a copy: horizontal displacement along x, metres."""
        return self._plane("dx", "planes=True")

    @property
    def dz(self) -> NDArray[np.float32]:
        """(N, N), a copy: horizontal displacement along z, metres."""
        return self._plane("dz", "planes=True")

    @property
    def velocity_x(self) -> NDArray[np.float32]:
        """(N, N), a copy: the time derivative of dx, m/s. Requires Ocean(velocities=True)."""
        return self._plane("velocity_x", "velocities=True")

    @property
    def velocity_y(self) -> NDArray[np.float32]:
        """(N, N), a copy: the time derivative of the height, m/s. Requires Ocean(velocities=True).
        """
        return self._plane("velocity_y", "velocities=True")

    @property
    def velocity_z(self) -> NDArray[np.float32]:
        """(N, N), a copy: the time derivative of dz, m/s. Requires Ocean(velocities=True)."""
        return self._plane("velocity_z", "velocities=True")

    @property
    def gradient(self) -> NDArray[np.uint8]:
        """(N, N, 4), a view: normal x, normal z, Jacobian, smoothness, of this cascade alone.
        Requires Ocean(gradients=...)."""
        return self.gradient_level(0)

    def gradient_level(self, level: int) -> NDArray[np.uint8]:
        """Mip level `level` of gradient, 0 to levels - 1."""
        return self._level("gradient_rgba8", level, "gradients=True")

    @property
    def slopes(self) -> NDArray[np.uint8]:
        """(N, N, 4), a view: h_x, h_z, D_xx, D_zz, each (byte - 128)/127 of slope_range. They add
        to those of other cascades. Requires Ocean(slopes=...)."""
        return self.slopes_level(0)

    def slopes_level(self, level: int) -> NDArray[np.uint8]:
        """Mip level `level` of slopes, 0 to levels - 1."""
        return self._level("slopes_rgba8", level, "slopes=True")

    @property
    def moments(self) -> NDArray[np.uint8]:
        """(N, N, 4), a view: D_xz as in slopes, then the variances of h_x and h_z within a texel,
        byte/255 of variance_range, and their covariance, (byte - 128)/127 of it. Requires slopes.
        """
        return self.moments_level(0)

    def moments_level(self, level: int) -> NDArray[np.uint8]:
        """Mip level `level` of moments, 0 to levels - 1."""
        return self._level("moments_rgba8", level, "slopes=True")

    @property
    def compression(self) -> Optional[NDArray[np.uint8]]:
        """(N, N), a view: compression q = -3 + 8 byte/255 now. Foam is that of the sum of the
        cascades' q; see snapshots. None if the cascade makes no foam. Requires Ocean(foam=True).
        """
        struct = self._alive()
        self._frame._need_foam()
        if not struct.compression_r8:
            return None
        return view_of(self._frame, struct.compression_r8, "|u1", (struct.resolution, struct.resolution))

    @property
    def snapshots(self) -> Optional[Tuple[NDArray[np.uint8], ...]]:
        """Four (N, N, 4) views: q at 16 past ticks, snapshot s in image s // 4, byte s % 4. With S
        the sum over the cascades, the foam at a position is the largest of clamp(0.5 + (S -
        foam_threshold)/0.3, 0, 1) of compression, and that minus snapshot_ages[s] of snapshot s.
        None if the cascade makes no foam. Requires Ocean(foam=True)."""
        struct = self._alive()
        self._frame._need_foam()
        if not struct.snapshots_rgba8[0]:
            return None
        side = struct.resolution
        return tuple(view_of(self._frame, address, "|u1", (side, side, 4)) for address in struct.snapshots_rgba8)

    @property
    def drift(self) -> Tuple[float, float]:
        """Columns and rows: texel (i, j) has the snapshots of texel (i - columns, j - rows)."""
        struct = self._alive()
        return struct.drift_columns, struct.drift_rows

    @property
    def resolution(self) -> int:
        """N, texels along a side."""
        return int(self._alive().resolution)

    @property
    def levels(self) -> int:
        """Mip levels of gradient, slopes and moments."""
        return int(self._alive().levels)

    @property
    def patch_size_m(self) -> float:
        """L, the period of the cascade along its axes, in metres."""
        return float(self._alive().side_m)

    @property
    def rotation(self) -> Tuple[float, float]:
        """Cosine and sine of the rotation of its axes relative to the world's, from +x towards +z.
        """
        struct = self._alive()
        return struct.cosine, struct.sine

    @property
    def slope_range(self) -> float:
        """Range of the bytes of slopes."""
        return float(self._alive().slope_range)

    @property
    def variance_range(self) -> float:
        """Range of the variances in moments."""
        return float(self._alive().variance_range)

    @property
    def bounds(self) -> Bounds:
        """Exact extremes of the cascade's displacements."""
        return Bounds(self._alive().bounds)


class Frame:
    """The sea at a time. It is valid until the second schedule() or frame_at() after its own, and
    then raises StaleFrame; time_s, sea, bounds and significant_wave_height_m stay valid. Any number
    of threads may query it at the same time."""

    __slots__ = ("_ocean", "_struct", "_number", "_cascades", "_waves", "_shore", "_sea", "__weakref__")
    _ocean: Ocean
    _number: int
    _cascades: List[Any]

    def __init__(self, ocean: Ocean, struct: Any) -> None:
        # What functions of the library describe only for the frame completed last.
        handle = ocean._handle
        self._ocean, self._struct, self._number = ocean, struct, struct.number
        self._cascades = [c.sized(c.pelagic_cascade) for _ in range(struct.cascade_count)]
        for i, cascade in enumerate(self._cascades):
            call(quick_library.pelagic_ocean_cascade, handle, i, cascade)
        self._waves = self._shore = None
        if ocean._has_dynamic_waves:
            self._waves = c.sized(c.pelagic_dynamic_waves_view)
            call(quick_library.pelagic_dynamic_waves_get_view, ocean._waves, self._waves)
        if ocean._has_shore:
            self._shore = c.sized(c.pelagic_shore_surface)
            call(quick_library.pelagic_ocean_shore, handle, self._shore)
        self._sea: Any = ocean._sea  # or a struct
        if ocean._has_changes:
            self._sea = c.sized(c.pelagic_sea)
            call(quick_library.pelagic_ocean_sea, handle, self._sea)

    def _need_alive(self) -> None:
        self._ocean._need_alive(self._number)

    def _need_foam(self) -> None:
        if not self._ocean._has_whitecaps:
            raise ValueError("the frame has no foam: create the ocean with foam=True")

    def _need_planes(self) -> None:
        if not self._struct.height.data:
            raise ValueError("the frame has no planes: create the ocean with planes=True")

    def _hash(self, kind: int) -> int:
        return self._ocean._hash(self._number, kind)

    @property
    def displacement(self) -> NDArray[np.float16]:
        """(N, N, 4), a view of the first cascade, which has the longest waves."""
        return Cascade(self, self._cascades[0]).displacement

    @property
    def height(self) -> NDArray[np.float32]:
        """(N, N), a copy of the first cascade's heights, without those of others; query() includes
        all."""
        return Cascade(self, self._cascades[0]).height

    @property
    def cascades(self) -> List[Cascade]:
        """The cascades, the coarsest first."""
        self._need_alive()
        return [Cascade(self, struct) for struct in self._cascades]

    @property
    def time_s(self) -> float:
        """The requested time."""
        return float(self._struct.time_s)

    @property
    def bounds(self) -> Bounds:
        """Sums over the cascades: upper bounds, exact with cascades=1."""
        return Bounds(self._struct.bounds)

    @property
    def sea(self) -> Sea:
        """The sea at this time."""
        if not isinstance(self._sea, Sea):
            self._sea = Sea._of_library(self._sea)
        sea: Sea = self._sea
        return sea

    @property
    def significant_wave_height_m(self) -> float:
        """Hs of the waves that the cascades represent, the mean over all seeds."""
        return float(self._struct.wave_height_m)

    @property
    def is_alive(self) -> bool:
        """False if the frame would raise StaleFrame or its ocean is closed."""
        return not self._ocean.is_closed and self._number >= self._ocean._oldest

    @property
    def dynamic_waves(self) -> DynamicWavesView:
        """Wakes, ripples and splashes. Requires Ocean(dynamic_waves=...)."""
        if self._waves is None:
            raise ValueError("the frame has no dynamic waves: create the ocean with dynamic_waves=pelagic.DynamicWavesOptions()")
        return DynamicWavesView(self, self._waves)

    @property
    def shore(self) -> ShoreSurface:
        """Depths, weights and waves over the floor. Requires Ocean(shore=...)."""
        if self._shore is None:
            raise ValueError("the frame has no shore: create the ocean with shore=pelagic.ShoreOptions(heights_m)")
        return ShoreSurface(self, self._shore)

    @property
    def hash(self) -> int:
        """XXH3 of all of the frame's data, which the command line prints in hexadecimal digits."""
        return self._hash(c.PELAGIC_HASH_FRAME)

    @property
    def foam_hash(self) -> int:
        """XXH3 of the foam. Requires Ocean(foam=True)."""
        self._need_alive()
        self._need_foam()
        return self._hash(c.PELAGIC_HASH_FOAM)

    @property
    def droplets(self) -> NDArray[np.void]:
        """A view with the fields position (x, y, z), velocity (x, y, z), radius, opacity and age, in
        the world: droplets of emitters, then of crests, each with the newest first. Droplets below
        the water are not removed. Requires Ocean(spray=...)."""
        self._need_alive()
        self._ocean._need_spray("frame")
        count = self._struct.droplet_count
        return view_of(self, self._struct.droplets, "|V48", (count,), _DROPLET) if count else np.empty(0, _DROPLET)

    @property
    def spray_hash(self) -> int:
        """XXH3 of the droplets. Requires Ocean(spray=...)."""
        self._need_alive()
        self._ocean._need_spray("frame")
        return self._hash(c.PELAGIC_HASH_SPRAY)

    @property
    def foam_threshold(self) -> float:
        """The sum of compressions at which half of the water is white; 1000 without whitecaps."""
        return float(self._struct.foam_level)

    @property
    def snapshot_ages(self) -> List[float]:
        """Foam that has decayed since each of the 16 snapshots; 1 and more: it has no effect."""
        return list(self._struct.foam_age)

    def measured_significant_wave_height_m(self) -> float:
        """4 times the standard deviation of the frame's heights."""
        self._need_alive()
        if not self._struct.height.data:
            raise ValueError("wave heights cannot be measured in a frame without planes")
        variance = 0.0
        for cascade in self.cascades:
            heights = cascade.height.ravel().astype(np.float64)
            # cumsum adds in order, as the library does.
            mean, mean_square = (float(np.cumsum(of)[-1]) / heights.size for of in (heights, heights * heights))
            variance += max(0.0, mean_square - mean * mean)
        return 4 * float(np.sqrt(variance))

    def query(
        self,
        points: ArrayLike,
        z: Optional[ArrayLike] = None,
        *,
        fields: Optional[Iterable[Field]] = None,
        tolerance_m: float = 0.001,
        interpolation: Interpolation = "linear",
        footprint_m: float = 0.0,
    ) -> SurfaceSamples:
        """Samples the displaced surface at points of the world: query(points) or query(x, z).

        `fields` names the requested results; the default is all that the ocean's options provide.
        `interpolation` is that between texels: "linear" is the drawn surface, "cubic" preserves the
        heights and slopes of short waves, for measurements. `footprint_m` leaves out waves shorter
        than about this length, and requires Ocean(depth=True); velocities are then the water's own.
        Results are reproducible: they depend only on the frame, the point and the options. Warns if the points span more than the repeat
        length of the longest waves.
        """
        return _queries.query(self, points, z, fields, tolerance_m, interpolation, footprint_m)

    def sample_water(
        self,
        points: ArrayLike,
        *,
        tolerance_m: float = 0.001,
        interpolation: Interpolation = "linear",
        footprint_m: float = 0.0,
        water_density_kgpm3: float = 1025.0,
    ) -> WaterSamples:
        """Returns the water at points of shape (..., 3), in the world: x, y and z. Requires
        Ocean(depth=True). Raises ValueError for a point below the sea floor.

        `footprint_m` leaves out waves shorter than about this length. The density of the water is in
        [500, 2000].
        """
        return _water.sample_frame(self, points, tolerance_m, interpolation, footprint_m, water_density_kgpm3)

    def rays(self, origins: ArrayLike, directions: ArrayLike, reach: ArrayLike, *, tolerance_m: float = 0.001) -> Hits:
        """Returns the first intersection of each ray with the water. Origins and directions are
        (..., 3); reach is in metres, a number or one for each ray."""
        return _queries.rays(self, origins, directions, reach, tolerance_m)

    def displaced(self, points: ArrayLike, z: Optional[ArrayLike] = None) -> NDArray[np.float32]:
        """Returns (..., 3): displaced positions of water by its reference positions, for meshes.
        Includes dynamic waves and a shore."""
        return _queries.displaced(self, points, z)

    def displaced_foam(self, points: ArrayLike, z: Optional[ArrayLike] = None) -> NDArray[np.float32]:
        """Returns (...): the foam of that water, 0 to 1. Requires Ocean(foam=True), dynamic waves
        or a shore."""
        return _queries.displaced_foam(self, points, z)

    def sample_undisplaced(self, points: ArrayLike) -> UndisplacedSamples:
        """Returns displacement, foam and velocity in one call, for meshes of many vertices that
        move every frame. Points are (n, 2), within 1e9 m."""
        return _queries.sample_undisplaced(self, points)
