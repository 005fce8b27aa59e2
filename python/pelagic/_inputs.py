"""Wave inputs: lists of Gerstner waves, and ripples."""

from __future__ import annotations

import ctypes
from typing import TYPE_CHECKING, Any, Iterable

from ._library import call, library
from ._numbers import instance_of, invalid, iterable_of, number_of
from ._options import AnalyticWave, Ripple
from ._structs import ripple_struct, waves_struct

if TYPE_CHECKING:
    from ._ocean import Ocean

_ACCEPTED = "a list of pelagic.GerstnerInput and pelagic.RippleInput"


class WaveInput:
    """Waves that are added to an ocean's cascades: a GerstnerInput or a RippleInput. It belongs to
    one ocean; changes take effect at the next schedule()."""

    def __init__(self) -> None:
        raise TypeError("WaveInput cannot be created: use GerstnerInput or RippleInput")

    def _create(self, create: Any, struct: Any) -> None:
        self._handle = ctypes.c_void_p()
        self._is_taken = False
        self._ocean: Ocean | None = None
        call(create, struct, ctypes.byref(self._handle))

    def _set(self, set_: Any, struct: Any) -> None:
        if self._ocean is None:
            return call(set_, self._handle, struct)
        with self._ocean._turn:
            call(set_, self._handle, struct)

    def __del__(self, destroy: Any = library.pelagic_input_destroy) -> None:
        if "_handle" in vars(self):
            destroy(self._handle)


def _waves_of(waves: Iterable[AnalyticWave], choppiness: float) -> Any:
    all_ = [instance_of(AnalyticWave, wave, f"waves[{i}]") for i, wave in enumerate(iterable_of(waves, "waves", "a list of pelagic.AnalyticWave"))]
    return waves_struct(all_, number_of(choppiness, "choppiness"))


class GerstnerInput(WaveInput):
    """A list of Gerstner waves, for Ocean(inputs=[...]). Each becomes the nearest wave of a
    cascade's grid, with whole periods in a loop."""

    def __init__(self, waves: Iterable[AnalyticWave] = (), choppiness: float = 1.0) -> None:
        """At most 64 waves; choppiness is in [0, 1], and 0 gives a height field."""
        self._create(library.pelagic_input_create_waves, _waves_of(waves, choppiness))

    def set(self, waves: Iterable[AnalyticWave], choppiness: float = 1.0) -> None:
        """Replaces the waves."""
        self._set(library.pelagic_input_set_waves, _waves_of(waves, choppiness))


class RippleInput(WaveInput):
    """Rings around a point, for Ocean(inputs=[...])."""

    def __init__(self, ripple: Ripple) -> None:
        """The rings."""
        self._create(library.pelagic_input_create_ripple, ripple_struct(instance_of(Ripple, ripple, "ripple")))

    def set(self, ripple: Ripple) -> None:
        """Replaces the rings."""
        self._set(library.pelagic_input_set_ripple, ripple_struct(instance_of(Ripple, ripple, "ripple")))


class TakenInputs:
    """The inputs of a new ocean, in a with statement: no other ocean can have them, unless the
    creation of this one fails."""

    def __init__(self, inputs: Iterable[WaveInput], ocean: Ocean) -> None:
        self.inputs: list[WaveInput] = []
        for i, each in enumerate(iterable_of(inputs, "inputs", _ACCEPTED)):
            if not isinstance(each, WaveInput):
                raise TypeError(invalid(f"inputs[{i}]", repr(each), _ACCEPTED))
            self.inputs.append(each)
        for i, each in enumerate(self.inputs):
            if each._is_taken or each in self.inputs[:i]:
                raise ValueError(f"inputs[{i}] is in use, expected an input of its own")
        self._ocean = ocean

    def __enter__(self) -> ctypes.Array[ctypes.c_void_p]:
        """Returns the handles."""
        for each in self.inputs:
            each._is_taken = True
        return (ctypes.c_void_p * len(self.inputs))(*(each._handle.value for each in self.inputs))

    def __exit__(self, kind: type | None, *_: Any) -> None:
        for each in self.inputs:
            each._is_taken = kind is None
            if kind is None:
                each._ocean = self._ocean
