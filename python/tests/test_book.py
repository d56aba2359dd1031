"""The chapter of the book and the examples in the documentation give what they show."""

from __future__ import annotations

import doctest
import importlib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import ROOT

from chetaev import System

MODULES = [
    "chetaev", "chetaev.claims", "chetaev.compiled", "chetaev.functional", "chetaev.results", "chetaev.sweeps", "chetaev.system",
]


def test_the_chapter_gives_what_it_shows() -> None:
    found = doctest.testfile(str(ROOT / "docs" / "book" / "python.md"), module_relative=False)
    assert found.attempted > 20
    assert found.failed == 0


@pytest.mark.parametrize("name", MODULES)
def test_examples_give_what_they_show(name: str) -> None:
    found = doctest.testmod(importlib.import_module(name))
    assert found.attempted > 0
    assert found.failed == 0


def test_the_robot_of_the_book_runs_in_scipy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = (ROOT / "docs" / "book" / "tasks" / "robot.md").read_text()
    block = {language: page.split(f"```{language}\n")[1].split("```")[0] for language in ("toml", "python")}
    module = System.from_text(block["toml"]).derive("reduced").to("python")
    (tmp_path / "robot.py").write_text(module)
    monkeypatch.syspath_prepend(tmp_path)
    space: dict[str, Any] = {}
    exec(block["python"], space)
    x, y, heading, left, right, v, w = space["motion"].y
    # By hand: the wheels turn by what the hubs go, and the torques give power where the energy is 1/2 (M + 3 m) v^2 + 1/2 I w^2.
    np.testing.assert_allclose(2 * 0.2 * heading, 0.1 * (right - left), atol=1e-9)
    inertia = 0.3 + 8 * 0.05**2 + 3 * 0.5 * 0.2**2 + 0.5 * 0.5 * 0.1**2
    np.testing.assert_allclose((8 + 3 * 0.5) * v**2 / 2 + inertia * w**2 / 2, 0.3 * left + 0.2 * right, atol=1e-8)


def test_the_chapter_is_in_the_book() -> None:
    assert "(python.md)" in (Path(ROOT) / "docs" / "book" / "SUMMARY.md").read_text()
