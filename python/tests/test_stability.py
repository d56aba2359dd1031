"""Eigenvalues of linear equations against NumPy's, on random systems."""

from __future__ import annotations

import os
import random
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
import sympy as sp

import chetaev
from chetaev import System

# All of it in a full run, as the long tests in Rust.
COUNT = 200 if os.environ.get("CHETAEV_TESTS") == "full" else 20


def model(seed: int) -> str:
    """Three coordinates at rest at the origin: masses that vary, gyroscopic, dissipative and circulatory forces, now and then a constraint."""
    own = random.Random(seed)

    def number(low: int, high: int) -> str:
        return f"({own.randint(20 * low, 20 * high)}/20)"

    constraint = ""
    if seed % 3:
        constraint = f'[constraints]\nlink = "z\' = ({number(-2, 2)} y + {number(-1, 1)} z) x\' + {number(-2, 2)} y\'"\n'
    stiffness = (1, 4) if seed % 2 else (-4, -1)
    return (
        f'name = "random-{seed}"\ncoordinates = ["x", "y", "z"]\n[lagrangian]\n'
        f"T = \"1/2 ({number(1, 3)} x'^2 + {number(1, 3)} y'^2 + {number(1, 3)} z'^2) + {number(-1, 1)} y x' y' + {number(-1, 1)} sin(x) y' z'\"\n"
        f'V = "1/2 ({number(*stiffness)} x^2 + {number(1, 4)} y^2 + {number(1, 4)} z^2) + {number(-1, 1)} x y^2 + {number(0, 1)} (1 - cos(x + z))"\n'
        f"[forces]\nx = \"{number(-2, 2)} y' - {number(0, 2)} x' + {number(-1, 1)} y\"\n"
        f"y = \"{number(-2, 2)} x' - {number(0, 2)} y'\"\n{constraint}"
        "[steady.rest]\nx = 0\ny = 0\nz = 0\n\"x'\" = 0\n\"y'\" = 0\n\"z'\" = 0\n"
    )


@pytest.mark.parametrize("seed", range(COUNT))
def test_eigenvalues_are_those_of_numpy(seed: int) -> None:
    linear = System.from_text(model(seed)).linearize()
    E, F = linear.to_sympy()
    assert not (E.free_symbols | F.free_symbols)
    expected = np.linalg.eigvals(np.array(E.LUsolve(F), dtype=float))
    values = linear.eigenvalues
    assert values is not None
    found = [complex(own) for own in np.asarray(values).ravel()]
    assert len(found) == len(expected)
    # Multiple eigenvalues move as a root of the rounding; each is matched with the nearest that is left.
    size = max(1.0, float(max(abs(expected))))
    for own in expected:
        nearest = min(found, key=lambda other: abs(other - own))
        assert abs(nearest - own) < 1e-6 * size, (seed, own, found)
        found.remove(nearest)
    # Each is a zero of the exact characteristic polynomial, to rounding of its terms; zero itself has the rounding of its neighbours.
    symbol = sp.Symbol("lambda")
    polynomial = sp.Poly((symbol * E - F).det(), symbol)
    coefficients = [float(own) for own in polynomial.all_coeffs()]
    for own in values:
        radius = max(abs(own), 1e-3 * size)
        bound = sum(abs(c) * radius**k for k, c in enumerate(reversed(coefficients)))
        assert abs(np.polyval(coefficients, own)) <= 1e-10 * bound, (seed, own)


@pytest.mark.parametrize("seed", range(COUNT))
def test_all_variables_have_the_same_eigenvalues_by_scipy(seed: int) -> None:
    """E z' = A z in coordinates, velocities and multipliers: the finite eigenvalues of the pencil, by LAPACK's QZ method, are those of independent
    variables, and the multipliers add infinite ones only."""
    linalg = pytest.importorskip("scipy.linalg")
    linear = System.from_text(model(seed)).linearize(all=True)
    every = linear.to_dict()["all"]
    A, E = (np.array([[float(sp.Rational(own)) for own in row] for row in every[name]]) for name in "AE")
    found = linear.eigenvalues
    assert found is not None
    expected = [complex(own) for own in np.asarray(found).ravel()]
    alpha, beta = linalg.eigvals(A, E, homogeneous_eigvals=True)
    # Multipliers of a constraint of velocities have index two: two infinite eigenvalues for each, a root of the rounding away from infinity.
    finite = [a / b for a, b in zip(alpha, beta) if abs(b) > 1e-5 * abs(a)]
    constraints = sum(own.startswith("lambda_") for own in every["variables"])
    assert len(finite) == len(expected) == len(A) - 2 * constraints, (seed, finite, expected)
    size = max(1.0, max(abs(own) for own in expected))
    for own in expected:
        nearest = min(finite, key=lambda other: abs(other - own))
        assert abs(nearest - own) < 1e-6 * size, (seed, own, finite)
        finite.remove(nearest)


def test_a_buckled_pendulum_is_found_in_numbers() -> None:
    """An inverted pendulum on a torsion spring: 9.81 sin θ = 5 θ has three zeros, which are no polynomial's."""
    from scipy.optimize import brentq

    buckled = System.from_text(
        'name = "buckled"\ncoordinates = ["th"]\n[lagrangian]\nL = "1/2 th\'^2 - 981/100 cos(th) - 5/2 th^2"\n[initial]\nth = 0.1\n"th\'" = 0\n'
    )
    found = buckled.steady()
    assert not found.complete
    aside = brentq(lambda x: 9.81 * np.sin(x) - 5 * x, 1, 3, xtol=1e-14)
    places = sorted(float(own["values"]["th"]) for own in found.to_sympy().values())
    assert places == pytest.approx([-aside, 0, aside], abs=1e-10)
    assert {own["stability"] for own in found.motions} == {"unstable", "linearly on the border"}
    assert "1.873" in found._repr_mimebundle_()["text/html"]
    assert "1.873" in found.to_latex()
    assert System.from_gallery("double-pendulum").steady().complete


def test_linear_equations_along_a_motion_are_arrays() -> None:
    """Beside a motion nearby the transition matrix takes the difference at the start to the one at the end, up to its square."""
    sleigh = System.from_gallery("chaplygin-sleigh")
    found = sleigh.along()
    count = len(found.variables)
    assert found.A.shape == found.transition.shape == (len(found.times), count, count)
    assert np.allclose(found.transition[0], np.eye(count))
    # The sleigh starts with u = 0 and w = W.
    assert found.variables == ["u", "w"]
    step = Fraction(1, 10**4)
    ends = [sleigh.with_values(W=Fraction(21, 10) + sign * step).along().state[-1] for sign in (1, -1)]
    slope = (ends[0] - ends[1]) / (2 * float(step))
    assert slope == pytest.approx(found.transition[-1][:, 1], abs=1e-7)
    shown = found._repr_mimebundle_()["text/html"]
    assert "exponent 1" in shown and "A(0)" in shown


@pytest.mark.parametrize(
    ("asked", "what"),
    [
        (lambda system: system.sensitivity("k", [0.0, 1.0]), "sensitivities"),
        (lambda system: system.along(), "linear equations along a motion"),
        (lambda system: system.follow(orbit=True, period="1"), "periodic orbits"),
    ],
    ids=["sensitivity", "along", "orbit"],
)
def test_what_constraints_of_higher_order_have_not_is_called_by_its_name(asked: Any, what: str) -> None:
    with pytest.raises(chetaev.OptionError, match=f"^{what} are computed for constraints on velocities; this system has constraints of order 2"):
        asked(System.from_gallery("fixed-acceleration"))
