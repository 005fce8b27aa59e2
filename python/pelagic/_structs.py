"""Structs of the library from the attributes of options, and checks of options."""

from __future__ import annotations

import ctypes
from difflib import get_close_matches
from typing import TYPE_CHECKING, Any, Iterable

import numpy as np

from . import _native as c
from ._library import last_message, library
from ._numbers import invalid, list_of, number_of, whole_number_of

if TYPE_CHECKING:
    from ._options import AnalyticWave, Disturbance, DynamicWavesOptions, Rain, Ripple, ShoreOptions, SprayEmitter, SprayOptions
    from ._sea import Sea, WaveSystem

# Fields that Python names instead of numbering, by the constants of C.
_NAMED_FIELDS = {
    # generated from schema/sea.toml: python-names
    "waves": "PELAGIC_WAVES_",
    "spectrum": "PELAGIC_SPECTRUM_",
    "spreading": "PELAGIC_SPREADING_",
    # end of generated
    # generated from schema/dynamic_waves.toml: python-names
    "step": "PELAGIC_DYNAMIC_WAVES_",
    # end of generated
    # generated from schema/disturbance.toml: python-names
    "shape": "PELAGIC_SHAPE_",
    "mode": "PELAGIC_DISTURBANCE_",
    # end of generated
}
NAMES = {field: [name[len(prefix):].lower().replace("_", "-") for name in vars(c) if name.startswith(prefix)]
         for field, prefix in _NAMED_FIELDS.items()}
# -1 stands for a derived value in Python and C, and so does 0 in C: there, this number stands for 0.
_NEARLY_0 = 5e-324
_ZERO_IN_C = ("swash_m",)


def nearest_hint(name: str, names: Iterable[str]) -> str:
    """Returns a hint such as " (the nearest is rough)", or an empty string."""
    near = get_close_matches(name, list(names), 1)
    return f" (the nearest is {near[0]})" if near else ""


def _number_of_name(name: Any, field: str) -> int:
    names = NAMES[field]
    if not isinstance(name, str):
        raise TypeError(invalid(field, repr(name), f"a name: {list_of(names)}"))
    if name not in names:
        raise ValueError(invalid(field, name, list_of(names)) + nearest_hint(name, names))
    return names.index(name)


class _OutOfRange(dict):  # type: ignore[type-arg]
    """Texts of whole numbers that do not fit the library's, by those that stand for them."""

    def fitting(self, value: int, name: str, kind: Any) -> int:
        if kind is ctypes.c_uint32:
            if not 0 <= value < 2**32:
                raise ValueError(invalid(name, str(value), "a whole number from 0 to 4294967295"))
            return value
        fits = min(max(value, -2**31), 2**31 - 1)
        if fits != value:
            self[str(fits)] = str(value)
        return fits


def struct_of(type_: Any, options: Any, **given: Any) -> Any:
    """Returns a struct with the attributes of `options` that have the names of its fields. Fields that
    `given` names have those values."""
    struct = c.sized(type_, **given)
    struct.out_of_range = _OutOfRange()
    for name, kind, *_ in type_._fields_:
        if name == "struct_size" or name in given or not hasattr(options, name):
            continue
        value = getattr(options, name)
        if name in NAMES:
            setattr(struct, name, _number_of_name(value, name))
        elif kind is ctypes.c_double:
            number = number_of(value, name)
            setattr(struct, name, _NEARLY_0 if number == 0 and name in _ZERO_IN_C else number)
        else:
            setattr(struct, name, struct.out_of_range.fitting(whole_number_of(value, name), name, kind))
    return struct


def _checked(struct: Any, status: int) -> Any:
    if status:
        text = last_message()
        for stands, value in struct.out_of_range.items():
            text = text.replace(stands, value, 1)
        raise ValueError(text)
    return struct


def _checked_options(struct: Any) -> Any:
    return _checked(struct, library.pelagic_options_check(type(struct).__name__.encode(), ctypes.byref(struct)))


