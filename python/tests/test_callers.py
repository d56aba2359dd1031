"""Functions for other programs: DLPack, C, Numba; what the model defines."""

from __future__ import annotations

import ctypes
import gc
from typing import Any

import numpy as np
import pytest

import chetaev
from chetaev import System

RNG = np.random.default_rng(3)


def pendulum() -> System:
    """θ'' = −(g/l) sin θ; the tension of the rod is m (l θ'^2 + g cos θ)."""
    return System(
        "pendulum",
        coordinates=["x", "y"],
        parameters={"m": 2, "l": 1.5, "g": 9.81},
        define={"height": "y + l", "power": "-m g y'"},
        kinetic="1/2 m (x'^2 + y'^2)",
        potential="m g y",
        constraints={"rod": "x^2 + y^2 = l^2"},
        sensors={"push": "m x''", "tension": "-2 l lambda_rod"},
    )


def state(th: float, w: float, ell: float = 1.5) -> np.ndarray:
    s, c = np.sin(th), np.cos(th)
    return np.array([ell * s, -ell * c, ell * c * w, ell * s * w])


def by_hand(th: float, w: float, ell: float = 1.5, g: float = 9.81) -> np.ndarray:
    s, c, a = np.sin(th), np.cos(th), -g / ell * np.sin(th)
    return np.array([ell * c * w, ell * s * w, ell * (c * a - s * w**2), ell * (s * a + c * w**2)])


def test_definitions_and_sensors_are_functions_of_the_state() -> None:
    f = pendulum().compile()
    assert f.names == ["height", "power", "push", "tension"]
    th, w = 0.4, 1.3
    y = state(th, w)
    expected = [y[1] + 1.5, -2 * 9.81 * y[3], 2 * by_hand(th, w)[2], 2 * (1.5 * w**2 + 9.81 * np.cos(th))]
    np.testing.assert_allclose(f.definitions(0.0, y), expected, rtol=1e-12)
    assert f.definitions(0.0, np.tile(y, (5, 1))).shape == (5, 4)


class Lent:
    """Memory of another library, offered by DLPack and by nothing else."""

    def __init__(self, own: np.ndarray) -> None:
        self.own = own

    def __dlpack__(self, **keywords: Any) -> Any:
        return self.own.__dlpack__(**keywords)

    def __dlpack_device__(self) -> tuple[int, int]:
        return self.own.__dlpack_device__()


def test_arrays_of_other_libraries_are_taken_where_they_lie() -> None:
    f = pendulum().compile()
    y = np.stack([state(*own) for own in RNG.normal(size=(50, 2))])
    out = np.zeros_like(y)
    lent = Lent(out)
    assert f.rhs(0.0, Lent(y), lent) is lent
    np.testing.assert_array_equal(out, f.rhs(0.0, y))
    jax = pytest.importorskip("jax.numpy")
    single = jax.asarray(y)
    np.testing.assert_allclose(f.rhs(0.0, single), f.rhs(0.0, np.asarray(single, dtype=float)))


def test_c_calls_the_function_at_its_address() -> None:
    f = pendulum().compile()
    y, values, data = state(0.4, 1.3), np.empty(4), f.rhs.data
    call = ctypes.CFUNCTYPE(None, ctypes.c_double, *3 * [ctypes.POINTER(ctypes.c_double)])(f.rhs.address)
    pointer = lambda own: own.ctypes.data_as(ctypes.POINTER(ctypes.c_double))  # noqa: E731
    call(0.0, pointer(y), pointer(values), pointer(data))
    np.testing.assert_array_equal(values, f.rhs(0.0, y))
    np.testing.assert_allclose(values, by_hand(0.4, 1.3), rtol=1e-12)
    # The parameters are behind the number of the function, in their order, and may be changed.
    assert list(data[1:]) == list(f.parameters.values())
    data[1 + list(f.parameters).index("g")] = 1.62
    call(0.0, pointer(y), pointer(values), pointer(data))
    np.testing.assert_allclose(values, by_hand(0.4, 1.3, g=1.62), rtol=1e-12)
    # The derivatives have an address too, and each function has its own data.
    matrix = np.empty((4, 4))
    call(0.0, pointer(y), pointer(matrix), pointer(f.jac.data))
    np.testing.assert_array_equal(matrix, f.jac(0.0, y))


def test_the_array_for_c_is_one_and_keeps_its_function() -> None:
    f = pendulum().compile()
    y, values = state(0.4, 1.3), np.empty(4)
    data = f.rhs.data
    assert f.rhs.data is data
    # What is changed in it holds for the next access, and for no call by Python.
    f.rhs.data[1 + list(f.parameters).index("g")] = 1.62
    call, address = f.rhs.ctypes, lambda own: own.ctypes.data
    call(0.0, address(y), address(values), address(f.rhs.data))
    np.testing.assert_allclose(values, by_hand(0.4, 1.3, g=1.62), rtol=1e-12)
    np.testing.assert_allclose(f.rhs(0.0, y), by_hand(0.4, 1.3), rtol=1e-12)
    copied = data.copy()
    del f
    gc.collect()
    call(0.0, address(y), address(values), address(data))
    np.testing.assert_allclose(values, by_hand(0.4, 1.3, g=1.62), rtol=1e-12)
    # By a copy nobody knows that the function is needed: then there are no values.
    del data
    gc.collect()
    call(0.0, address(y), address(values), address(copied))
    assert np.isnan(values).all()
    # What was no function writes nothing.
    copied[0], values[:] = 1e15, 7
    call(0.0, address(y), address(values), address(copied))
    assert list(values) == [7] * 4


