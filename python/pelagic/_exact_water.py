"""The exact sum over the waves of a sea, at any position and depth."""

from __future__ import annotations

import ctypes
import threading
from typing import Any, Optional, Tuple, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native as c
from . import _water
from ._library import call, library
from ._numbers import address_of, number_of, rows_of
from ._ocean import executor_of
from ._sea import Sea
from ._structs import sea_struct
from ._water import WaterSamples


class ExactSurface(TypedDict):
    """The undisplaced surface at each position."""

    height: NDArray[np.float32]  #: metres
    normal: NDArray[np.float32]  #: (..., 3), unit vectors
    velocity: NDArray[np.float32]  #: (..., 3), m/s


class ExactWater:
    """The water of a sea at one moment, by the sum of all of its waves: that of linear theory at
    fixed positions, without choppiness. The heights are those of frames before displacement. A
    point takes some 25 microseconds with four cascades of 128."""

    def __init__(
        self,
        sea: Sea,
        *,
        time_s: float = 0.0,
        water_density_kgpm3: float = 1025.0,
        sea_level_m: float = 0.0,
        current_mps: Tuple[float, float] = (0.0, 0.0),
        threads: int = 0,
    ) -> None:
        """Computes the waves of a sea, which is no pond.

        :param time_s: as set_time()
        :param water_density_kgpm3: density of the water; [500, 2000]
        :param sea_level_m, current_mps: as Ocean.set_water_frame()
        :param threads: maximum threads of a sample, including the calling thread. 0: one per core.
        """
        self._handle: Optional[int] = None
        self._turn = threading.Lock()
        struct = sea_struct(sea)
        x_mps, z_mps = current_mps
        frame = c.sized(c.pelagic_water_frame, sea_level_m=number_of(sea_level_m, "sea_level_m"), current_x_mps=number_of(x_mps, "current_mps"),
                        current_z_mps=number_of(z_mps, "current_mps"))
        options = c.sized(c.pelagic_exact_water_options, water_density_kgpm3=number_of(water_density_kgpm3, "water_density_kgpm3"),
                          water_frame=ctypes.pointer(frame))
        time_s = number_of(time_s, "time_s")
        executor, handle = executor_of(threads), ctypes.c_void_p()
        try:
            options.executor = executor
            call(library.pelagic_exact_water_create, struct, options, ctypes.byref(handle))
        finally:
            library.pelagic_executor_destroy(executor)
        self._handle = handle.value
        self.set_time(time_s)

    def __del__(self, destroy: Any = library.pelagic_exact_water_destroy) -> None:
        if getattr(self, "_handle", None):
            destroy(self._handle)

    def set_time(self, time_s: float) -> None:
        """Moves the water to a time in seconds, which takes about as long as a point."""
        time_s = number_of(time_s, "time_s")
        with self._turn:
            call(library.pelagic_exact_water_set_time, self._handle, time_s)

    def set_origin(self, x_m: float, z_m: float) -> None:
        """Shifts the world's origin, as Ocean.set_origin(), for samples from now on."""
        x_m, z_m = number_of(x_m, "x_m"), number_of(z_m, "z_m")
        with self._turn:
            call(library.pelagic_exact_water_set_origin, self._handle, x_m, z_m)

    def sample(self, points: ArrayLike, *, footprint_m: float = 0.0) -> WaterSamples:
        """Returns the water at points of shape (..., 3), in the world: x, y and z, without waves
        shorter than the footprint. Raises ValueError for a point below the sea floor."""
        def query(asked: Any, samples: Any) -> None:
            with self._turn:
                call(library.pelagic_exact_water_sample, self._handle, asked, samples)

        return _water.sample(points, query, footprint_m=number_of(footprint_m, "footprint_m"))

    def sample_surface(self, points: ArrayLike, *, footprint_m: float = 0.0) -> ExactSurface:
        """Returns the surface, which is not displaced, at positions of shape (..., 2): x and z, without
        waves shorter than the footprint."""
        array = rows_of(points, "points", 2, "x and z of each point")
        shape, rows = array.shape[:-1], array.reshape(-1, 2).T.copy()
        count = rows.shape[1]
        results: Any = {name: np.empty(count if name == "height" else (3, count), np.float32) for name in ("height", "normal", "velocity")}
        asked = c.sized(c.pelagic_points, parallel=1, count=count, footprint_m=number_of(footprint_m, "footprint_m"),
                        **_water.rows({"": rows}, "", ("x", "z")))
        samples = c.sized(c.pelagic_samples, height_m=address_of(results["height"]), **_water.rows(results, "normal", ("normal_x", "normal_y", "normal_z")),
                          **_water.rows(results, "velocity", _water.VELOCITY))
        with self._turn:
            call(library.pelagic_exact_water_sample_surface, self._handle, asked, samples)
        return {"height": results["height"].reshape(shape), "normal": _water.by_point(results["normal"], shape),
                "velocity": _water.by_point(results["velocity"], shape)}
