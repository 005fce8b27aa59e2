"""Options of dynamic waves, spray, shores and wave inputs, with units, defaults and ranges. A value out of
range raises ValueError."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from . import _pelagic

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class DynamicWavesOptions:
    """The grid of an ocean's dynamic waves: Ocean(sea, dynamic_waves=DynamicWavesOptions())."""

    step: str = "spectral"
    """"spectral": the exact dispersion of water of depth_m. "verlet": one speed for all waves, for
    ponds and rings."""
    resolution: int = 256
    """N, texels along a side; 64, 128, 256, 512 or 1024."""
    side_m: float = 64.0
    """Side of the grid; [1, 10000]."""
    ticks_per_s: int = 60
    """Steps of the simulation a second; [10, 240]."""
    border_m: float = 12.0
    """Width of the absorbing border along each side; [0.001, side_m / 4]. 0: no border, and waves
    wrap around."""
    depth_m: float = 10000.0
    """Depth of the water ("spectral"); [0.01, 11000]."""
    viscosity_m2ps: float = 0.002
    """Eddy viscosity ("spectral"); [0, 1]."""
    wave_speed_mps: float = 3.0
    """Speed of all waves ("verlet"); (0, 1000], and (wave_speed_mps / (ticks_per_s texel))^2 is at
    most 0.4."""
    decay_per_s: float = 0.01
    """Decay rate of amplitudes; [0, 10]."""
    foam_height_m: float = 0.2
    """Foam begins above this height and is full at twice this height; [0.001, 100]."""

    def __post_init__(self) -> None:
        _pelagic.check_dynamic_waves_options(self)


@dataclass(frozen=True)
class Disturbance:
    """A disturbance of the water: an impulse, or a source that acts in every tick."""

    shape: str = "gauss"
    """"gauss": height_m exp(-(r / radius_m)^2). "hull": half an ellipsoid of half length length_m
    and half beam radius_m."""
    mode: str = "pressure"
    """"pressure": the weight of the shape's volume of water; adds no water. "relaxation": the water
    approaches the shape at rate_per_s. "impulse": the shape is added at once. "foam": adds the foam
    of waves as high as the shape, and no waves."""
    x_m: float = 0.0
    """Position in the world; [-1e8, 1e8]."""
    z_m: float = 0.0
    """Position in the world; [-1e8, 1e8]."""
    radius_m: float = 1.0
    """Radius; for a hull half its beam; [0.001, 1000]."""
    length_m: float = 1.0
    """Half the length of a hull; [0.001, 1000]."""
    heading_rad: float = 0.0
    """Direction of a hull's length, from +x towards +z; [-2 pi, 2 pi]."""
    height_m: float = 0.0
    """Height of the shape, negative for floating bodies; [-100, 100]."""
    rate_per_s: float = 10.0
    """Rate of a relaxation; (0, 1000]."""
    velocity_x_mps: float = 0.0
    """Velocity of a source; [-1000, 1000]."""
    velocity_z_mps: float = 0.0
    """Velocity of a source; [-1000, 1000]."""

    def __post_init__(self) -> None:
        _pelagic.check_disturbance(self)


@dataclass(frozen=True)
class Rain:
    """Rain on dynamic waves. set_rain() checks the ranges, which depend on the grid."""

    drops_per_m2_s: float = 0.0
    """Mean rate of drops; 0: no rain. At most 16 drops on a texel in a tick."""
    radius_m: float = 0.25
    """Radius of a crater at the still water level; [0.001, side_m / 16]."""
    height_m: float = 0.02
    """Depth of a crater; [-10, 10]."""
    seed: int = 1
    """Seed of the drops; any 32-bit number."""

    def __post_init__(self) -> None:
        _pelagic.check_rain(self)


@dataclass(frozen=True)
class SprayOptions:
    """Spray of breaking crests and emitters: Ocean(sea, spray=SprayOptions())."""

    reach_m: float = 80.0
    """Spray leaves crests within this distance of the centre; [10, 200]."""
    amount: float = 1.0
    """Factor on the number of droplets of crests; [0, 10]."""
    seed: int = 1
    """Seed of the droplets; any 32-bit number."""

    def __post_init__(self) -> None:
        _pelagic.check_spray_options(self)


