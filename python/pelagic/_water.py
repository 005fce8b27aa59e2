"""Water at any position and depth: the results of calls of the library, as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Callable, Dict, Optional, Tuple, TypedDict

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native as c
from ._library import library
from ._numbers import address_of, invalid, number_of, number_text, rows_of
from ._queries import interpolation_of, tolerance_of

if TYPE_CHECKING:
    from ._frame import Frame


class WaterSamples(TypedDict):
    """The water at each point. In the air the pressure is 0, and the motion that of the surface."""

    depth: NDArray[np.float32]  #: below the surface above the point, metres; negative in the air
    pressure: NDArray[np.float32]  #: above that of the air, Pa
    velocity: NDArray[np.float32]  #: (..., 3), the water's own, m/s
    acceleration: NDArray[np.float32]  #: (..., 3), m/s^2


VELOCITY = ("velocity_x_mps", "velocity_y_mps", "velocity_z_mps")


def rows(results: Any, name: str, names: Tuple[str, ...]) -> Dict[str, Optional[int]]:
    """Returns the addresses of the rows of x, y and z, by the names of their fields."""
    return {field: address_of(row) for field, row in zip(names, results[name])}


def by_point(vectors: NDArray[np.float32], shape: Tuple[int, ...]) -> NDArray[np.float32]:
    return np.ascontiguousarray(vectors.T).reshape(*shape, 3)


def sample(points: ArrayLike, query: Callable[[Any, Any], None], **options: Any) -> WaterSamples:
    """Returns the results that query(points, samples) writes, by structs of the library.

    points   (..., 3)
    options  fields of pelagic_water_points
    """
    array = rows_of(points, "points", 3, "x, y and z of each point")
    shape, xyz = array.shape[:-1], array.reshape(-1, 3).T.copy()
    count = xyz.shape[1]
    results: Any = {name: np.empty(count if name in ("depth", "pressure") else (3, count), np.float32)
                    for name in ("depth", "pressure", "velocity", "acceleration")}
    asked = c.sized(c.pelagic_water_points, parallel=1, count=count, **options, **rows({"": xyz}, "", ("x", "y", "z")))
    query(asked, c.sized(c.pelagic_water_samples, depth_m=address_of(results["depth"]), pressure_pa=address_of(results["pressure"]),
                         **rows(results, "velocity", VELOCITY),
                         **rows(results, "acceleration", ("acceleration_x_mps2", "acceleration_y_mps2", "acceleration_z_mps2"))))
    return {"depth": results["depth"].reshape(shape), "pressure": results["pressure"].reshape(shape),
            "velocity": by_point(results["velocity"], shape), "acceleration": by_point(results["acceleration"], shape)}


def sample_frame(frame: Frame, points: ArrayLike, tolerance_m: float, interpolation: str, footprint_m: float, water_density_kgpm3: float) -> WaterSamples:
    ocean, number = frame._ocean, frame._number
    ocean._need_alive(number)
    if not ocean._has_depth:
        raise ValueError("the frame has no water below its surface: create the ocean with depth=True")
    density = number_of(water_density_kgpm3, "water_density_kgpm3")
    if not 500 <= density <= 2000:
        raise ValueError(invalid("water_density_kgpm3", number_text(density), "[500, 2000]"))

    def query(asked: Any, samples: Any) -> None:
        ocean._call_of_frame(number, library.pelagic_ocean_sample_water, asked, samples)

    return sample(points, query, frame=number, tolerance_m=tolerance_of(tolerance_m), interpolation=interpolation_of(interpolation),
                  footprint_m=number_of(footprint_m, "footprint_m"), water_density_kgpm3=density)
