"""The options of a sea: wind, grid and appearance, with units, defaults and ranges."""

from __future__ import annotations

import ctypes
import itertools
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING, Any, Iterator, List, Optional, Tuple

import numpy as np

from . import _native as c
from . import _structs
from ._library import call, library, saved_by
from ._numbers import doubles_of, invalid, number_text

if TYPE_CHECKING:
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
class WaveSystem:
    """A wave system: waves of one spectrum and one spreading. An invalid value raises ValueError
    with the accepted range."""

    # generated from schema/wave_system.toml: python-fields
    spectrum: str = "jonswap"
    """Spectrum: jonswap, pierson-moskowitz or phillips: "phillips-paper" (scaled as in VR Ocean,
    without a swell), "phillips" (Phillips' shape with a physical height), "pierson-moskowitz" (a
    fully developed sea; no fetch), "jonswap" (a sea that grows with the fetch), "none" (no wind
    sea: only the swell and systems; the wind still sets roughness, drift, and foam on waves that it
    can raise). By height, pierson-moskowitz is jonswap with gamma 1."""
    spreading: str = "donelan-banner"
    """Directional spreading, where spread_rad is 0: "paper" (VR Ocean, by wind_alignment),
    "cosine-2s" (measured, Longuet-Higgins et al. 1963), "hasselmann" (measured, Hasselmann et al.
    1980), "donelan-banner" (measured, Donelan et al. 1985 and Banner 1990). Hasselmann's and
    cosine-2s depend on the wind; by height and period it is the wind that raises such waves in
    JONSWAP's growth."""
    wind_speed_mps: float = 12.0
    """U10 of the wind of the system; (0, 60]."""
    fetch_m: float = 100e3
    """Distance that it has blown over water (jonswap); (0, 2e6]."""
    height_m: float = 0.0
    """Significant wave height, Hm0; (0, 30]. 0: by the wind and peak_period_s. With peak_period_s,
    the system has both at any depth. Of one alone, the other follows as of the wind sea."""
    peak_period_s: float = 0.0
    """Peak period; [1, 40]. 0: by the wind and height_m."""
    peak_enhancement: float = 3.3
    """Gamma, by which the spectrum is higher at its peak than a fully developed one (jonswap);
    [1, 10]."""
    direction_rad: float = 0.0
    """Direction that the waves run towards, from +x towards +z; [-2 pi, 2 pi]."""
    spread_rad: float = 0.0
    """Standard deviation of the directions; [pi/180, 4 pi/9]. 0: by spreading."""
    # end of generated

    def __post_init__(self) -> None:
        _structs.wave_system_struct(self)

    @classmethod
    def _of_library(cls, struct: Any) -> WaveSystem:
        """Returns a system of the library without checks."""
        system = object.__new__(cls)
        system.__dict__.update(_structs.values_of(struct, (field.name for field in fields(cls))))
        return system


