"""Parameters that follow from others, as J = m l^2: everywhere they are computed from the free ones."""

from __future__ import annotations

import pickle
from typing import Any

import numpy as np
import pytest

from chetaev import ModelError, System


@pytest.fixture(scope="module")
def rod() -> System:
    """J x'' = 1: the acceleration is 1/(m l^2)."""
    return System(
        "rod", coordinates=["x"], parameters={"m": 1, "l": 2, "J": "m l^2"}, kinetic="1/2 J x'^2", potential="-x", assumptions=["m > 0"]
    )


def test_compiled_functions_compute_them(rod: System) -> None:
    f = rod.compile(m=4)
    assert f.parameters == {"m": 4.0, "l": 2.0} and f.system.following == {"J": "m*l^2"} or rod.following["J"].replace(" ", "") in ("ml^2", "l^2m")
    assert f.rhs(0.0, [0, 0])[1] == 1 / 16
    assert rod.with_values(m=4).compile().rhs(0.0, [0, 0])[1] == 1 / 16
    assert rod.compile(m="1/3").rhs(0.0, [0, 0])[1] == pytest.approx(3 / 4, rel=1e-15)
    # By itself it is set only where it is named.
    assert rod.compile(J=5).rhs(0.0, [0, 0])[1] == 1 / 5


def test_callers_of_the_address_change_free_ones(rod: System) -> None:
    f = rod.compile()
    data, y, values = f.rhs.data, np.zeros(2), np.empty(2)
    data[1] = 4
    f.rhs.ctypes(0.0, y.ctypes.data, values.ctypes.data, data.ctypes.data)
    assert values[1] == 1 / 16


def test_assumptions_hold_for_other_values(rod: System) -> None:
    with pytest.raises(ModelError, match="m > 0"):
        rod.compile(m=-1)


def test_derivatives_have_both_parts(rod: System) -> None:
    jax = pytest.importorskip("jax")
    jax.config.update("jax_enable_x64", True)
    g = rod.to_jax()
    assert list(g.parameters) == ["m", "l"]
    # By hand: d/dm 1/(m l^2) = -1/(m^2 l^2), d/dl = -2/(m l^3).
    np.testing.assert_allclose(jax.jacfwd(g.rhs, argnums=2)(0.0, g.start, g.p)[1], [-1 / 4, -2 / 8], rtol=1e-14)


@pytest.mark.parametrize("notation", ["c", "rust", "matlab", "julia", "python"])
def test_exported_text_has_free_ones_only(rod: System, notation: str) -> None:
    text = rod.derive("reduced").to(notation)
    (line,) = [own for own in text.splitlines() if "p = (" in own and "parameters" in own or own.strip(" %#/*").startswith("p = (")][:1]
    assert "(m, l)" in line
    assert any("J = " in own for own in text.splitlines())


def test_opty_gets_free_ones_only(rod: System) -> None:
    found = rod.to_opty()
    assert sorted(own.name for own in found.parameters) == ["l", "m"]


def test_opty_gets_controls_and_masses() -> None:
    driven = System("a", coordinates=["x"], kinetic="1/2 x'^2", controls={"u": {}}, forces={"x": "u"}).to_opty()
    assert [own.func.__name__ for own in driven.inputs] == ["u"] and driven.equations.shape == (2, 1)
    cart = System.from_gallery("sand-cart").to_opty()
    assert [own.func.__name__ for own in cart.states] == ["x", "x_dot", "load"] and cart.equations.shape == (3, 1)


def test_functions_pickle(rod: System) -> None:
    f = rod.compile(m=4)
    y: Any = np.array([0.3, 0.2])
    for own in (f.rhs, f.jac):
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(own))(0.0, y), own(0.0, y))
    assert pickle.loads(pickle.dumps(f)).parameters == f.parameters
    assert "rates" in repr(f.rhs) and "x'" in repr(f.rhs)


def test_nothing_of_an_array_is_dropped(rod: System) -> None:
    f = rod.compile()
    with pytest.raises(TypeError, match="complex"):
        f.rhs(0.0, np.array([1 + 1j, 0]))
    with pytest.raises(TypeError, match="mask"):
        f.rhs(0.0, np.ma.masked_array([1.0, 2.0], mask=[True, False]))
    raw = np.zeros(17, dtype=np.uint8)
    unaligned = raw[1:].view(np.float64)
    unaligned[:] = [0.0, 3.0]
    np.testing.assert_array_equal(f.rhs(0.0, unaligned), [3, 1 / 4])
    many = np.zeros(8 * 2 * 9 + 1, dtype=np.uint8)[1:].view(np.float64).reshape(9, 2)
    assert f.jac(0.0, many).shape == (9, 2, 2)
