"""Simulation of FFT ocean waves on the CPU, with reproducible results.

    import pelagic

    with pelagic.Ocean(pelagic.preset("rough")) as ocean:
        frame = ocean.frame_at(12.5)
        samples = frame.query([[3.0, 4.0], [100.0, -20.0]])
        print(samples["height"], hex(frame.hash))

Conventions: SI units, named in each field; right-handed, +y up, still water at y = 0; angles in
radians; time in seconds.
"""

from types import MappingProxyType as _MappingProxyType
from typing import Mapping as _Mapping

from ._exact_water import ExactWater
from ._explained import explain as _explain
from ._frame import Bounds, Cascade, Frame
from ._hulls import Bodies, Hull, HullState
from ._inputs import GerstnerInput, RippleInput, WaveInput
from ._library import StaleFrame, isas_here, version as _version
from ._ocean import Ocean
from ._options import AnalyticWave, Disturbance, DynamicWavesOptions, Rain, Ripple, ShoreOptions, SprayEmitter, SprayOptions
from ._sea import Report, Sea, WaveSystem, presets_of_library as _presets_of_library
from ._structs import nearest_hint as _nearest_hint
from ._waves import DynamicWaves, DynamicWavesView, ShoreSurface

__all__ = [
    "AnalyticWave", "Bodies", "Bounds", "Cascade", "Disturbance", "DynamicWaves", "DynamicWavesOptions", "DynamicWavesView", "ExactWater", "Frame",
    "GerstnerInput", "Hull", "HullState", "Ocean", "Rain", "Report", "Ripple", "RippleInput", "Sea", "ShoreOptions", "ShoreSurface", "SprayEmitter",
    "SprayOptions", "StaleFrame", "WaveInput", "WaveSystem", "isas_here", "preset", "preset_summaries", "presets",
]

__version__ = _version()

_presets = list(_presets_of_library())

#: Named seas, mildest first, followed by the open sea of each Beaufort number, "beaufort-0" to
#: "beaufort-12".
presets: _Mapping[str, Sea] = _MappingProxyType({name: sea for name, _, sea in _presets})

#: A one-line summary of each preset.
preset_summaries: _Mapping[str, str] = _MappingProxyType({name: summary for name, summary, _ in _presets})

_explain(AnalyticWave, Bodies, Cascade, Disturbance, DynamicWaves, DynamicWavesOptions, ExactWater, Frame, GerstnerInput, Hull, Ocean, Rain, Ripple, RippleInput, Sea,
         ShoreOptions, SprayEmitter, SprayOptions, WaveSystem)


def preset(name: str) -> Sea:
    """Returns the sea of a name of `presets`."""
    try:
        return presets[name]
    except KeyError:
        hint = _nearest_hint(str(name), presets)
        raise ValueError(f"preset is {name}, expected {', '.join(list(presets)[:-1])} or {list(presets)[-1]}{hint}") from None
