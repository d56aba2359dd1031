"""Subinterpreters of Python 3.10 and 3.11, which load what was made for one interpreter alike."""

from __future__ import annotations

from typing import Any

try:
    import _xxsubinterpreters as _own
except ImportError:
    pass
else:
    interpreters: Any = _own
    if interpreters.get_current() != interpreters.get_main():
        raise ImportError("chetaev does not support loading in subinterpreters")
