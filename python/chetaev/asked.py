"""Keywords as numbers of the kind that is needed, or a sentence that says which."""

from __future__ import annotations

import math
import operator
from typing import Any


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
        raise ValueError(f"{name}: a finite number of seconds that is not negative is needed, not {value}")
    return found


def whole(name: str, value: Any, least: int, greatest: int = 2**63 - 1) -> int:
    """A keyword as a whole number of a range."""
    try:
        found = operator.index(value)
    except TypeError:
        raise TypeError(f"{name}: a whole number is needed, not {value!r}") from None
    if not least <= found <= greatest:
        raise ValueError(f"{name}: a whole number from {least} to {greatest} is needed, not {found}")
    return found


def type_or_value(value: Any) -> type[Exception]:
    """What Python raises for a text that is no number, and for what can be none."""
    return ValueError if isinstance(value, str) else TypeError
