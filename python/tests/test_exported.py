"""Equations of motion in JAX and CasADi give the rates of the compiled ones."""

from __future__ import annotations

import keyword
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from chetaev import System

MODELS = ["chaplygin-sleigh", "heavy-top", "snakeboard"]


def rates(path: Path) -> tuple[Any, Any, Any]:
    """A function of NumPy, a state, parameters: what the same text gives there."""
    space: dict[str, Any] = {}
    exec(System.from_file(path).derive("reduced").to("python"), space)
    return space["rhs"], space["start"] + 0.01 * np.arange(1, len(space["start"]) + 1), space["parameters"]


@pytest.mark.parametrize("name", MODELS)
def test_jax(name: str, gallery: Path) -> None:
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    path = gallery / name / "model.toml"
    ours, y, p = rates(path)
    found = System.from_file(path).to_jax()
    assert list(found.parameters.values()) == list(p)
    assert len(found.state) == len(y)
    np.testing.assert_allclose(jax.jit(found.rhs)(0.0, y, p), ours(0.0, y, p), rtol=1e-12, atol=1e-14)
    # Exact derivatives against central differences.
    slopes = jax.jacfwd(found.rhs, argnums=1)(0.0, y, p)
    step = 1e-6
    for k in range(len(y)):
        by = np.zeros_like(y)
        by[k] = step
        central = (ours(0.0, y + by, p) - ours(0.0, y - by, p)) / (2 * step)
        np.testing.assert_allclose(slopes[:, k], central, rtol=1e-6, atol=1e-7)
    many = jax.vmap(found.rhs, in_axes=(None, 0, None))(0.0, np.stack([y, 2 * y]), p)
    np.testing.assert_allclose(many[1], ours(0.0, 2 * y, p), rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("name", MODELS)
def test_casadi(name: str, gallery: Path) -> None:
    casadi = pytest.importorskip("casadi")
    path = gallery / name / "model.toml"
    ours, y, p = rates(path)
    found = System.from_file(path).to_casadi()
    state, known = casadi.SX.sym("y", len(y)), casadi.SX.sym("p", len(p))
    function = casadi.Function("f", [state, known], [found.rhs(0, state, known)])
    np.testing.assert_allclose(np.array(function(y, p)).ravel(), ours(0.0, y, p), rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("name", MODELS)
def test_residuals_for_opty_vanish_along_the_motion(name: str, gallery: Path) -> None:
    sympy = pytest.importorskip("sympy")
    path = gallery / name / "model.toml"
    ours, y, p = rates(path)
    found = System.from_file(path).to_opty()
    names = System.from_file(path).to_casadi().state
    assert found.equations.shape == (len(found.states), 1) and len(found.states) == len(y)
    assert [own.func.__name__.replace("_dot", "'") for own in found.states] == names
    moving = {own.diff(found.time): value for own, value in zip(found.states, ours(0.0, y, p), strict=True)}
    state = dict(zip(found.states, y, strict=True))
    left = found.equations.xreplace(moving).xreplace(state).xreplace(found.parameters).xreplace({found.time: 0})
    np.testing.assert_allclose(np.array(left, dtype=float), 0, atol=1e-10)
    assert all(isinstance(own, sympy.Symbol) for own in found.parameters)


def value(expression: Any, known: dict[Any, float], values: dict[Any, float]) -> float:
    """The number that an expression is, part by part."""
    import math

    from chetaev.trees import nodes

    for own in nodes([expression]):
        if own in known:
            values[own] = known[own]
        elif own in values:
            continue
        elif own.is_Number or own.is_NumberSymbol:
            values[own] = float(own)
        elif own.is_Add:
            values[own] = math.fsum(values[part] for part in own.args)
        elif own.is_Mul:
            values[own] = math.prod(values[part] for part in own.args)
        elif own.is_Pow:
            values[own] = values[own.base] ** values[own.exp]
        elif own.is_Function and not hasattr(own.func, "_undef_sympify"):
            function = getattr(math, own.func.__name__, None)
            if function is not None and all(part in values for part in own.args):
                values[own] = function(*(values[part] for part in own.args))
    return values[expression]


@pytest.mark.parametrize("name", ["whipple-bicycle", "trailer"])
def test_residuals_vanish_along_a_motion_with_its_multipliers(name: str) -> None:
    """The motion is integrated from the solved equations; the residuals have been derived with the multipliers in them."""
    system = System.from_gallery(name)
    found = system.to_opty()
    assert found.equations.shape == (len(found.states) + len(found.unknowns), 1)
    assert len(found.unknowns) == {"whipple-bicycle": 5, "trailer": 4}[name]
    motion = system.simulate(t_end=1, tolerance=1e-12)
    largest = 0.0
    for row in np.linspace(0, len(motion) - 1, 5, dtype=int):
        known: dict[Any, float] = {found.time: float(motion.t[row]), **found.parameters}
        for own in found.states:
            column = own.func.__name__
            column = f"{column.removesuffix('_dot')}'" if column.endswith("_dot") else column
            known |= {own: float(motion[column][row]), own.diff(found.time): float(motion[f"{column}'"][row])}
        known |= {own: float(motion[own.func.__name__][row]) for own in found.unknowns}
        parts: dict[Any, float] = {}
        left = [value(own, known, parts) for own in found.equations]
        largest = max(largest, max(map(abs, left)))
        # The test can fail: another acceleration is none of the motion.
        speed = found.states[-1].diff(found.time)
        other = [value(own, known | {speed: known[speed] + 1}, {}) for own in found.equations]
        assert max(map(abs, other)) > 1e-3
    assert largest < 1e-8


def test_the_form_is_regular_where_the_motion_starts() -> None:
    """The shortest equations of the trailer divide by what vanishes at its start; another form is taken, and gives the rates of the compiled ones."""
    pytest.importorskip("jax").config.update("jax_enable_x64", True)
    system = System.from_gallery("trailer")
    found = system.to_jax()
    rates = np.asarray(found.rhs(0.0, found.start, found.p))
    assert np.all(np.isfinite(rates))
    f = system.compile()
    expected = dict(zip(f.state, f.rhs(f.t_start, f.start)))
    for name, rate in zip(found.state, rates, strict=True):
        if name in expected:
            assert abs(rate - expected[name]) < 1e-9, name
    assert set(system.coordinates) <= set(found.state)


def test_functions_and_residuals_are_shown(gallery: Path) -> None:
    sleigh = System.from_file(gallery / "chaplygin-sleigh" / "model.toml")
    pytest.importorskip("casadi")
    function = sleigh.to_casadi()._repr_mimebundle_()["text/html"]
    assert "<td" in function and "def rhs" in function
    residuals = sleigh.to_opty()._repr_mimebundle_()
    assert "&= 0" in residuals["text/latex"] and "vanishes along the motion" in residuals["text/html"]


@pytest.mark.parametrize("form", ["maggi", "volterra-first", "volterra-second"])
def test_the_start_is_on_the_branch_that_simulate_follows(form: str) -> None:
    """Gauss's principle takes the acceleration along the spring: x'' = alpha cos(theta) = -alpha at x = 1, y = 0, so theta = pi."""
    found = System.from_gallery("fixed-acceleration").derive(form).to("python")
    space: dict[str, Any] = {}
    exec(found, space)
    np.testing.assert_allclose(space["start"], [1, 0, 0, 0.8, np.pi], atol=1e-9)
    rates = space["rhs"](0.0, space["start"], space["parameters"])
    np.testing.assert_allclose(rates[2:4], [-1.5, 0], atol=1e-9)


def test_the_start_of_jax_is_that_of_simulate() -> None:
    pytest.importorskip("jax")
    system = System.from_gallery("fixed-acceleration")
    found = system.to_jax()
    assert found.formulation == "maggi" and found.state[-1] == "theta"
    assert found.start[-1] == pytest.approx(np.pi, abs=1e-9)
    written = system.derive("maggi").to("c")
    line = next(own for own in written.splitlines() if "at the start" in own)
    assert "z = (0.0, 0.8, 3.14159265" in line


def test_what_the_model_does_not_determine_has_no_start() -> None:
    """The multiplier of an extremum is data of its own: stated, or no number; the velocities are known either way."""
    system = System.from_gallery("particle-y-dx")
    for own, kappa in [(system, np.nan), (system.with_initial({"kappa_rolling": 0.5}), 0.5)]:
        space: dict[str, Any] = {}
        exec(own.derive("vakonomic").to("python"), space)
        # z' = y x'
        np.testing.assert_allclose(space["start"], [0, 0.4, 0, 0.8, 1.1, 0.4 * 0.8, kappa])


def test_names_may_be_words_of_python() -> None:
    """Oscillators a_i = -k x_i/m_i whose coordinates, masses and stiffness are called as Python's keywords and what the text itself calls."""
    words = [*keyword.kwlist, "float", "np", "dy"]
    half = len(words) // 2
    coordinates, masses, stiffness = words[:half], words[half : 2 * half], "k"
    masses_of = {name: 1 + at for at, name in enumerate(masses)}
    system = System(
        "words",
        coordinates=coordinates,
        parameters={**masses_of, stiffness: 3},
        kinetic=" + ".join(f"1/2 {m} {x}'^2" for x, m in zip(coordinates, masses)),
        potential=" + ".join(f"1/2 {stiffness} {x}^2" for x in coordinates),
        initial={x: 0.1 * (at + 1) for at, x in enumerate(coordinates)},
    )
    places = 0.1 * np.arange(1, half + 1)
    expected = np.concatenate([np.zeros(half), -3 * places / np.arange(1, half + 1)])
    space: dict[str, Any] = {}
    exec(system.derive("reduced").to("python"), space)
    np.testing.assert_allclose(space["rhs"](0.0, space["start"], space["parameters"]), expected, rtol=1e-14)
    pytest.importorskip("casadi")
    found = system.to_casadi()
    assert found.state == [*coordinates, *(f"{x}'" for x in coordinates)] and list(found.parameters) == [*masses, stiffness]
    np.testing.assert_allclose(np.array(found.rhs(0.0, found.start, found.p)).ravel(), expected, rtol=1e-14)
    pytest.importorskip("sympy")
    equations = system.derive("routh")[0].to_sympy()
    assert sum(map(len, equations.values())) >= half


def test_names_may_be_words_of_matlab_and_julia() -> None:
    words = ["try", "using", "switch", "parfor", "persistent", "where", "classdef", "endif", "baremodule"]
    system = System(
        "words", coordinates=["x"], parameters=words, kinetic="1/2 x'^2", potential=" + ".join(f"{own} x^{at + 1}" for at, own in enumerate(words)),
    )
    derived = system.derive("reduced")
    for notation in ("python", "matlab", "julia"):
        inside = derived.to(notation).partition("rhs")[2]
        assigned = re.findall(r"^    (\w+) = p[\[(]", inside, re.MULTILINE)
        assert assigned == [f"{own}_" for own in words], notation
