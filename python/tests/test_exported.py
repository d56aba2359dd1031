"""Equations of motion in JAX and CasADi give the rates of the compiled ones."""

from __future__ import annotations

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
