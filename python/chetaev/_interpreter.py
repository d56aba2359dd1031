"""Refuses subinterpreters: what the native part makes of its classes belongs to one interpreter of a process.

Python refuses by itself only interpreters with a lock of their own, and those from 3.12 on; those that share the lock load everything.
"""

from __future__ import annotations

import importlib


def is_main() -> bool:
    """Whether this is the main interpreter of its process; so it is where Python has nothing that makes others."""
    for name in ("_interpreters", "_xxsubinterpreters"):
        try:
            own = importlib.import_module(name)
        except ImportError:
            continue
        return bool(own.get_current() == own.get_main())
    return True


if not is_main():
    raise ImportError("chetaev does not support loading in subinterpreters")
