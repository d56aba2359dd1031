"""The package is typed, and its types are those that it has."""

from __future__ import annotations

import inspect
import subprocess
import sys
from pathlib import Path

import pytest

import chetaev
from chetaev import chetaev_native


def test_mypy_finds_nothing() -> None:
    pytest.importorskip("mypy")
    package = Path(chetaev.__file__).parent
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--ignore-missing-imports", str(package)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout


def test_stubs_have_what_the_native_part_has() -> None:
    stub = (Path(chetaev.__file__).parent / "chetaev_native.pyi").read_text()
    for name in ("Model", "Outcome", "Sweep", "Linear", "Compiled", "Function"):
        _, _, block = stub.partition(f"class {name}:")
        block = block.partition("\n@final")[0].partition("\ndef ")[0]
        own = [member for member in vars(getattr(chetaev_native, name)) if not member.startswith("__")]
        assert own
        for member in own:
            assert f"def {member}(" in block, f"{name}.{member} has no stub"
    functions = [own for own, value in vars(chetaev_native).items() if inspect.isbuiltin(value)]
    for name in functions:
        assert f"def {name}(" in stub


def test_everything_public_is_documented() -> None:
    for name in chetaev.__all__:
        own = getattr(chetaev, name)
        if not isinstance(own, str):
            assert inspect.getdoc(own), name
    for name, own in vars(chetaev.System).items():
        if callable(own) and not name.startswith("_"):
            assert inspect.getdoc(own), name


def test_pyright_finds_nothing(tmp_path: Path) -> None:
    pytest.importorskip("pyright")
    package = Path(chetaev.__file__).parent
    command = [sys.executable, "-m", "pyright", "--pythonpath", sys.executable, str(package)]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stdout
    assert "0 errors" in done.stdout