def test_values_for_which_there_is_no_memory_are_an_exception() -> None:
    f = pendulum().compile()
    for own in (f.rhs, f.jac):
        with pytest.raises(MemoryError):
            own(0.0, np.broadcast_to(f.start, (10**12, 4)))


def test_numba_calls_the_function_at_its_address() -> None:
    numba = pytest.importorskip("numba")
    f = pendulum().compile()
    call, data = f.rhs.ctypes, f.rhs.data

    @numba.njit  # type: ignore[misc, unused-ignore]
    def runge_kutta(y: Any, data: Any, step: float, count: int) -> Any:
        k = np.empty((4, len(y)))
        for _ in range(count):
            call(0.0, y.ctypes.data, k[0].ctypes.data, data.ctypes.data)
            z = y + step / 2 * k[0]
            call(0.0, z.ctypes.data, k[1].ctypes.data, data.ctypes.data)
            z = y + step / 2 * k[1]
            call(0.0, z.ctypes.data, k[2].ctypes.data, data.ctypes.data)
            z = y + step * k[2]
            call(0.0, z.ctypes.data, k[3].ctypes.data, data.ctypes.data)
            y = y + step / 6 * (k[0] + 2 * k[1] + 2 * k[2] + k[3])
        return y

    end = runge_kutta(state(0.4, 1.3), data, 1e-3, 1000)
    ours = pendulum()
    motion = System.from_text(ours.text + "\n[initial]\nx = \"l sin(0.4)\"\ny = \"-l cos(0.4)\"\n\"x'\" = \"1.3 l cos(0.4)\"\n").simulate(t_end=1)
    np.testing.assert_allclose(end, motion.sol(1.0), rtol=1e-9, atol=1e-9)


def test_motions_are_known_between_the_rows() -> None:
    # An oscillator that starts at x = 1: x = cos t.
    sections = {"initial": {"x": 1}, "simulation": {"t_end": 10, "output": 200, "tolerance": 1e-13}}
    motion = System("o", coordinates=["x"], lagrangian="1/2 x'^2 - 1/2 x^2", **sections).simulate()
    times = np.linspace(0, 10, 1234)
    found = motion.sol(times)
    assert found.shape == (2, 1234) and motion.sol.names == ["x", "x'"]
    # What Hermite's polynomial of degree five leaves is h⁶/46080 of the sixth derivative, and h⁵ √5/30000 of it in the rate.
    h = 10 / 200
    assert np.abs(found[0] - np.cos(times)).max() < 1.05 * h**6 / 46080 + 1e-12
    assert np.abs(found[1] + np.sin(times)).max() < 1.05 * h**5 * 5**0.5 / 30000 + 1e-12
    np.testing.assert_array_equal(motion.sol(motion.t)[0][:-1], motion["x"][:-1])
    assert motion.sol(3).shape == (2,)
    with pytest.raises(ValueError, match="from t = 0.0 to 10.0"):
        motion.sol(10.01)
    with pytest.raises(ValueError, match="a number or a vector"):
        motion.sol([[1.0]])


def test_sensitivities_are_those_of_the_closed_form() -> None:
    # x = a cos(w t) with k = w² stated by w; the start has a too.
    system = System(
        "o", coordinates=["x"], parameters={"w": 1.3, "k": "w^2", "a": 0.7}, lagrangian="1/2 x'^2 - 1/2 k x^2",
        initial={"x": "a"}, simulation={"t_end": 6, "output": 60, "tolerance": 1e-12},
    )
    motion = system.simulate()
    found = motion.sensitivities(["a", "w"])
    t = motion.t
    np.testing.assert_array_equal(found["t"], t)
    np.testing.assert_allclose(found["d x/d a"], np.cos(1.3 * t), atol=1e-8)
    np.testing.assert_allclose(found["d x/d w"], -0.7 * t * np.sin(1.3 * t), atol=1e-8)
    np.testing.assert_allclose(found["d x'/d w"], -0.7 * (np.sin(1.3 * t) + 1.3 * t * np.cos(1.3 * t)), atol=1e-8)
    with pytest.raises(chetaev.ChetaevError):
        motion.sensitivities(["b"])


def test_sensitivities_are_those_of_neighbouring_motions() -> None:
    sleigh = System.from_gallery("chaplygin-sleigh")
    motion = sleigh.simulate(t_end=4, tolerance=1e-12)
    found = motion.sensitivities("a,m")
    for name, value in (("a", 0.25), ("m", 1.5)):
        ends = [sleigh.with_values(**{name: value + h}).simulate(t_end=4, tolerance=1e-12) for h in (1e-5, -1e-5)]
        for own in ("x", "phi", "y'"):
            np.testing.assert_allclose(found[f"d {own}/d {name}"], (ends[0][own] - ends[1][own]) / 2e-5, atol=1e-5)
