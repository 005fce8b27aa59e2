"""Arrays that view the memory of a frame."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._frame import Frame


class _View:
    """Memory by NumPy's array interface. While it exists, the ocean does not overwrite it."""

    __slots__ = ("__array_interface__", "_ocean")

    def __init__(self, frame: Frame, interface: Any) -> None:
        self._ocean = ocean = frame._ocean
        self.__array_interface__ = interface
        with ocean._state:
            ocean._need_alive(frame._number)
            ocean._views[id(self)] = (frame._number, frame.time_s)

    def __del__(self) -> None:
        self._ocean._views.pop(id(self), None)
        self._ocean._destroy_if_unused()


def view_of(frame: Frame, address: int, type_: str, shape: tuple[int, ...], descr: Any = None) -> NDArray[Any]:
    """Returns a read-only array of a frame's memory. Raises StaleFrame."""
    interface = {"version": 3, "shape": shape, "typestr": type_, "data": (address, True)}
    if descr:
        interface["descr"] = descr
    return np.asarray(_View(frame, interface))
