"""Keywords as numbers of the kind that is needed, or a sentence that says which."""

from __future__ import annotations

import math
import operator
from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

from .errors import OptionError

_Word = TypeVar("_Word")


def number(name: str, value: Any) -> float:
    """A keyword as a number."""
    if isinstance(value, bool):
        raise TypeError(f"{name}: a number is needed, not a truth value")
    try:
        return float(value)
    except (TypeError, ValueError):
        raise type_or_value(value)(f"{name}: a number is needed, not {value!r}") from None


def seconds(name: str, value: Any) -> float:
    """A keyword as a time that can be waited."""
    found = number(name, value)
    if not (math.isfinite(found) and found >= 0):
        raise OptionError(f"{name}: a finite number of seconds that is not negative is needed, not {value}")
    return found


def whole(name: str, value: Any, least: int, greatest: int = 2**63 - 1) -> int:
    """A keyword as a whole number of a range."""
    try:
        found = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: a whole number is needed, not {value!r}") from None
    if not least <= found <= greatest:
        raise OptionError(f"{name}: a whole number from {least} to {greatest} is needed, not {found}")
    return found


def flag(name: str, value: Any) -> bool:
    """A keyword as a truth value; no text is one, as ``"False"`` would be taken for true."""
    if isinstance(value, (bool, int)) or type(value).__name__ in ("bool_", "bool"):
        return bool(value)
    raise TypeError(f"{name}: True or False is needed, not {value!r}")


def type_or_value(value: Any) -> type[Exception]:
    """What Python raises for a text that is no number, and for what can be none."""
    return OptionError if isinstance(value, str) else TypeError


def word(name: str, value: _Word) -> _Word:
    """A keyword as a text, or none."""
    if value is not None and not isinstance(value, str):
        raise TypeError(f"{name}: a text is needed, not {value!r}")
    return value


def listed(name: str, value: Any) -> list[str]:
    """A keyword as a list of texts, of which one needs no list."""
    found = [value] if isinstance(value, str) or not isinstance(value, Iterable) else list(value)
    if not all(isinstance(own, str) for own in found):
        raise TypeError(f"{name}: a text, or a list of texts, is needed, not {value!r}")
    return found


def words(name: str, value: Any) -> str | None:
    """A keyword as one text, or several joined by commas."""
    return None if value is None else ",".join(listed(name, value))


def mapping(name: str, value: Any) -> Mapping[Any, Any]:
    """A keyword as a mapping; an empty one where there is none."""
    if value is None:
        return {}
    if not isinstance(value, Mapping):
        raise TypeError(f"{name}: a mapping from names to values is needed, not {type(value).__name__}")
    return value
