"""The options of a sea: wind, grid and appearance, with units, defaults and ranges."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Dict, List, Optional

from . import _pelagic

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True)
class Report:
    """Statistics of a sea that follow from its options."""

    significant_wave_height_m: float
    """Hs of the waves that the cascades represent: 4 standard deviations of the height, the mean
    over all seeds."""
    model_significant_wave_height_m: Optional[float]
    """Hs of all waves of the model, regardless of the cascades; None for phillips-paper, which has
    no physical scale."""
    peak_period_s: float
    """Peak period of the model's frequency spectrum."""
    peak_wavelength_m: float
    """Wavelength of the peak period at this depth."""
    realised_significant_wave_height_m: float
    """Hs of the waves of this seed, the mean over time."""
    realised_peak_period_s: float
    """Peak period of the waves of this seed."""
    warnings: List[str]
    """Limitations of this sea, one sentence each."""


@dataclass(frozen=True)
class Sea:
    """The options of a sea. Equal values and equal versions of Pelagic give the same sea at the
    same time on every machine.

    An invalid value raises ValueError with the accepted range. `dataclasses.replace(sea, seed=2)`
    returns a sea with other values.
    """

    waves: str = "spectrum"
    """Wave model: "spectrum" of a wind sea, "analytic" with up to 64 waves, or "pond", octaves of
    procedural waves."""
    spectrum: str = "jonswap"
    """"jonswap", "pierson-moskowitz", "phillips" or "phillips-paper"."""
    spreading: str = "paper"
    """Directional spreading: "paper", "cosine-2s", "hasselmann" or "donelan-banner"; phillips-paper
    requires "paper"."""
    cascades: int = 0
    """Number of cascades, each with a band of the waves, 1 to 4. 0: four, or one if patch_size_m is
    given or the wave model supports only one."""
    resolution: int = 0
    """N, texels along a side of each cascade; a power of two, 16 to 2048. 0: 128, or 256 if
    patch_size_m is given."""
    patch_size_m: float = 0.0
    """Side of the only cascade, after which the sea repeats; [0.001, 1e6]. 0: sides computed from
    the sea."""
    wind_speed_mps: float = 12.0
    """U10, mean wind 10 m above the sea; (0, 60]."""
    wind_direction_rad: float = 0.0
    """Direction that the wind blows towards, from +x towards +z; [-2 pi, 2 pi]."""
    fetch_m: float = 100e3
    """Distance that the wind has blown over water (jonswap); (0, 2e6]. More than 17,000 U10^2 / g
    adds nothing."""
    depth_m: float = 4000.0
    """Depth of the water: waves affected by it are slower and lower; [0.01, 11000]."""
    choppiness: float = 0.8
    """0 gives a height field; [0, 1]."""
    roughness: float = -1.0
    """Subgrid roughness, for the smoothness channel; [0, 1], or -1: from the wind and the
    unresolved waves."""
    short_wave_cutoff: float = 0.0
    """0 keeps short waves, 1 removes waves below a quarter of the peak wavelength; [0, 1]."""
    wind_alignment: float = 0.5
    """Wind alignment of the spreading "paper": with 0 a third of the energy travels against the
    wind, with 1 a hundredth; [0, 1]."""
    swell_height_m: float = 0.0
    """Hs of the swell, in addition to the wind sea; 0: no swell; [0, 30]."""
    swell_period_s: float = 12.0
    """Peak period of the swell's spectrum; [1, 40]."""
    swell_direction_rad: float = 0.0
    """Direction that the swell travels towards, like wind_direction_rad; [-2 pi, 2 pi]."""
    swell_spread_rad: float = 0.26179938779914943
    """Standard deviation of the swell's directions; 1 to 80 degrees, 15 by default."""
    loop_period_s: float = 200.0
    """The sea repeats exactly after this time; [0.1, 86400]."""
    seed: int = 1
    """Seed of the random phases and amplitudes; any 32-bit number."""
    wave_count: int = 0
    """Number of waves of an analytic sea, or octaves of a pond; 1 to 64. 0: 16 or 24."""
    longest_wave_m: float = 0.0
    """Longest wavelength of an analytic sea or a pond; [0.02, 1000]. 0: 120, for a pond 1.2."""
    shortest_wave_m: float = 0.0
    """Shortest wavelength, at most the longest; [0.01, 1000]. 0: a sixtieth of the longest, for a
    pond a 45th."""
    wave_strength: float = 1.0
    """Strength of an analytic sea: 0 calm, 1 moderate, 2 intense, interpolated between; [0, 2]."""
    wave_height_m: float = -1.0
    """Hs of an analytic sea or a pond; [0, 30], of a pond above 0. -1: from wave_strength, for a
    pond 0.017 of its longest wave."""
    wave_drag: float = 0.38
    """Fraction by which a pond's long waves move its short waves; 0: not at all; [0, 1]."""

    def __post_init__(self) -> None:
        _pelagic.check_sea(self)

    @classmethod
    def _of_library(cls, fields: Dict[str, Any]) -> Sea:
        """Returns a sea of the library without checks: during a transition its values may not be a
        valid combination."""
        sea = object.__new__(cls)
        sea.__dict__.update(fields)
        return sea

    def report(self) -> Report:
        """Returns statistics of the waves. Takes as long as creating an ocean of this sea."""
        found: Any = _pelagic.report(self)
        return Report(**found)

    def energy_by_frequency(self, frequencies_hz: ArrayLike) -> NDArray[np.float64]:
        """Returns the spectrum of the model, m^2/Hz, regardless of the cascades. Its integral is
        the variance of the height."""
        return _pelagic.model_by_frequency(self, frequencies_hz)

    def energy_by_wave_number(self, wave_numbers: ArrayLike) -> NDArray[np.float64]:
        """Returns the spectrum of the model over wave numbers in rad/m, summed over all directions:
        m^3."""
        return _pelagic.model_by_wave_number(self, wave_numbers)