def sea_struct(sea: Any) -> Any:
    """Returns a checked pelagic_sea."""
    if not hasattr(sea, "wind_speed_mps"):
        raise TypeError(invalid("sea", repr(sea), 'a pelagic.Sea, such as pelagic.preset("rough")'))
    systems = [struct_of(c.pelagic_wave_system, system) for system in sea.systems]
    struct = struct_of(c.pelagic_sea, sea, systems=tuple(systems), system_count=len(systems))
    return _checked(struct, library.pelagic_sea_check(struct))


def wave_system_struct(system: WaveSystem) -> Any:
    return _checked_options(struct_of(c.pelagic_wave_system, system))


def systems_of(systems: Any, type_: Any) -> tuple[WaveSystem, ...]:
    """Returns the wave systems of a sequence."""
    try:
        found = tuple(systems)
    except TypeError:
        raise TypeError(invalid("systems", repr(systems), "a sequence of pelagic.WaveSystem")) from None
    for i, system in enumerate(found):
        if not isinstance(system, type_):
            raise TypeError(invalid(f"systems[{i}]", repr(system), "a pelagic.WaveSystem"))
    if len(found) > (most := c.pelagic_sea().systems._length_):
        raise ValueError(f"systems has {len(found)} elements, expected 0 to {most}")
    return found


def values_of(struct: Any, names: Iterable[str]) -> dict[str, Any]:
    """Returns the values of a struct for fields of a Sea or a WaveSystem."""
    values = {name: getattr(struct, name) for name in names if hasattr(struct, name)}
    for name in values.keys() & NAMES.keys():
        values[name] = NAMES[name][values[name]]
    return values


def dynamic_waves_struct(options: DynamicWavesOptions) -> Any:
    return _checked_options(struct_of(c.pelagic_dynamic_waves_options, options))


def disturbance_struct(disturbance: Disturbance) -> Any:
    return _checked_options(struct_of(c.pelagic_disturbance, disturbance))


def rain_struct(rain: Rain) -> Any:
    return _checked_options(struct_of(c.pelagic_rain, rain))


def ripple_struct(ripple: Ripple) -> Any:
    return _checked_options(struct_of(c.pelagic_ripple, ripple))


def spray_struct(options: SprayOptions) -> Any:
    return _checked_options(struct_of(c.pelagic_spray_options, options))


def spray_emitter_struct(emitter: SprayEmitter) -> Any:
    return _checked_options(struct_of(c.pelagic_spray_emitter, emitter))


def shore_struct(options: ShoreOptions) -> Any:
    """Returns checked options, which keep the heights."""
    try:
        heights = np.array(options.heights_m, np.float32, order="C")
    except (TypeError, ValueError):
        raise ValueError("heights_m can't be made an array of numbers") from None
    if heights.ndim != 2:
        raise ValueError(invalid("heights_m.ndim", str(heights.ndim), "2: an array of (rows, columns)"))
    rows, columns = heights.shape
    struct = struct_of(c.pelagic_shore_options, options, rows=rows, columns=columns, heights_m=heights.ctypes.data)
    struct.heights = heights
    return _checked_options(struct)


def waves_struct(waves: Iterable[AnalyticWave], choppiness: float) -> Any:
    """Returns waves of a wave input, whose sum is not checked."""
    columns = [[number_of(getattr(wave, name), name) for wave in waves] for name in ("amplitude_m", "wavelength_m", "direction_rad", "phase_rad")]
    numbers = np.array(columns, np.float64)
    amplitude, wavelength, direction, phase = (row.ctypes.data for row in numbers)
    struct = c.sized(c.pelagic_waves, count=numbers.shape[1], amplitude_m=amplitude, wavelength_m=wavelength, direction_rad=direction,
                     phase_rad=phase, choppiness=choppiness)
    struct.numbers, struct.out_of_range = numbers, {}
    return struct


def check_analytic_wave(wave: AnalyticWave) -> None:
    _checked_options(waves_struct([wave], 1.0))


def check_sea(sea: Sea) -> None:
    sea_struct(sea)
