"""The chapter of the book and the examples in the documentation give what they show."""

from __future__ import annotations

import doctest
import importlib
from pathlib import Path

import pytest
from conftest import ROOT

MODULES = ["chetaev", "chetaev.claims", "chetaev.functional", "chetaev.sweeps", "chetaev.system"]


def test_the_chapter_gives_what_it_shows() -> None:
    found = doctest.testfile(str(ROOT / "docs" / "book" / "python.md"), module_relative=False)
    assert found.attempted > 20
    assert found.failed == 0


@pytest.mark.parametrize("name", MODULES)
def test_examples_give_what_they_show(name: str) -> None:
    found = doctest.testmod(importlib.import_module(name))
    assert found.attempted > 0
    assert found.failed == 0


def test_the_chapter_is_in_the_book() -> None:
    assert "(python.md)" in (Path(ROOT) / "docs" / "book" / "SUMMARY.md").read_text()
