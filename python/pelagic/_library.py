"""Loads the shared library and converts its errors."""

from __future__ import annotations

import ctypes
import os
import re
import sys
from typing import Any

from . import _native as c

FOLDER = os.path.dirname(os.path.abspath(__file__))
_FILE = {"win32": "pelagic.dll", "darwin": "libpelagic_c.dylib"}.get(sys.platform, "libpelagic_c.so")


class StaleFrame(RuntimeError):
    """The frame's memory belongs to a later frame."""


StaleFrame.__module__ = "pelagic"


def _load(loader: Any) -> ctypes.CDLL:
    try:
        return c.load(os.path.join(FOLDER, _FILE), loader)
    except OSError as error:
        raise ImportError(str(error)) from error


library = _load(ctypes.CDLL)
# For functions that return at once: these calls keep the interpreter lock, which busy threads take
# milliseconds to return.
quick_library = _load(ctypes.PyDLL)

# Names of C in messages, and those of Python.
_NAMES = [(r"^(dynamic_waves|shore|spray)\.", ""), (r"pelagic_ocean_options\.textures_only", "planes=False"),
          (r"pelagic_ocean_options\.(\w+)", r"\1=True"), (r"pelagic_water_frame\.", ""),
          (r"\(0, 30\], or 0: derived", "[0, 30], or -1: chosen"), (r"\(0, 10\], or 0: derived", "[0, 10], or -1: derived")]
_ERRORS = {c.PELAGIC_INVALID_ARGUMENT: ValueError, c.PELAGIC_OUT_OF_MEMORY: MemoryError}


def last_message() -> str:
    """Returns the message of this thread's last error, with the names of Python."""
    text: str = library.pelagic_last_error().decode("utf-8", "replace")
    for of_c, ours in _NAMES:
        text = re.sub(of_c, ours, text)
    return text


def error_of(status: int) -> Exception:
    """Returns the exception of a status that is not PELAGIC_OK."""
    return _ERRORS.get(status, RuntimeError)(last_message())


def call(function: Any, *arguments: Any) -> None:
    """Calls a function of the library. Raises its error."""
    status = function(*arguments)
    if status:
        raise error_of(status)


def saved_by(function: Any, handle: Any) -> bytes:
    """Returns what a function saves that takes a handle, room and count."""
    count = ctypes.c_size_t()
    call(function, handle, None, 0, ctypes.byref(count))
    saved = ctypes.create_string_buffer(count.value)
    call(function, handle, saved, count, ctypes.byref(count))
    return saved.raw


def version() -> str:
    """Returns the version of the library: "1.0.0"."""
    number = library.pelagic_version()
    return f"{number // 10000}.{number // 100 % 100}.{number % 100}"


def isas_here() -> list[str]:
    """Returns the instruction sets that this processor supports, weakest first."""
    names: list[str] = []
    while name := library.pelagic_isa_at(len(names)):
        names.append(name.decode())
    return names
