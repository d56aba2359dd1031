"""Where motions start: one state, for the command, for compiled functions and for exported text."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import chetaev
from chetaev import System

#: Models in which guesses, constraints or laws of masses make the start another than what stands in the file.
HARD = [
    "bodies/four-bar", "bodies/slider-crank", "bodies/ball-in-bowl", "falling-rolling-disc", "rattleback", "sphere-on-turntable", "leaking-pendulum",
    "sand-cart", "trailer", "chaplygin-sleigh", "snakeboard",
]


def text_of(system: System) -> Any:
    space: dict[str, Any] = {}
    exec(system.derive("reduced").to("python"), space)
    return space


@pytest.mark.parametrize("name", HARD)
def test_the_start_is_that_of_the_motion(name: str) -> None:
    system = System.from_gallery(name)
    f = system.compile()
    motion = system.simulate(t_end="1/100" if f.t_start == 0 else None)
    wanted = [motion[own][0] for own in f.state]
    np.testing.assert_allclose(f.start, wanted, rtol=1e-12, atol=1e-12)
    # It is admissible.
    np.testing.assert_allclose(f.residuals(f.t_start, f.start), 0, atol=1e-9)


@pytest.mark.parametrize("name", HARD)
def test_the_start_of_exported_text_has_the_rates_of_the_motion(name: str) -> None:
    system = System.from_gallery(name)
    f, space = system.compile(), text_of(system)
    start = space["start"]
    assert np.all(np.isfinite(start))
    n = len(system.coordinates)
    np.testing.assert_allclose(start[:n], f.start[:n], rtol=1e-12, atol=1e-12)
    if name == "trailer":
        # Its shortest form is singular where it starts.
        return
    # Coordinates move as they do there, whatever the other variables of the state are.
    found = space["rhs"](f.t_start, start, space["parameters"])[:n]
    np.testing.assert_allclose(found, f.rhs(f.t_start, f.start)[:n], rtol=1e-8, atol=1e-9)


def test_other_programs_start_there() -> None:
    system = System(
        "bead",
        coordinates=["x", "y"],
        kinetic="1/2 (x'^2 + y'^2)",
        potential="y",
        constraints={"line": "y = 2 x"},
        initial={"x": 3, "x'": 1},
    )
    # By hand: y = 2 x, y' = 2 x'.
    np.testing.assert_allclose(system.compile().start, [3, 6, 1, 2], rtol=1e-14)
    assert "q = (3.0, 6.0)" in system.derive("reduced").to("c")
    for word in ("python", "matlab", "julia"):
        assert "3.0, 6.0" in system.derive("reduced").to(word)


def test_solve_ivp_takes_it_as_typed() -> None:
    f = System.from_gallery("chaplygin-sleigh").compile()
    solution = solve_ivp(f.rhs, (0, 10), f.start)
    assert solution.success and solution.y.shape[0] == len(f.state)


def test_a_control_without_a_law_does_not_hinder_the_start() -> None:
    system = System("a", coordinates=["x"], kinetic="1/2 x'^2", controls={"u": {}}, forces={"x": "u"}, initial={"x'": 2})
    np.testing.assert_array_equal(text_of(system)["start"], [0, 2])


def test_where_no_start_is_known_it_is_said() -> None:
    system = System(
        "line", coordinates=["x", "y"], parameters={"a": {}}, kinetic="1/2 (x'^2 + y'^2)", constraints={"line": "y = a x"}, initial={"x": 1}
    )
    text = system.derive("reduced").to("python")
    assert "is not known (" in text and "`a`" in text
    assert np.all(np.isnan(text_of(system)["start"]))


def test_initial_values_are_a_keyword() -> None:
    sleigh = System.from_gallery("chaplygin-sleigh")
    other = sleigh.with_initial({"phi'": 2, "phi": "1/3"})
    assert other.initial["phi'"] == "2" and other != sleigh and other == sleigh.with_initial({"phi'": 2, "phi": "1/3"})
    motion = sleigh.simulate(initial={"phi'": 2, "phi": "1/3"}, t_end=1)
    assert motion["phi'"][0] == 2 and motion["phi"][0] == 1 / 3
    # The record is of that motion: it is repeated with the same values.
    assert chetaev.verify(other.study(claims="energy.integral", t_end=1)).agrees
    plain = System("free", coordinates=["x"], kinetic="1/2 x'^2").with_initial({"x'": 3})
    assert plain.simulate(t_end=1)["x"][-1] == pytest.approx(3, rel=1e-12)
    with pytest.raises(chetaev.ModelError, match="speed"):
        sleigh.with_initial({"speed": 1})