@dataclass(frozen=True)
class Sea:
    """The options of a sea. Equal values and equal versions of Pelagic give the same sea at the
    same time on every machine.

    An invalid value raises ValueError with the accepted range. `dataclasses.replace(sea, seed=2)`
    returns a sea with other values.
    """

    # generated from schema/sea.toml: python-fields
    waves: str = "spectrum"
    """Wave model: "spectrum", "analytic", "pond", "regular". Only a spectrum uses spectrum,
    spreading, fetch_m, peak_period_s, lean, short_wave_cutoff, wind_alignment, the swell, systems
    and seed, and only a spectrum and a regular wave depth_m. Only the other models use wave_count
    and the options after it but wave_height_m and systems. All models use the wind, whose direction
    is that of their waves."""
    spectrum: str = "jonswap"
    """Wave spectrum: "phillips-paper" (scaled as in VR Ocean, without a swell), "phillips"
    (Phillips' shape with a physical height), "pierson-moskowitz" (a fully developed sea; no fetch),
    "jonswap" (a sea that grows with the fetch), "none" (no wind sea: only the swell and systems;
    the wind still sets roughness, drift, and foam on waves that it can raise)."""
    spreading: str = "donelan-banner"
    """Directional spreading: "paper" (VR Ocean, by wind_alignment), "cosine-2s" (measured,
    Longuet-Higgins et al. 1963), "hasselmann" (measured, Hasselmann et al. 1980), "donelan-banner"
    (measured, Donelan et al. 1985 and Banner 1990). The spectrum phillips-paper always has paper,
    and refuses cosine-2s and hasselmann."""
    cascades: int = 0
    """Number of cascades, each a band of wavelengths; 1, 2, 3 or 4. 0: four, or one if patch_size_m
    is set, the resolution is 16 or the model has only one. More than one excludes patch_size_m."""
    resolution: int = 0
    """N, texels along a side of each cascade; a power of two from 16 to 2048. 0: 128, or 256 if
    patch_size_m is set."""
    patch_size_m: float = 0.0
    """L, the side of the only cascade, after which the sea repeats; [0.001, 1e6]. 0: sides derived
    from the sea."""
    wind_speed_mps: float = 12.0
    """U10, mean wind speed 10 m above the sea; (0, 60]."""
    wind_direction_rad: float = 0.0
    """Direction that the wind blows towards, from +x towards +z; [-2 pi, 2 pi]."""
    fetch_m: float = 100e3
    """Distance that the wind has blown over water (jonswap), of which at most 17,000 U10^2 / g has
    an effect; (0, 2e6]. Excludes wave_height_m and peak_period_s."""
    peak_period_s: float = 0.0
    """Peak period of the wind sea (jonswap, pierson-moskowitz); [1, 40]. 0: by wave_height_m and
    the wind. With wave_height_m, the wind sea has that height and period at any depth. Of one
    alone, the other follows from JONSWAP's growth in this wind with the fetch eliminated; of
    pierson-moskowitz, from its peak."""
    peak_enhancement: float = 3.3
    """Gamma, by which the spectrum is higher at its peak than a fully developed one (jonswap);
    [1, 10]."""
    depth_m: float = 4000.0
    """Depth of the water, which slows and lowers long waves; [0.01, 11000]. Waves higher than 0.6
    of it break."""
    choppiness: float = 0.8
    """Scale of horizontal displacements; [0, 1]. 0 gives a height field."""
    lean: float = -1.0
    """Forward displacement of crests of the wind sea, as a fraction of the displacement that
    sharpens them; [0, 0.6]. -1: 0 up to 3 m/s, 0.42 at 10 m/s, 0.52 at 20 m/s; 0 for
    phillips-paper. It makes fronts steeper than backs. A swell and systems do not lean."""
    roughness: float = -1.0
    """GGX roughness of unresolved waves, for the smoothness channel; [0, 1]. -1: from the slopes
    that the cascades do not resolve in this wind."""
    short_wave_cutoff: float = 0.0
    """0 keeps short waves, 1 removes waves shorter than a quarter of the peak wavelength;
    [0, 1]."""
    wind_alignment: float = 0.5
    """Alignment of waves with the wind, alpha of equations 6 to 9, for the spreading paper; [0, 1].
    With 0 a third of the energy runs against the wind and little across it; with 1 a hundredth runs
    against it."""
    swell_height_m: float = 0.0
    """Significant wave height of a swell, in addition to the waves of the wind; [0, 30]. 0: no
    swell."""
    swell_period_s: float = 12.0
    """Peak period of the swell; [1, 40]."""
    swell_direction_rad: float = 0.0
    """Direction that the swell runs towards, as wind_direction_rad; [-2 pi, 2 pi]."""
    swell_spread_rad: float = 0.26179938779914943
    """Standard deviation of the swell's directions; [pi/180, 4 pi/9]. 15 degrees by default."""
    loop_period_s: float = 3600.0
    """T, the period after which the sea repeats exactly; [0.1, 86400]. Waves keep their frequency
    within 1 / (2 T): in short loops groups of waves move in steps."""
    seed: int = 1
    """Seed of the random phases and amplitudes."""
    wave_count: int = 0
    """Number of analytic waves or of pond octaves; 1 to 64. 0: 16 analytic waves, 24 pond
    octaves."""
    longest_wave_m: float = 0.0
    """Longest wavelength of an analytic sea or a pond; [0.02, 1000]. 0: 120, of a pond 1.2."""
    shortest_wave_m: float = 0.0
    """Shortest wavelength, at most the longest; [0.01, 1000]. 0: the longest / 60, of a pond /
    45."""
    wave_strength: float = 1.0
    """Strength of analytic waves: 0 calm, 1 moderate, 2 intense, interpolated between; [0, 2]."""
    wave_height_m: float = 0.0
    """Significant wave height of the wind sea (jonswap, pierson-moskowitz), of an analytic sea or
    of a pond; (0, 30]. 0: from the wind, of analytic waves from wave_strength, of a pond 0.017
    longest_wave_m."""
    wave_drag: float = 0.38
    """Horizontal drag of a pond's short waves by its long ones; [0, 1]."""
    regular_height_m: float = 2.0
    """Height of a regular wave from trough to crest; (0, 60]."""
    regular_period_s: float = 8.0
    """Period of a regular wave; [0.2, 60]. loop_period_s is a whole number of them."""
    order: int = 1
    """Order of Stokes' expansion of a regular wave; 1 or 2. 2 adds the second harmonic that
    choppiness does not make."""
    systems: tuple[WaveSystem, ...] = ()
    """Wave systems, in addition to the waves of the wind and the swell; at most 8."""
    # end of generated

    def __post_init__(self) -> None:
        object.__setattr__(self, "systems", _structs.systems_of(self.systems, WaveSystem))
        _structs.check_sea(self)

    @classmethod
    def _of_library(cls, struct: Any) -> Sea:
        """Returns a sea of the library without checks: during a transition its values may not be a
        valid combination."""
        sea = object.__new__(cls)
        sea.__dict__.update(_structs.values_of(struct, (field.name for field in fields(cls))))
        sea.__dict__["systems"] = tuple(WaveSystem._of_library(system) for system in struct.systems[:struct.system_count])
        return sea

    def report(self) -> Report:
        """Returns statistics of the waves. Takes as long as creating an ocean of this sea."""
        sea, found = _structs.sea_struct(self), c.sized(c.pelagic_statistics)
        call(library.pelagic_sea_statistics, sea, found)
        has_scale = (self.waves, self.spectrum) != ("spectrum", "phillips-paper")
        return Report(found.expected_wave_height_m, found.model_wave_height_m if has_scale else None, found.expected_peak_period_s,
                      found.peak_wavelength_m, found.realised_wave_height_m, found.realised_peak_period_s, warnings_about(sea))

    def energy_by_frequency(self, frequencies_hz: ArrayLike) -> NDArray[np.float64]:
        """Returns the spectrum of the model, m^2/Hz, regardless of the cascades. Its integral is
        the variance of the height."""
        return _energy(self, frequencies_hz, "frequencies_hz", 0)

    def energy_by_wave_number(self, wave_numbers: ArrayLike) -> NDArray[np.float64]:
        """Returns the spectrum of the model over wave numbers in rad/m, summed over all directions:
        m^3."""
        return _energy(self, wave_numbers, "wave_numbers", 1)


