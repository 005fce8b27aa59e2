"""Reports wrong arguments of calls with one line that names them."""

import functools
import inspect
from typing import Any, Callable, Dict, Optional, Tuple

from ._structs import nearest_hint

_EMPTY = inspect.Parameter.empty


def _listed(names: Tuple[str, ...]) -> str:
    return ", ".join(names[:-1]) + " and " + names[-1] if len(names) > 1 else names[0]


def _reason(name: str, signature: inspect.Signature, args: Tuple[Any, ...], kwargs: Dict[str, Any]) -> Optional[str]:
    """Returns the reason why the arguments do not fit the signature, or None if they do."""
    try:
        signature.bind(*args, **kwargs)
        return None
    except TypeError:
        pass
    known = list(signature.parameters.values())
    by_place = [p.name for p in known if p.kind is not inspect.Parameter.KEYWORD_ONLY]
    names = [p.name for p in known if p.name != "self"]
    given = set(by_place[:len(args)]) | set(kwargs)
    missing = tuple(p.name for p in known if p.default is _EMPTY and p.name not in given)
    unknown = tuple(key for key in kwargs if key not in names)
    reasons = []
    if missing:
        reasons.append(f"needs {_listed(missing)}")
    for key in unknown:
        reasons.append(f"has no argument {key}{nearest_hint(key, names)}")
    for key in kwargs:
        if key in by_place[:len(args)]:
            reasons.append(f"is given {key} twice")
    if len(args) > len(by_place):
        reasons.append(f"takes at most {len(by_place) - 1} without a name")
    return f"{name}() " + ", and ".join(reasons)


def _explained(function: Callable[..., Any], name: str, qualified: str) -> Callable[..., Any]:
    """Returns the method with a signature for inspect, and a TypeError that names missing or
    unknown arguments."""
    native = inspect.signature(function)
    this = inspect.Parameter("self", inspect.Parameter.POSITIONAL_ONLY)
    signature = native.replace(parameters=[this, *(p for p in native.parameters.values() if p.name != "self")])

    @functools.wraps(function)
    def call(*args: Any, **kwargs: Any) -> Any:
        try:
            return function(*args, **kwargs)
        except TypeError:
            reason = _reason(name, signature, args, kwargs)
            if reason is None:
                raise
        raise TypeError(reason)

    setattr(call, "__signature__", signature)
    call.__qualname__ = qualified
    return call


def explain(*classes: type) -> None:
    """Replaces the constructor and the methods of each class."""
    for cls in classes:
        for name, method in list(vars(cls).items()):
            is_method = callable(method) and not isinstance(method, type)
            if name == "__init__":
                setattr(cls, name, _explained(method, cls.__name__, f"{cls.__name__}.{name}"))
            elif is_method and not name.startswith("_"):
                setattr(cls, name, _explained(method, name, f"{cls.__name__}.{name}"))
