"""Functionals over space: the JSON of the command, equations in SymPy, display, mistakes."""

from __future__ import annotations

import json
import pickle
import subprocess
from pathlib import Path
from typing import Any

import pytest
import sympy as sp
from conftest import program

import chetaev
from chetaev import Functional, ModelError, OptionError, System

STRING = """
kind = "functional"
name = "string"
density = "rho/2 u,t^2 - T/2 u,x^2"
yields = ["motion"]
domain = { coordinates = ["x"], time = "t", intervals = { x = [0, "l"] } }
fields = { u = "scalar" }
parameters = { rho = {}, T = {}, l = {} }
boundary = { "x = 0" = { fixed = ["u"] }, "x = l" = { fixed = ["u"] } }
equations = { motion = "rho u,tt = T u,xx" }
"""


@pytest.fixture(scope="module")
def hu_washizu(gallery: Path) -> Functional:
    return Functional.from_file(gallery / "elasticity" / "p3p1" / "model.toml", set={"d": 2})


def without(data: Any, *keys: str) -> Any:
    return {key: without(own, *keys) for key, own in data.items() if key not in keys} if isinstance(data, dict) else (
        [without(own, *keys) for own in data] if isinstance(data, list) else data
    )


def test_studies_are_the_record(hu_washizu: Functional, command: Any, gallery: Path, tmp_path: Path) -> None:
    path = str(gallery / "elasticity" / "p3p1" / "model.toml")
    theirs = command("study", path, "--set", "d=2", "--out", str(tmp_path / "a"))
    ours = hu_washizu.study(out=tmp_path / "b")
    assert without(ours.to_dict(), "seconds", "files") == without(theirs, "seconds", "files")
    assert ours.ok and ours["functional.euler#p3p1"].verdict == "proved"
    assert ours.verify().agrees
    # What was written is verified by the command, the report too.
    lines = command("verify", str(tmp_path / "b" / "study.json"))
    assert {"report.html", "functional.euler#p3p1"} <= {own["claim"] for own in lines}
    assert {own["result"] for own in lines} == {"confirmed"}


def test_equations_are_the_json(hu_washizu: Functional, gallery: Path) -> None:
    path = str(gallery / "elasticity" / "p3p1" / "model.toml")
    own = program()
    assert own is not None

    def said(notation: str) -> str:
        arguments = [str(own), "derive", path, "--set", "d=2", "--as", notation]
        return subprocess.run(arguments, capture_output=True, text=True, check=True).stdout

    derived = hu_washizu.derive()
    assert derived.to_dict() == json.loads(said("json"))
    assert str(derived) == said("text").rstrip("\n")
    assert derived.to_latex() == said("latex")
    assert [own.title for own in derived] == ["Euler equations", "conditions on S_u", "conditions on S_s"]
    assert derived.euler.indexed[1].text == "A'_ij(e) - s_ij = 0"


def test_equations_go_to_sympy() -> None:
    """The equation of a string, by hand: ρ u_tt = T u_xx."""
    found = Functional.from_text(STRING).derive().to_sympy()["Euler equations"]
    rho, tension, accelerated, bent = (sp.Symbol(name, real=True) for name in ("rho", "T", "u,tt", "u,xx"))
    assert len(found) == 1
    assert sp.expand(found[0].lhs - found[0].rhs - (tension * bent - rho * accelerated)) == 0


def test_a_study_gives_the_equations_that_it_is_about() -> None:
    string = Functional.from_text(STRING)
    study = string.study()
    for own in (study, pickle.loads(pickle.dumps(study))):
        assert own.to_latex() == string.derive().to_latex() and "\\rho" in own.to_latex()
        assert own.to_sympy() == string.derive().to_sympy()


def test_results_are_displayed(hu_washizu: Functional) -> None:
    bundle = hu_washizu.study(claims="functional.euler")._repr_mimebundle_()
    assert "<details>" in bundle["text/html"] and "proved" in bundle["text/html"]
    assert "Euler equations" in bundle["text/plain"]
    derived = hu_washizu.derive()._repr_mimebundle_()
    assert derived["text/latex"].startswith("$$\\begin{aligned}")
    assert "Conditions on S_u" in derived["text/html"]
    assert hu_washizu.derive().to_latex().startswith("\\documentclass{article}")
    assert "Euler equations and natural conditions" in str(hu_washizu.explain())


def test_the_same_functional_again(hu_washizu: Functional) -> None:
    from_gallery = Functional.from_gallery("elasticity/p3p1", set={"d": 2})
    copied = pickle.loads(pickle.dumps(hu_washizu))
    assert str(from_gallery.derive()) == str(copied.derive()) == str(hu_washizu.derive())
    space = hu_washizu.with_values(d=3)
    assert (hu_washizu.dimensions, space.dimensions) == (2, 3)
    assert space.fields == {"s": "symmetric", "e": "symmetric", "u": "vector"}
    assert repr(space) == "<Functional p3p1: s (symmetric), e (symmetric), u (vector); 3 dimensions>"
    kinds = {own["name"]: own["kind"] for own in chetaev.gallery.list().to_dict()}
    assert kinds["elasticity/p3p1"] == "functional" and kinds["bodies/chain"] == kinds["trailer"] == "motion"


def test_mistakes_are_raised(gallery: Path) -> None:
    with pytest.raises(ModelError) as wrong:
        Functional.from_text(STRING.replace("T/2 u,x^2", "T/2 v,x^2"))
    assert wrong.value.line == 4 and "`v`" in str(wrong.value)
    with pytest.raises(ModelError, match="System"):
        Functional.from_file(gallery / "trailer" / "model.toml")
    with pytest.raises(ModelError):
        System.from_text(STRING)
    with pytest.raises(OptionError, match="functional.euler"):
        Functional.from_text(STRING).study(claims="functional.eulr")
    refuted = Functional.from_text(STRING.replace("= T u,xx", "= -T u,xx")).study()
    assert refuted["functional.euler#string"].verdict == "refuted"
    assert Functional.from_text(STRING).check().ok


def test_a_system_that_is_a_functional_says_where_it_belongs() -> None:
    with pytest.raises(ModelError, match=r"`chetaev.Functional` reads functionals"):
        System.from_text(STRING)


def test_the_text_has_what_was_set() -> None:
    text = """
kind = "functional"
name = "laplace" # of a membrane
density = "1/2 T u,i u,i"
domain = { coordinates = "x_i" }
fields = { u = "scalar" }
parameters = { T = {} }
sizes = { d = 2 } # dimensions
"""
    changed = Functional.from_text(text).with_values(d=3, T="1/2")
    assert changed.text == text.replace("d = 2", "d = 3").replace("T = {}", 'T = { value = "1/2" }')
    again = Functional.from_text(changed.text)
    assert again.dimensions == 3 and again.parameters == {"T": "1/2"}


def test_what_other_files_take_too_is_no_text_of_one(gallery: Path) -> None:
    """The dual of p3p1 is another file, which has the size by `set` only."""
    own = Functional.from_file(gallery / "elasticity" / "p3p1" / "model.toml", set={"d": 1})
    assert own.dimensions == 1
    with pytest.raises(ModelError, match="`d`"):
        _ = own.text
    assert "p3p1" in own._repr_mimebundle_()["text/html"]


def test_files_of_a_study_are_verified_with_it(tmp_path: Path) -> None:
    study = Functional.from_gallery("fields/plate").study(claims="functional.euler", out=tmp_path)
    found = {own["claim"]: own["result"] for own in study.verify().to_dict()}
    assert found["report.html"] == "confirmed"