def _energy(sea: Sea, at: ArrayLike, name: str, is_by_wave_number: int) -> NDArray[np.float64]:
    places = np.ascontiguousarray(doubles_of(at, name)).reshape(np.shape(at))
    for place in places[~((places > 0) & (places < 1e9))].flat:
        raise ValueError(invalid(name, number_text(float(place)), "(0, 1e9)"))
    energy = np.empty_like(places)
    call(library.pelagic_sea_spectrum, _structs.sea_struct(sea), is_by_wave_number, places.ctypes.data, places.size, energy.ctypes.data)
    return energy


def warnings_about(sea: Any, largest_peak_m: float = 0.0) -> List[str]:
    """Returns the warnings about the cascades of a pelagic_sea."""
    forecast = c.sized(c.pelagic_forecast, first=ctypes.pointer(sea), largest_peak_m=largest_peak_m)
    return saved_by(library.pelagic_forecast_warnings, forecast)[:-1].decode().splitlines()


def presets_of_library() -> Iterator[Tuple[str, str, Sea]]:
    """Yields name, summary and sea of each preset."""
    name, summary, struct = ctypes.c_char_p(), ctypes.c_char_p(), c.sized(c.pelagic_sea)
    for index in itertools.count():
        if library.pelagic_preset_at(index, ctypes.byref(name), ctypes.byref(summary)):
            return
        call(library.pelagic_sea_preset, name, struct)
        yield (name.value or b"").decode(), (summary.value or b"").decode(), Sea._of_library(struct)
