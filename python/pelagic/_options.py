"""Options of dynamic waves, spray, shores and wave inputs, with units, defaults and ranges. A value out of
range raises ValueError."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from . import _structs

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class DynamicWavesOptions:
    """The grid of an ocean's dynamic waves: Ocean(sea, dynamic_waves=DynamicWavesOptions())."""

    # generated from schema/dynamic_waves.toml: python-fields
    step: str = "spectral"
    """How a tick advances the waves: "spectral" (advances each wave by its own phase: the exact
    dispersion of deep or shallow water, stable at any length of a tick; wakes have Kelvin's angle),
    "verlet" (h' = h + d^2 (h - h_before) + d c lap h, d = e^(-decay dt), c = (speed dt / dx)^2 <=
    0.4: one speed for all waves, for ponds and rings)."""
    resolution: int = 256
    """N, texels along a side; 64, 128, 256, 512 or 1024."""
    side_m: float = 64.0
    """Side of the grid; [1, 10000]."""
    ticks_per_s: int = 60
    """Ticks of the simulation a second; [10, 240]."""
    border_m: float = 12.0
    """Width of the absorbing border along each side; [0.001, side_m / 4]. 0: no border, and waves
    wrap around."""
    depth_m: float = 1e4
    """Depth of the water (spectral); [0.01, 11000]."""
    viscosity_m2ps: float = 2e-3
    """Eddy viscosity nu, which damps amplitudes at the rate 2 nu k^2 (spectral); [0, 1]."""
    wave_speed_mps: float = 3.0
    """Speed of all waves, with (speed / (ticks_per_s texel))^2 at most 0.4 (verlet); (0, 1000]."""
    decay_per_s: float = 0.01
    """Decay rate of amplitudes; [0, 10]."""
    foam_height_m: float = 0.2
    """Foam begins above this height and is full at twice it; [0.001, 100]."""
    # end of generated

    def __post_init__(self) -> None:
        _structs.dynamic_waves_struct(self)


@dataclass(frozen=True)
class Disturbance:
    """A disturbance of the water: an impulse, or a source that acts in every tick."""

    # generated from schema/disturbance.toml: python-fields
    shape: str = "gauss"
    """Shape: "gauss" (height_m exp(-(r / radius_m)^2), cut off at 3 radii), "hull" (height_m sqrt(1
    - (along / length_m)^2 - (across / radius_m)^2) within that ellipse; height_m of a floating hull
    is below 0)."""
    mode: str = "pressure"
    """What the shape does to the water: "pressure" (a pressure, or suction, equal to the weight of
    the shape's water: at rest the surface becomes the shape and stays so, and a moving one leaves
    the waves of a moving pressure (Havelock 1908). The volume of the water is constant),
    "relaxation" (the surface approaches the shape: a tick removes the fraction 1 - e^(-rate tick)
    of the difference, times the shape over its height. The bulge is bounded, and its volume is
    added to the water), "impulse" (the shape is added to the surface at once: a drop, a stone),
    "foam" (adds the foam that waves as high as the shape have, and no waves: water that a hull or a
    propeller breaks)."""
    x_m: float = 0.0
    """Initial position in the world; [-1e8, 1e8]."""
    z_m: float = 0.0
    """Initial position in the world; [-1e8, 1e8]."""
    radius_m: float = 1.0
    """Radius, of a hull half its beam; [0.001, 1000]."""
    length_m: float = 1.0
    """Half the length of a hull; [0.001, 1000]."""
    heading_rad: float = 0.0
    """Direction of a hull's length, from +x towards +z; [-2 pi, 2 pi]."""
    height_m: float = 0.0
    """Height of the shape, below 0 for a floating hull; [-100, 100]."""
    rate_per_s: float = 10.0
    """Rate of a relaxation; (0, 1000]."""
    velocity_x_mps: float = 0.0
    """Velocity of a source until it is replaced; [-1000, 1000]."""
    velocity_z_mps: float = 0.0
    """Velocity of a source until it is replaced; [-1000, 1000]."""
    # end of generated

    def __post_init__(self) -> None:
        _structs.disturbance_struct(self)


@dataclass(frozen=True)
class Rain:
    """Rain on dynamic waves. set_rain() checks the ranges, which depend on the grid."""

    # generated from schema/rain.toml: python-fields
    drops_per_m2_s: float = 0.0
    """Mean number of drops, at most the value that puts 16 on a texel in a tick; a finite number.
    0: no rain."""
    radius_m: float = 0.25
    """Radius of the crater at the rest level; [0.001, side_m / 16]. A crater narrower than a texel
    is a texel wide on the grid, flatter and with equal volume."""
    height_m: float = 0.02
    """Depth of a crater; [-10, 10]."""
    seed: int = 1
    """Seed of the drops."""
    # end of generated

    def __post_init__(self) -> None:
        _structs.rain_struct(self)


