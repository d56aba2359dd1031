"""What is computed follows from the model and the options alone, and not from what was asked before."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import chetaev
from chetaev import System

MODEL = "bodies/rattleback"


def bits(system: System) -> dict[str, bytes]:
    """Numbers of a system, to the last bit."""
    f = system.compile()
    y = f.start + 0.1 * np.random.default_rng(1).normal(size=(20, len(f.state)))
    name = system.coordinates[0]
    ends = chetaev.ensemble(system, initial={name: [0.0, 0.01]}, t_end=0.5)
    return {
        "jac": f.jac(0.1, y).tobytes(),
        "rhs": f.rhs(0.1, y).tobytes(),
        "reactions": f.reactions(0.1, y).tobytes(),
        "simulate": system.simulate(t_end=0.5).y.tobytes(),
        "ensemble": b"".join(ends[own].tobytes() for own in ends.names),
        "derive": repr(system.derive("routh")).encode(),
    }


ASKED: dict[str, Callable[[System], Any]] = {
    "gibbs-appell": lambda system: system.derive("gibbs-appell"),
    "sympify": lambda system: system.sympify("pitch^2 + lean^2"),
    "functions": lambda system: [system.compile().definitions, system.compile().mass_matrix],
    "twice": bits,
}


@pytest.fixture(scope="module")
def fresh() -> dict[str, bytes]:
    return bits(System.from_gallery(MODEL))


@pytest.mark.parametrize("asked", ASKED)
def test_bits_do_not_depend_on_what_was_asked(asked: str, fresh: dict[str, bytes]) -> None:
    system = System.from_gallery(MODEL)
    ASKED[asked](system)
    assert bits(system) == fresh


def test_functions_do_not_depend_on_their_order() -> None:
    first, second = System.from_gallery(MODEL).compile(), System.from_gallery(MODEL).compile()
    y = first.start + 0.1
    names = ["jac", "mass_matrix", "reactions", "residuals", "definitions"]
    one = {name: getattr(first, name)(0.0, y).tobytes() for name in names}
    other = {name: getattr(second, name)(0.0, y).tobytes() for name in reversed(names)}
    assert one == other
