"""Equations as functions over arrays, against solutions derived by hand and by other means."""

from __future__ import annotations

import pickle
import threading
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from chetaev import ModelError, System

RNG = np.random.default_rng(7)


@pytest.fixture(scope="module")
def skate() -> System:
    """A skate on an inclined plane; its motion is known in closed form (Neimark, Fufaev 1972)."""
    return System(
        "skate",
        coordinates=["x", "y", "phi"],
        parameters={"m": 1.2, "J": 0.3, "gs": 4},
        kinetic="1/2 m (x'^2 + y'^2) + 1/2 J phi'^2",
        potential="-m gs x",
        constraints={"blade": "x' sin(phi) = y' cos(phi)"},
        initial={"phi'": 1.3},
        simulation={"t_end": 2},
    )


def pendulum(**parameters: float) -> System:
    return System(
        "pendulum",
        coordinates=["th"],
        parameters={"l": 1.5, "g": 9.81, **parameters},
        kinetic="1/2 l^2 th'^2",
        potential="-g l cos(th)",
    )


def by_hand(y: np.ndarray, gs: float = 4.0) -> np.ndarray:
    """Accelerations of the skate: along the blade gs cos φ, across it v φ'."""
    phi, vx, vy, w = y[..., 2], y[..., 3], y[..., 4], y[..., 5]
    along = vx * np.cos(phi) + vy * np.sin(phi)
    rate = gs * np.cos(phi)
    ax = rate * np.cos(phi) - along * np.sin(phi) * w
    ay = rate * np.sin(phi) + along * np.cos(phi) * w
    return np.stack([vx, vy, w, ax, ay, 0 * w], axis=-1)


def admissible(*shape: int) -> np.ndarray:
    y = RNG.normal(size=(*shape, 6))
    u = RNG.normal(size=shape)
    y[..., 3], y[..., 4] = u * np.cos(y[..., 2]), u * np.sin(y[..., 2])
    return y


def test_rates_are_those_derived_by_hand(skate: System) -> None:
    f = skate.compile()
    assert f.state == ["x", "y", "phi", "x'", "y'", "phi'"]
    y = admissible()
    np.testing.assert_allclose(f.rhs(0.0, y), by_hand(y), rtol=1e-13, atol=1e-13)
    for shape in [(1,), (5,), (32,), (33,), (100,), (4, 7), (2, 3, 4), (0,)]:
        y = admissible(*shape)
        found = f(y)
        assert found.shape == y.shape
        np.testing.assert_allclose(found, by_hand(y), rtol=1e-13, atol=1e-13)
        # A state has the same bits alone and among others.
        for one, values in zip(y.reshape(-1, 6), found.reshape(-1, 6), strict=True):
            np.testing.assert_array_equal(f.rhs(0.0, one), values)


def test_arrays_of_any_layout_are_taken(skate: System) -> None:
    f = skate.compile()
    y = admissible(40)
    expected = f(y)
    np.testing.assert_array_equal(f(np.asfortranarray(y)), expected)
    np.testing.assert_array_equal(f(np.repeat(y, 2, axis=0)[::2]), expected)
    np.testing.assert_array_equal(f(y.tolist()), expected)
    np.testing.assert_array_equal(f(y[::-1])[::-1], expected)
    np.testing.assert_array_equal(f.rhs(0.0, y[0, ::-1].copy()[::-1]), expected[0])
    single = f(y.astype(np.float32))
    np.testing.assert_allclose(single, expected, rtol=1e-5, atol=1e-5)
    for wrong in (np.zeros(5), np.zeros((3, 7)), 1.0):
        with pytest.raises(ValueError, match="6 components"):
            f(wrong)


def test_values_are_written_where_they_are_wanted(skate: System) -> None:
    f = skate.compile()
    y = admissible(40)
    out = np.full((40, 6), np.nan)
    assert f(y, out=out) is out
    np.testing.assert_array_equal(out, f(y))
    row = np.full(6, np.nan)
    assert f.rhs(0.0, y[3], row) is row
    np.testing.assert_array_equal(row, out[3])
    for wrong in (np.zeros(5), np.zeros((40, 6), dtype=np.float32), np.zeros((6, 40)).T, [0.0] * 6):
        with pytest.raises((TypeError, ValueError), match="out is"):
            f(y, out=wrong)
    jacobian = np.zeros((40, 6, 6))
    assert f.jac(0.0, y, jacobian) is jacobian


