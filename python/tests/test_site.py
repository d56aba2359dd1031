"""Notebooks run as they stand and show pictures; the site of the reference builds without a warning."""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT

NOTEBOOKS = ROOT / "docs" / "python" / "notebooks"
#: What the results say, by notebook: published values and words of verdicts.
SAID = {
    # The yaw rate is W / cosh(k t) (Neimark, Fufaev 1972), and the energy is kept.
    "ten-minutes": ["Maggi", "proved", "refuted", "not defined"],
    # Routh 1884: sqrt(g/(3 r)).
    "rolling-disc": ["3.3015148038438", "conditional", "a family with 2 parameters"],
    "appell-hamel": ["equations.stated#sympy", "proved", "refuted"],
    # Meijaard and others 2007, to as many digits as both agree in.
    "bicycle": ["4.292382536341", "6.024262015388", "conditional"],
    # Bloch, Krishnaprasad, Marsden, Murray 1996 have the momentum; Hénon and Heiles' case is C = 6 D.
    "integrals": ["psi' + theta'", "C = 6 D", "noether.inverse#wrong"],
    "robot": ["'y': 1.0", "follows from the other constraints", "left_hub_torque(t)", "heading_dot"],
    "dask-sweep": ["again: True", "the same bits: True"],
    "checking-a-paper": ["equations.stated#page", "refuted", "proved", "confirmed"],
}


def shown(notebook: Any) -> tuple[str, int]:
    """All text of the outputs, and the number of pictures."""
    text, pictures = [], 0
    for cell in notebook.cells:
        for output in cell.get("outputs", []):
            text.append(str(output.get("text", "")))
            data = output.get("data", {})
            text += [str(own) for kind, own in data.items() if kind.startswith("text/")]
            pictures += any(kind.startswith("image/") for kind in data)
    return "\n".join(text), pictures


@pytest.fixture(scope="module")
def executed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where notebooks are put that have been run."""
    return tmp_path_factory.mktemp("notebooks")


def test_every_notebook_is_known() -> None:
    assert {own.stem for own in NOTEBOOKS.glob("*.ipynb")} == set(SAID)
    listed = (NOTEBOOKS.parent / "index.md").read_text()
    for name in SAID:
        assert f"notebooks/{name}" in listed


@pytest.mark.parametrize("name", SAID)
def test_a_notebook_runs_and_shows_pictures(name: str, executed: Path) -> None:
    nbformat, nbclient = pytest.importorskip("nbformat"), pytest.importorskip("nbclient")
    path = NOTEBOOKS / f"{name}.ipynb"
    notebook = nbformat.read(path, 4)
    nbformat.validate(notebook)
    # Results are not kept in the repository: they would say what an older version gave.
    assert not any(cell.get("outputs") or cell.get("execution_count") for cell in notebook.cells)
    nbclient.NotebookClient(notebook, timeout=120, kernel_name="python3", resources={"metadata": {"path": str(executed)}}).execute()
    text, pictures = shown(notebook)
    assert pictures >= 1
    for words in SAID[name]:
        assert words in text, words
    (executed / path.name).write_text(json.dumps(notebook))


def test_the_site_builds_without_a_warning(executed: Path, tmp_path: Path) -> None:
    pytest.importorskip("myst_nb")
    source = tmp_path / "source"
    shutil.copytree(NOTEBOOKS.parent, source)
    for own in executed.glob("*.ipynb"):
        shutil.copy(own, source / "notebooks")
    command = [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", "-D", "nb_execution_mode=off", str(source), str(tmp_path / "site")]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    page = (tmp_path / "site" / "systems.html").read_text()
    for name in ("from_sympy", "derive", "stability", "widget"):
        assert f'id="chetaev.System.{name}"' in page
    assert "Maggi" in (tmp_path / "site" / "notebooks" / "ten-minutes.html").read_text() or not list(executed.glob("*.ipynb"))
