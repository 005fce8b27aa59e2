"""The sea that is wanted: wind, grid and look, as plain options with units, defaults and ranges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, List, Optional

from . import _pelagic

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class Report:
    """What follows from a sea's options."""

    significant_wave_height_m: float
    """Hs of the waves that the cascades hold: 4 standard deviations of the height, the mean over all seeds."""
    model_significant_wave_height_m: Optional[float]
    """The same of all waves of the model, whatever the cascades hold; None for phillips-paper, which has no physical scale."""
    peak_period_s: float
    """Where the model's spectrum over frequency peaks."""
    peak_wavelength_m: float
    """The length of waves of that period in this depth."""
    drawn_significant_wave_height_m: float
    """Hs of the waves that this seed drew, the mean over time."""
    drawn_peak_period_s: float
    """The peak period of the waves that this seed drew."""
    warnings: List[str]
    """What a user should know before trusting this sea, a sentence each."""


@dataclass(frozen=True)
class Sea:
    """What sea is wanted. Two machines with the same values and the same Pelagic have the same sea at the same time.

    A value that can't be taken raises ValueError with the range that it has to be in. `dataclasses.replace(sea, seed=2)` makes
    a sea with other values.
    """

    waves: str = "spectrum"
    """Which waves: those of a wind's "spectrum", up to 64 waves of an "analytic" sea, or a pond's octaves, "pond"."""
    spectrum: str = "jonswap"
    """"jonswap", "pierson-moskowitz", "phillips" or "phillips-paper"."""
    spreading: str = "paper"
    """How waves spread around the wind: "paper", "cosine-2s", "hasselmann" or "donelan-banner"; phillips-paper takes no other than
    "paper"."""
    cascades: int = 0
    """How many cascades hold the waves, each a band of them, 1 to 4. 0: four, or one where the side is given or the waves know no other."""
    resolution: int = 0
    """N, texels along a side of each cascade; a power of two, 16 to 2048. 0: 128, or 256 where the side is given."""
    patch_size_m: float = 0.0
    """The side of the one cascade, after which the sea repeats; [0.001, 1e6]. 0: sides chosen from the sea."""
    wind_speed_mps: float = 12.0
    """U10, mean wind 10 m above the sea; (0, 60]."""
    wind_direction_rad: float = 0.0
    """Where the wind blows towards, from +x towards +z; [-2 pi, 2 pi]."""
    fetch_m: float = 100e3
    """How far the wind has blown over water (jonswap); (0, 2e6]. More than 17,000 U10^2 / g adds nothing."""
    depth_m: float = 4000.0
    """Of the water: waves that feel it are slower and lower; [0.01, 11000]."""
    choppiness: float = 0.8
    """0 gives a height field; [0, 1]."""
    roughness: float = -1.0
    """Of the water between texels, for the smoothness channel; [0, 1], or -1: from the wind and what the cascades don't resolve."""
    short_wave_cutoff: float = 0.0
    """0 keeps small waves, 1 removes those below a quarter of the peak's; [0, 1]."""
    wind_alignment: float = 0.5
    """Of the spreading "paper": with 0 a third of the energy runs against the wind, with 1 a hundredth; [0, 1]."""
    swell_height_m: float = 0.0
    """Hs of waves from elsewhere, beside those of the wind; 0: none; [0, 30]."""
    swell_period_s: float = 12.0
    """At which the swell's spectrum peaks; [1, 40]."""
    swell_direction_rad: float = 0.0
    """Where the swell runs towards, as wind_direction_rad; [-2 pi, 2 pi]."""
    swell_spread_rad: float = 0.26179938779914943
    """Standard deviation of the swell's directions; 1 to 80 degrees, 15 by default."""
    loop_period_s: float = 200.0
    """The sea repeats exactly after this time; [0.1, 86400]."""
    seed: int = 1
    """Which sea of this kind; any 32-bit number."""
    wave_count: int = 0
    """Waves of an analytic sea, octaves of a pond; 1 to 64. 0: 16 or 24."""
    longest_wave_m: float = 0.0
    """Of an analytic sea or a pond; [0.02, 1000]. 0: 120, of a pond 1.2."""
    shortest_wave_m: float = 0.0
    """At most the longest; [0.01, 1000]. 0: a sixtieth of the longest, of a pond a 45th."""
    wave_strength: float = 1.0
    """Of an analytic sea: 0 calm, 1 moderate, 2 intense, morphed in between; [0, 2]."""
    wave_height_m: float = 0.0
    """Hs of an analytic sea or a pond; (0, 30]. 0: what the strength makes, of a pond 0.017 of its longest wave."""
    wave_drag: float = 0.38
    """How far a pond's long waves move its short ones; 0: not at all; [0, 1]."""

    def __post_init__(self) -> None:
        _pelagic.check_sea(self)

    @classmethod
    def _of_library(cls, fields: Dict[str, Any]) -> Sea:
        """What the library says that a sea is. While one turns into another, they may differ in what doesn't go together."""
        sea = object.__new__(cls)
        sea.__dict__.update(fields)
        return sea

    def report(self) -> Report:
        """How high and long its waves are; takes as long as an ocean of it does to begin."""
        found: Any = _pelagic.report(self)
        return Report(**found)

    def energy_by_frequency(self, frequencies_hz: ArrayLike) -> NDArray[np.float64]:
        """The spectrum that these options ask for, m^2/Hz, whatever the cascades hold; its integral is the variance of the height."""
        return _pelagic.model_by_frequency(self, frequencies_hz)

    def energy_by_wave_number(self, wave_numbers: ArrayLike) -> NDArray[np.float64]:
        """The same over wave numbers in rad/m, all directions together: m^3."""
        return _pelagic.model_by_wave_number(self, wave_numbers)
