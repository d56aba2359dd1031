"""Files of linear equations for other programs, read back in full by these: NumPy, SciPy's reader of MATLAB files, python-control."""

from __future__ import annotations

import importlib.util
import runpy
import sys
import types
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from chetaev import System
from chetaev.results import Linearization

# Two bodies on springs, x'' = -2 x + y + force and y'' = x - 3 y - y' + 2 w.
TEXT = """
name = "two"
coordinates = ["x", "y"]
[controls]
force = {}
w = {}
[lagrangian]
L = "1/2 (x'^2 + y'^2) - x^2 - 3/2 y^2 + x y"
[forces]
x = "force"
y = "2 w - y'"
[steady.rest]
x = 0
y = 0
"x'" = 0
"y'" = 0
"""
OUTPUTS = ["x + 2 y", "y'", "force - x"]
EXPECTED = {
    "A": [[0, 0, 1, 0], [0, 0, 0, 1], [-2, 1, 0, 0], [1, -3, 0, -1]],
    "B": [[0, 0], [0, 0], [1, 0], [0, 2]],
    "C": [[1, 2, 0, 0], [0, 0, 0, 1], [-1, 0, 0, 0]],
    "D": [[0, 0], [0, 0], [1, 0]],
    "M_second": [[1, 0], [0, 1]],
    "D_second": [[0, 0], [0, 1]],
    "G_second": [[0, 0], [0, 0]],
    "K_second": [[2, -1], [-1, 3]],
    "N_second": [[0, 0], [0, 0]],
}
NAMES = {"states": ["x", "y", "x'", "y'"], "inputs": ["force", "w"], "outputs": OUTPUTS}


@pytest.fixture(scope="module")
def linear() -> Linearization:
    return System.from_text(TEXT).linearize(outputs=OUTPUTS)


def test_numpy_reads_all_arrays(linear: Linearization, tmp_path: Path) -> None:
    linear.save(tmp_path / "two.npz")
    with np.load(tmp_path / "two.npz") as archive:
        found = {name: archive[name] for name in archive.files}
    assert found.keys() == EXPECTED.keys() | NAMES.keys()
    for name, expected in EXPECTED.items():
        assert found[name].dtype == np.float64
        np.testing.assert_array_equal(found[name], np.array(expected, dtype=float), err_msg=name)
    for name, names in NAMES.items():
        assert list(found[name]) == names


def test_scipy_reads_the_matlab_file(linear: Linearization, tmp_path: Path) -> None:
    io = pytest.importorskip("scipy.io")
    linear.save(tmp_path / "two.mat")
    found = io.loadmat(tmp_path / "two.mat")
    assert {name for name in found if not name.startswith("__")} == EXPECTED.keys() | NAMES.keys()
    for name, expected in EXPECTED.items():
        np.testing.assert_array_equal(found[name], np.array(expected, dtype=float), err_msg=name)
    # Rows of characters, filled up with spaces.
    for name, names in NAMES.items():
        assert [own.rstrip() for own in found[name]] == names


def test_python_control_runs_the_script(linear: Linearization, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With python-control where it is installed, else with something in its place that keeps what it is given."""
    is_there = importlib.util.find_spec("control") is not None
    if not is_there:
        keeps = types.ModuleType("control")
        keeps.StateSpace = lambda A, B, C, D, **names: types.SimpleNamespace(A=A, B=B, C=C, D=D, **names)  # type: ignore[attr-defined]
        monkeypatch.setitem(sys.modules, "control", keeps)
    linear.save(tmp_path / "two.py")
    made: dict[str, Any] = runpy.run_path(str(tmp_path / "two.py"))
    system = made["system"]
    for name in "ABCD":
        np.testing.assert_array_equal(getattr(system, name), np.array(EXPECTED[name], dtype=float), err_msg=name)
    for name in EXPECTED:
        np.testing.assert_array_equal(made[name], np.array(EXPECTED[name], dtype=float), err_msg=name)
    assert {name: made[name] for name in NAMES} == NAMES
    if is_there:
        assert list(system.state_labels) == NAMES["states"]
        assert list(system.input_labels) == NAMES["inputs"]


def test_scipy_runs_the_script_in_all_variables(tmp_path: Path) -> None:
    """A pendulum by its Cartesian coordinates, x² + y² = 4 with gravity 9: the finite eigenvalues are zero of the constraint and ±i √(9/2)."""
    pytest.importorskip("scipy.linalg")
    text = (
        'name = "bob"\ncoordinates = ["x", "y"]\n[lagrangian]\nL = "1/2 (x\'^2 + y\'^2) - 9 y"\n'
        '[constraints]\nrod = "x^2 + y^2 = 4"\n[steady.hanging]\nx = 0\ny = -2\n"x\'" = 0\n"y\'" = 0\n'
    )
    linear = System.from_text(text).linearize(all=True)
    linear.save(tmp_path / "bob.py")
    linear.save(tmp_path / "bob.npz")
    made = runpy.run_path(str(tmp_path / "bob.py"))
    with np.load(tmp_path / "bob.npz") as archive:
        for name in "EABCD":
            np.testing.assert_array_equal(made[name], archive[name], err_msg=name)
    values = made["eigenvalues"]
    swinging = [own for own in values if abs(abs(own) - 4.5**0.5) < 1e-6]
    assert sorted(own.imag for own in swinging) == pytest.approx([-(4.5**0.5), 4.5**0.5], abs=1e-9)


def test_algebraic_numbers_are_rounded_in_files(tmp_path: Path) -> None:
    """At the zero 1.1673039782614187 of x⁵ - x - 1 the stiffness is 5 x⁴ - 1."""
    text = 'name = "quintic"\ncoordinates = ["x"]\n[lagrangian]\nL = "1/2 x\'^2 - x^6/6 + x^2/2 + x"\n[steady.rest]\nx = { guess = 1 }\n"x\'" = 0\n'
    linear = System.from_text(text).linearize()
    linear.save(tmp_path / "quintic.npz")
    with np.load(tmp_path / "quintic.npz") as archive:
        stiffness = -archive["A"][1, 0]
    assert stiffness == pytest.approx(5 * 1.1673039782614187**4 - 1, rel=1e-15)
    data = linear.to_dict()
    (own,) = [entry for entry in data["enclosed"] if entry["matrix"] == "A"]
    low, high = (float(end) for end in own["enclosure"])
    assert low <= -stiffness <= high and (own["row"], own["column"]) == (1, 0)
    E, F = linear.to_sympy()
    assert float(F[1, 0] / E[1, 1]) == pytest.approx(-stiffness, rel=1e-15)
