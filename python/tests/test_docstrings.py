"""Docstrings are in numpydoc form and complete: every parameter, what is returned, what attributes are, and the shape of every array."""

from __future__ import annotations

import functools
import inspect
import re
from collections.abc import Iterator
from typing import Any

import pytest

import chetaev
from chetaev import claims, compiled, errors, exported, functional, gallery, results, sweeps, system

MODULES = [claims, compiled, errors, exported, functional, gallery, results, sweeps, system]
#: Classes that users meet although their names stand in no list.
PRIVATE = {"Shown", "Html"}
#: A section of numpydoc: its name with a line below.
_SECTION = re.compile(r"^([A-Z][A-Za-z ]+)\n-{3,}\n", re.MULTILINE)


def sections(doc: str) -> dict[str, str]:
    """What stands under each heading; the text before the first under an empty one."""
    parts = _SECTION.split(doc)
    return {"": parts[0], **dict(zip(parts[1::2], parts[2::2]))}


def entries(section: str) -> list[str]:
    """The names that a section describes: lines `a, b : type`, each with an indented description."""
    lines = section.splitlines()
    found = []
    for number, line in enumerate(lines):
        if not line or line.startswith(" "):
            continue
        described = number + 1 < len(lines) and lines[number + 1].startswith(" ")
        assert described, f"nothing is said of `{line}`"
        found += [own.strip().lstrip("*") for own in line.partition(" : ")[0].split(",")]
    return found


def classes() -> Iterator[Any]:
    for module in MODULES:
        for name, own in vars(module).items():
            if inspect.isclass(own) and own.__module__ == module.__name__ and not name.startswith("_") and name not in PRIVATE:
                yield own


def callables() -> Iterator[tuple[str, Any]]:
    for module in MODULES:
        for name, own in vars(module).items():
            if inspect.isfunction(own) and own.__module__ == module.__name__ and (name in chetaev.__all__ or module is gallery and not name.startswith("_")):
                yield name, own
    for kind in classes():
        for name, own in vars(kind).items():
            function = own.__func__ if isinstance(own, (classmethod, staticmethod)) else own
            if inspect.isfunction(function) and (not name.startswith("_") or name == "__call__"):
                yield f"{kind.__name__}.{name}", function


CALLABLES = dict(callables())
CLASSES = {own.__name__: own for own in classes()}


@pytest.mark.parametrize("name", CALLABLES)
def test_of_a_function(name: str) -> None:
    own = CALLABLES[name]
    doc = inspect.getdoc(own)
    assert doc, "no docstring"
    found = sections(doc)
    assert found[""].strip().splitlines()[0].endswith((".", ":", "?")) or "\n" in found[""].strip(), "the first sentence has an end"
    parameters = [key for key in inspect.signature(own).parameters if key not in ("self", "cls")]
    assert sorted(entries(found.get("Parameters", ""))) == sorted(parameters)
    returned = str(inspect.signature(own).return_annotation)
    if returned not in ("None", "Iterator[str]"):
        assert "Returns" in found, f"it returns {returned}"
    if "NDArray" in returned:
        assert "shape" in doc


@pytest.mark.parametrize("name", CLASSES)
def test_of_a_class(name: str) -> None:
    kind = CLASSES[name]
    doc = vars(kind).get("__doc__")
    assert doc, "no docstring"
    found = sections(inspect.cleandoc(doc))
    stated = entries(found.get("Attributes", ""))
    properties = {key: own for key, own in vars(kind).items() if isinstance(own, (property, functools.cached_property)) and not key.startswith("_")}
    for key, own in properties.items():
        function = own.fget if isinstance(own, property) else own.func
        said = inspect.getdoc(function)
        assert said, f"{key} has no docstring"
        if "NDArray" in str(inspect.signature(function).return_annotation):
            assert "shape" in said, f"{key} has no shape"
    # What __init__ sets for users is described as an attribute.
    if "__init__" in vars(kind):
        source = inspect.getsource(vars(kind)["__init__"])
        public = set(re.findall(r"self\.([a-z]\w*)(?:: [^=\n]+)? = ", source))
        assert public - set(stated) - set(properties) == set()