@dataclass(frozen=True)
class SprayOptions:
    """Spray of breaking crests and emitters: Ocean(sea, spray=SprayOptions())."""

    # generated from schema/spray_options.toml: python-fields
    reach_m: float = 80.0
    """Spray leaves crests within this distance of the centre; [10, 200]."""
    amount: float = 1.0
    """Factor on the number of droplets of crests; [0, 10]."""
    seed: int = 1
    """Seed of the droplets."""
    # end of generated

    def __post_init__(self) -> None:
        _structs.spray_struct(self)


@dataclass(frozen=True)
class SprayEmitter:
    """Droplets that leave a ball at once, for instance at the bow of a ship; in the world."""

    # generated from schema/spray_emitter.toml: python-fields
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
    # end of generated

    def __post_init__(self) -> None:
        _structs.spray_emitter_struct(self)


@dataclass(frozen=True, eq=False)
class ShoreOptions:
    """A sea floor that affects waves: Ocean(sea, shore=ShoreOptions(heights_m)). Requires a sea of
    2 to 4 cascades without transitions."""

    heights_m: ArrayLike
    """Heights of the floor above still water, (rows, columns), 2 to 4096 each, in [-11000, 9000].
    Element [j, i] is at x = corner_x_m + i metres_per_sample, z = corner_z_m + j metres_per_sample."""
    # generated from schema/shore.toml: python-fields
    corner_x_m: float = 0.0
    """Position of the first sample; [-1e8, 1e8]."""
    corner_z_m: float = 0.0
    """Position of the first sample; [-1e8, 1e8]."""
    metres_per_sample: float = 1.0
    """Distance of neighbouring samples; [0.001, 10000]."""
    resolution: int = 256
    """Texels along the longer side of the shore; 64, 128, 256, 512 or 1024."""
    fade_m: float = 0.0
    """Width of the strip along the edges over which the coarsest cascade fades into waves over the
    floor; [0, half the field's shorter side]. 0: an eighth of the shorter side."""
    swash_m: float = -1.0
    """Maximum height above still water that waves reach on dry sand, with the set-up; [0, 10]. -1:
    the height that 2 % of the waves reach by Stockdon et al. 2006, from the sea's significant wave
    height and peak period and the median slope at the waterline. Waves in the water do not depend
    on it."""
    # end of generated

    def __post_init__(self) -> None:
        _structs.shore_struct(self)


@dataclass(frozen=True)
class AnalyticWave:
    """A wave in deep water: height = amplitude_m cos(k.x - w t + phase_rad), w^2 = g k."""

    # generated from schema/analytic_wave.toml: python-fields
    amplitude_m: float = 0.0
    """Amplitude; the sum of 2 pi amplitude_m / wavelength_m over the waves is at most 0.4;
    [0, 100]."""
    wavelength_m: float = 10.0
    """Wavelength; [0.01, 1000]."""
    direction_rad: float = 0.0
    """Direction of travel, from +x towards +z; [-2 pi, 2 pi]."""
    phase_rad: float = 0.0
    """Phase at x = z = t = 0, a crest by default; [-2 pi, 2 pi]."""
    # end of generated

    def __post_init__(self) -> None:
        _structs.check_analytic_wave(self)


@dataclass(frozen=True)
class Ripple:
    """Rings around a point, which repeat with the period of their cascade."""

    # generated from schema/ripple.toml: python-fields
    x_m: float = 0.0
    """Centre; [-1e8, 1e8]."""
    z_m: float = 0.0
    """Centre; [-1e8, 1e8]."""
    wavelength_m: float = 1.0
    """Wavelength; [0.01, 1000]."""
    amplitude_m: float = 0.0
    """Amplitude at the centre, at most wavelength_m / (2 pi), a slope of 1; [0, 100]."""
    reach_m: float = 0.0
    """Radius R beyond which the rings are 0; [0, 1e5]. 0 or more than half of the cascade's side:
    half of that side."""
    phase_rad: float = 0.0
    """Phase at the centre at t = 0, where 0 is a crest; [-2 pi, 2 pi]."""
    # end of generated

    def __post_init__(self) -> None:
        _structs.ripple_struct(self)