def test_derivatives_are_those_of_differences(skate: System) -> None:
    f = skate.compile()
    y, h = admissible(), 1e-6
    exact = f.jac(0.0, y)
    steps = np.eye(6) * h
    differences = np.stack([(f(y + d) - f(y - d)) / (2 * h) for d in steps], axis=-1)
    np.testing.assert_allclose(exact, differences, rtol=1e-7, atol=1e-7)
    assert f.jac(0.0, admissible(3, 2)).shape == (3, 2, 6, 6)


def test_reactions_and_mass_are_those_of_newton(skate: System) -> None:
    f = skate.compile()
    y = admissible(20)
    np.testing.assert_allclose(f.mass_matrix(0.0, y), np.tile(np.diag([1.2, 1.2, 0.3]), (20, 1, 1)), rtol=1e-15)
    # The force across the blade is m (v φ' + gs sin φ); the constraint is (sin φ, −cos φ), so it points the other way.
    phi, w = y[:, 2], y[:, 5]
    along = y[:, 3] * np.cos(phi) + y[:, 4] * np.sin(phi)
    across = 1.2 * (along * w + 4 * np.sin(phi))
    np.testing.assert_allclose(np.abs(f.reactions(0.0, y)[:, 0]), np.abs(across), rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(f.residuals(0.0, y), 0.0, atol=1e-14)


def test_scipy_integrates_them(skate: System) -> None:
    f = skate.compile()
    y0 = np.array([0, 0, 0, 0, 0, 1.3])
    found = solve_ivp(f.rhs, (0, 2), y0, method="DOP853", rtol=1e-11, atol=1e-12)
    w, gs, t = 1.3, 4.0, 2.0
    x = gs / w * (1 - np.cos(2 * w * t)) / (4 * w)
    y = gs / (2 * w) * (t - np.sin(2 * w * t) / (2 * w))
    np.testing.assert_allclose(found.y[:2, -1], [x, y], rtol=1e-9)
    ours = skate.simulate()
    np.testing.assert_allclose([ours["x"][-1], ours["y"][-1]], [x, y], rtol=1e-8)
    stiff = solve_ivp(f.rhs, (0, 2), y0, method="Radau", jac=f.jac, rtol=1e-9, atol=1e-10)
    np.testing.assert_allclose(stiff.y[:2, -1], [x, y], rtol=1e-6)


def test_times_are_broadcast() -> None:
    driven = System(
        "driven", coordinates=["x"], parameters={"k": 2}, kinetic="1/2 x'^2", potential="-x sin(k t)"
    ).compile()
    t, y = np.linspace(0, 3, 40), np.zeros((40, 2))
    np.testing.assert_allclose(driven(y, t)[:, 1], np.sin(2 * t), atol=1e-15)
    np.testing.assert_allclose(driven(y, 0.5)[:, 1], np.sin(1.0), atol=1e-15)


def test_parameters_have_other_values() -> None:
    y = np.array([0.3, 0.0])
    assert pendulum().compile().rhs(0.0, y)[1] == pytest.approx(-9.81 / 1.5 * np.sin(0.3), rel=1e-14)
    longer = pendulum().compile(l=3.0)
    assert longer.parameters == {"l": 3.0, "g": 9.81}
    assert longer.rhs(0.0, y)[1] == pytest.approx(-9.81 / 3 * np.sin(0.3), rel=1e-14)
    with pytest.raises(ValueError, match="no parameter or size `mass`"):
        pendulum().compile(mass=1.0)


def test_states_without_accelerations_have_no_numbers() -> None:
    f = System("funnel", coordinates=["r", "s"], kinetic="1/2 (r'^2 + r^2 s'^2)").compile()
    y = np.array([[1.0, 0, 0, 1], [0, 0, 0, 1], [2, 0, 0, 1]])
    found = f(y)
    # r'' is r s'^2; s'' = −2 r' s'/r has no value at r = 0.
    np.testing.assert_array_equal(np.isnan(found), [[False] * 4, [False] * 3 + [True], [False] * 4])
    np.testing.assert_allclose(found[:, 2], [1, 0, 2])
    assert np.isnan(f.rhs(0.0, y[1])[3])


def test_functions_pickle_and_run_side_by_side(skate: System) -> None:
    f = pickle.loads(pickle.dumps(skate.compile(gs=2.0)))
    y = admissible(2000)
    expected = by_hand(y, 2.0)
    wrong: list[BaseException] = []

    def work() -> None:
        try:
            for _ in range(20):
                np.testing.assert_allclose(f(y), expected, rtol=1e-12, atol=1e-12)
                np.testing.assert_allclose(f.rhs(0.0, y[5]), expected[5], rtol=1e-12, atol=1e-12)
        except BaseException as problem:  # noqa: BLE001
            wrong.append(problem)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


@pytest.mark.parametrize(
    ("t", "y", "said"),
    [
        (None, np.zeros(6), "NoneType"),
        ("1", np.zeros(6), "states are numbers"),
        (0.0, [None] * 6, "NoneType"),
        (0.0, ["0"] * 6, "states are numbers"),
        (0.0, np.zeros(6, "M8[s]"), "states are numbers"),
        (0.0, np.zeros(6, [("a", "f8")]), "states are numbers"),
        (np.zeros(4), np.zeros((5, 6)), r"one for each state: its shape is \(4,\)"),
        (np.zeros(4), np.zeros(6), r"one for each state: its shape is \(4,\)"),
    ],
)
def test_what_is_no_number_is_refused(skate: System, t: Any, y: Any, said: str) -> None:
    with pytest.raises((TypeError, ValueError), match=said):
        skate.compile().rhs(t, y)


def test_objects_that_are_numbers_are_taken(skate: System) -> None:
    f, y = skate.compile(), admissible(3)
    objects = np.array([[Fraction(own) for own in row] for row in y], dtype=object)
    np.testing.assert_array_equal(f.rhs(0, objects), f.rhs(0, y))


def test_why_values_cannot_be_written_is_said(skate: System) -> None:
    f, y = skate.compile(), admissible(5)
    locked = np.zeros((5, 6))
    locked.flags.writeable = False
    for out, said in (
        (y, "shares memory with y"), (locked, "read-only"), (np.zeros((5, 12))[:, ::2], "no contiguous array"), (np.zeros((4, 6)), "of shape"),
    ):
        with pytest.raises(ValueError, match=said):
            f.rhs(0, y, out)
    one = y[0].copy()
    with pytest.raises(ValueError, match="shares memory with y"):
        f.rhs(0, one, one)


def test_where_a_number_is_divided_by_zero_nothing_is_finite() -> None:
    """x'' = -x'^2/x of 1/2 x^2 x'^2 has no value at x = 0, and no message either: y'' = 0 is known there."""
    f = System("cone", coordinates=["x", "y"], kinetic="1/2 x^2 x'^2 + 1/2 y'^2").compile()
    rates = f.rhs(0.0, [0.0, 0.0, 1.0, 0.0])
    assert not np.isfinite(rates[2])
    np.testing.assert_allclose(f.rhs(0.0, [2.0, 0.0, 1.0, 0.0]), [1, 0, -0.5, 0])
    assert "not a number, or infinite" in " ".join((type(f).__doc__ or "").split())
    assert "not a number, or infinite" in " ".join((type(f.rhs).__doc__ or "").split())


def test_constraints_of_higher_order_are_refused_at_their_place() -> None:
    system = System.from_gallery("fixed-acceleration")
    with pytest.raises(ModelError, match="`push` is of order 2") as caught:
        system.compile()
    assert "x''^2 + y''^2 = alpha^2" in str(caught.value.text)
    assert "compile" not in (type(system).state.__doc__ or "")
