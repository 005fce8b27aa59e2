"""Numbers, arrays and names as arguments: conversions, and messages of one line about wrong ones."""

from __future__ import annotations

import ctypes
import math
import operator
import sys
import warnings
from decimal import Decimal
from typing import TYPE_CHECKING, Any, Iterable, Sequence

import numpy as np

from ._library import FOLDER

if TYPE_CHECKING:
    from numpy.typing import NDArray

_MAX_LENGTH = 299  # as messages of the library


def number_text(value: float) -> str:
    """Returns the shortest text of a number, as messages of the library have it: "0", "-1e-05"."""
    if isinstance(value, int) or not math.isfinite(value):
        return str(value)
    value = float(value)
    if value == 0 or 1e-4 <= abs(value) < 1e15:
        return format(Decimal(repr(value)), "f").removesuffix(".0")
    return repr(value).replace(".0e", "e")


def one_line(text: str) -> str:
    """Escapes what is not printable, and shortens the text."""
    return "".join(each if each.isprintable() else each.encode("unicode_escape").decode() for each in text)[:_MAX_LENGTH]


def invalid(name: str, value: str, accepted: str) -> str:
    """Returns "wind_speed_mps -3 is out of range (0, 60]" if `accepted` begins with an interval,
    else "seed is -1, expected ..."."""
    if accepted.startswith(("[", "(0", "(-")):
        return one_line(f"{name} {value} is out of range {accepted}")
    return one_line(f"{name} is {value}, expected {accepted}")


def number_of(value: Any, name: str) -> float:
    """Converts any number but a bool."""
    if not isinstance(value, (bool, str, bytes, bytearray)):
        try:
            return float(value)
        except OverflowError:
            raise ValueError(invalid(name, str(value), "a number")) from None
        except TypeError:
            pass
    raise TypeError(invalid(name, repr(value), "a number"))


def whole_number_of(value: Any, name: str) -> int:
    """Converts any whole number but a bool."""
    if not isinstance(value, bool):
        try:
            return operator.index(value)
        except TypeError:
            pass
    raise TypeError(invalid(name, repr(value), "a whole number"))


def identifier_of(value: Any, accepted: str) -> int:
    """Converts the number of a source or body."""
    number = whole_number_of(value, "number")
    if not 0 <= number < 2**32:
        raise ValueError(invalid("number", str(number), accepted))
    return number


def bytes_of(saved: Any, function: str) -> bytes:
    """Checks a saved state."""
    if not isinstance(saved, bytes):
        raise TypeError(invalid("saved", type(saved).__name__, f"bytes that {function}() returned"))
    return saved


def list_of(names: Sequence[str]) -> str:
    """Returns "a, b or c"."""
    return ", ".join(names[:-1]) + " or " + names[-1]


def iterable_of(given: Any, name: str, accepted: str) -> Iterable[Any]:
    """Checks that an argument can be iterated."""
    try:
        return list(given)
    except TypeError:
        raise TypeError(invalid(name, repr(given), accepted)) from None


def instance_of(cls: type, given: Any, name: str) -> Any:
    """Checks the class of an argument."""
    if not isinstance(given, cls):
        raise TypeError(invalid(name, repr(given), f"a pelagic.{cls.__name__}"))
    return given


def doubles_of(given: Any, name: str) -> NDArray[np.float64]:
    """Converts what NumPy makes an array of numbers, of any shape."""
    try:
        return np.asarray(given, np.float64)
    except (TypeError, ValueError):
        raise ValueError(f"{name} can't be made an array of numbers") from None


def rows_of(given: Any, name: str, count: int, meaning: str) -> NDArray[np.float64]:
    """As doubles_of(), with `count` numbers in each element."""
    array = doubles_of(given, name)
    if array.ndim == 0 or array.shape[-1] != count:
        raise ValueError(invalid(f"{name}.shape", str(array.shape), f"(..., {count}): {meaning}"))
    return array


def numbers_of(given: Any, name: str, count: int, meaning: str) -> list[float]:
    """Converts `count` numbers."""
    array = doubles_of(given, name)
    if array.shape != (count,):
        raise ValueError(invalid(name, repr(given), meaning))
    return array.tolist()  # type: ignore[no-any-return]


def address_of(array: NDArray[Any]) -> int | None:
    """Returns the address of a writable contiguous array; None if it is empty."""
    buffer: Any = array
    return ctypes.addressof(ctypes.c_char.from_buffer(buffer)) if array.size else None


def warn(text: str) -> None:
    """Issues a UserWarning that points at the caller of the package."""
    level, frame = 1, sys._getframe(0)
    while frame.f_back is not None and frame.f_code.co_filename.startswith(FOLDER):
        frame = frame.f_back
        level += 1
    warnings.warn(text, UserWarning, stacklevel=level)
