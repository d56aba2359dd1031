"""The package is typed, and its types are those that it has."""

from __future__ import annotations

import ast
import inspect
import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from conftest import ROOT

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


def test_stubs_are_what_the_native_part_states() -> None:
    """The package has the stub that its library states; what is kept in the repository, and goes into the wheel, is no other one."""
    stated = (Path(chetaev.__file__).parent / "chetaev_native.pyi").read_text(encoding="utf-8")
    kept = (ROOT / "python" / "chetaev" / "chetaev_native.pyi").read_text(encoding="utf-8")
    assert kept == stated, "python/chetaev/chetaev_native.pyi is out of date: `cargo xtask python --stub` writes it"


def test_stubs_say_every_type() -> None:
    """PyO3 writes `Incomplete` where it knows none, and `Any` for any object."""
    text = (Path(chetaev.__file__).parent / "chetaev_native.pyi").read_text(encoding="utf-8")
    assert "Incomplete" not in text
    open_ones = [line.strip() for line in text.splitlines() if re.search(r"\bAny\b", line.replace("NDArray[Any]", ""))]
    assert [line.split("(")[0] for line in open_ones if line.startswith("def ")] == ["def __reduce__", "def ctypes"]
    assert all(line.startswith(("def ", "from typing ")) for line in open_ones)


def arguments(node: ast.FunctionDef) -> list[tuple[str, bool]]:
    """Names of the arguments of a stub, and whether they may be left out."""
    own = node.args.posonlyargs + node.args.args
    required = len(own) - len(node.args.defaults)
    return [(argument.arg, number >= required) for number, argument in enumerate(own) if argument.arg != "self"]


def taken(function: Any) -> list[tuple[str, bool]]:
    """The same of a function of the native part."""
    own = inspect.signature(function).parameters.values()
    return [(argument.name, argument.default is not argument.empty) for argument in own if argument.name not in ("self", "type")]


def test_stubs_have_what_the_native_part_has() -> None:
    tree = ast.parse((Path(chetaev.__file__).parent / "chetaev_native.pyi").read_text())
    classes = {node.name: node for node in tree.body if isinstance(node, ast.ClassDef)}
    native = {name: own for name, own in vars(chetaev_native).items() if inspect.isclass(own)}
    assert set(classes) == set(native)
    for name, node in classes.items():
        stubs = {own.name: own for own in node.body if isinstance(own, ast.FunctionDef)}
        stubs = {key: own for key, own in stubs.items() if not key.startswith("__") or key == "__call__"}
        members = {key: own for key, own in vars(native[name]).items() if not key.startswith("__") or key == "__call__"}
        assert set(stubs) == set(members), name
        for key, own in members.items():
            if callable(own) and key != "__call__":
                assert arguments(stubs[key]) == taken(own), f"{name}.{key}"
            # Nothing is left open: every argument and every value has a type.
            assert stubs[key].returns is not None
            assert all(argument.annotation is not None for argument in stubs[key].args.args if argument.arg != "self")
    stubs = {node.name: node for node in tree.body if isinstance(node, ast.FunctionDef)}
    functions = {name: own for name, own in vars(chetaev_native).items() if inspect.isbuiltin(own)}
    assert set(stubs) == set(functions)
    for key, own in functions.items():
        assert arguments(stubs[key]) == taken(own), key


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