@dataclass(frozen=True)
class SprayEmitter:
    """Droplets that leave a ball at once, for instance at the bow of a ship; in the world."""

    time_s: float = 0.0
    """Time at which they leave; [-1e9, 1e9]."""
    x_m: float = 0.0
    """Centre of the ball; [-1e8, 1e8]."""
    y_m: float = 0.0
    """Centre of the ball; [-1e8, 1e8]."""
    z_m: float = 0.0
    """Centre of the ball; [-1e8, 1e8]."""
    extent_m: float = 0.0
    """Radius of the ball; [0, 100]."""
    velocity_x_mps: float = 0.0
    """Mean velocity; [-100, 100]."""
    velocity_y_mps: float = 0.0
    """Mean velocity; [-100, 100]."""
    velocity_z_mps: float = 0.0
    """Mean velocity; [-100, 100]."""
    spread_mps: float = 0.0
    """Largest deviation from the mean velocity; [0, 100]."""
    radius_m: float = 0.05
    """Radius of a droplet as it leaves; [0.001, 1]."""
    drop_mm: float = 1.0
    """Diameter of drops, which sets the drag; [0.1, 5]."""
    count: int = 1
    """Number of droplets; [0, 8192]."""

    def __post_init__(self) -> None:
        _pelagic.check_spray_emitter(self)


@dataclass(frozen=True, eq=False)
class ShoreOptions:
    """A sea floor that affects waves: Ocean(sea, shore=ShoreOptions(heights_m)). Requires a sea of
    2 to 4 cascades without transitions."""

    heights_m: ArrayLike
    """Heights of the floor above still water, (rows, columns), 2 to 4096 each, in [-11000, 9000].
    Element [j, i] is at x = corner_x_m + i metres_per_sample, z = corner_z_m + j metres_per_sample."""
    corner_x_m: float = 0.0
    """Position of element [0, 0]; [-1e8, 1e8]."""
    corner_z_m: float = 0.0
    """Position of element [0, 0]; [-1e8, 1e8]."""
    metres_per_sample: float = 1.0
    """Distance between elements; [0.001, 10000]."""
    resolution: int = 256
    """Texels along the longer side of the shore in frames; 64, 128, 256, 512 or 1024."""
    fade_m: float = 0.0
    """Width of the transition to the open sea along the field's edges;
    [0, half the field's shorter side]. 0: an eighth of that side."""
    swash_m: float = -1.0
    """Maximum height of swash on dry sand; [0, 10], or -1: derived from the sea and the slope."""

    def __post_init__(self) -> None:
        _pelagic.check_shore_options(self)


@dataclass(frozen=True)
class AnalyticWave:
    """A wave in deep water: height = amplitude_m cos(k.x - w t + phase_rad), w^2 = g k."""

    amplitude_m: float = 0.0
    """[0, 100]; the sum of 2 pi amplitude_m / wavelength_m over the waves is at most 0.4."""
    wavelength_m: float = 10.0
    """[0.01, 1000]."""
    direction_rad: float = 0.0
    """Direction of travel, from +x towards +z; [-2 pi, 2 pi]."""
    phase_rad: float = 0.0
    """Phase at x = z = t = 0, a crest by default; [-2 pi, 2 pi]."""

    def __post_init__(self) -> None:
        _pelagic.check_analytic_wave(self)


@dataclass(frozen=True)
class Ripple:
    """Rings around a point, which repeat with the period of their cascade."""

    x_m: float = 0.0
    """Centre; [-1e8, 1e8]."""
    z_m: float = 0.0
    """Centre; [-1e8, 1e8]."""
    wavelength_m: float = 1.0
    """[0.01, 1000]."""
    amplitude_m: float = 0.0
    """[0, 100], and at most wavelength_m / (2 pi)."""
    reach_m: float = 0.0
    """Radius of the rings; [0, 1e5]. 0, or more than half the cascade's side: half the side."""
    phase_rad: float = 0.0
    """Phase at the centre at t = 0, a crest by default; [-2 pi, 2 pi]."""

    def __post_init__(self) -> None:
        _pelagic.check_ripple(self)
