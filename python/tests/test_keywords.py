"""What is said to users of Python names keywords, and no options of the command line."""

from __future__ import annotations

import re
import warnings
from typing import Any

import pytest
from conftest import ROOT
from test_commands import commands, options

import chetaev
from chetaev import System
from chetaev.keywords import FLAGS, in_python


@pytest.mark.parametrize(
    ("said", "wanted"),
    [
        ("state it under [parameters], or run with --set m=1", "state it under [parameters], or by with_values(m=1)"),
        ("give it one with `--set m=…`", "give it one by `with_values(m=…)`"),
        ("set `project = true` (or `--project`) to use them", "set `project = true` (or `project=True`) to use them"),
        ("choose one with --branch N or `branch = N`", "choose one with branch=N or `branch = N`"),
        ("say how many by --count N", "say how many by count=N"),
        ("--count says how many are drawn", "count=… says how many are drawn"),
        ("a larger --budget decides more", "a larger budget=… decides more"),
        ("needs [simulation] or --method taylor", 'needs [simulation] or method="taylor"'),
        ("or --step 0.01", "or step=0.01"),
        ("which? --about upright or --about rest", 'which? about="upright" or about="rest"'),
        ("--at u=1: no", 'at="u=1": no'),
        ("must be given: --period \"2 pi/omega\"", 'must be given: period="2 pi/omega"'),
        ("give --vary NAME=FROM:TO:COUNT or --rows FILE", 'give vary={"NAME": "FROM:TO:COUNT"} or rows=FILE'),
        ("write --initial \"x'=0:1:5\"", "write initial={\"x'\": \"0:1:5\"}"),
        ("`--kappa kappa_a=1/2` takes another", '`kappa={"kappa_a": "1/2"}` takes another'),
        ("`chetaev linearize --along` takes the motion", "`along()` takes the motion"),
        ("`chetaev derive MODEL --formulation hamel` prints", '`derive(formulation="hamel")` prints'),
        ("--orbit with --period follows", "orbit=True with period=… follows"),
        ("`chetaev stability --over m=...` says", '`stability(over="m=...")` says'),
        ("::: --set initial.y'=1:1:9", "::: with_initial({\"y'\": 1}):1:9"),
        ("--> --set m=x:1:3", "--> with_values(m=x):1:3"),
        ("in all variables, by --all, it is one", "in all variables, by all=True, it is one"),
        ("2 -- 3 stays, and so does x--y", "2 -- 3 stays, and so does x--y"),
    ],
)
def test_options_are_keywords(said: str, wanted: str) -> None:
    assert in_python(said) == wanted


def test_flags_are_those_of_the_command_line() -> None:
    known = set().union(*(options(own) for own in commands() if own != "help"))
    assert FLAGS <= known


def test_no_sentence_of_the_library_keeps_an_option() -> None:
    """Every text in the sources of the library that names an option, as Python says it."""
    found = []
    for path in ROOT.glob("crates/*/src/**/*.rs"):
        if path.parts[len(ROOT.parts) + 1] in ("cli", "laws", "bench", "web"):
            continue
        found += re.findall(r'"(?:[^"\\]|\\.)*--[a-z](?:[^"\\]|\\.)*"', path.read_text(encoding="utf-8"))
    assert len(found) > 20
    left = [own for own in found if re.search(r"(?<![\w-])--[a-z]", in_python(own.replace('\\"', '"')))]
    assert left == []


def said(work: Any) -> str:
    with warnings.catch_warnings(), pytest.raises(chetaev.ChetaevError) as caught:
        warnings.simplefilter("ignore")
        work()
    hints = " ".join(str(hint) for own in caught.value.diagnostics for hint in own.get("hints", []))
    return f"{caught.value} {hints}"


def test_exceptions_name_keywords() -> None:
    pendulum: dict[str, Any] = {"coordinates": ["x"], "parameters": ["m"], "kinetic": "1/2 m x'^2"}
    without = System("a", **pendulum, initial={"x": 1})
    skate = System.from_gallery("chaplygin-sleigh").with_initial({"x'": 1, "y'": 1})
    for work, word in [
        (without.simulate, "with_values("),
        (lambda: without.study(claims="motion"), "with_values("),
        (skate.simulate, "project=True"),
        (lambda: System.from_gallery("chaplygin-sleigh").sweep(vary={"a": "0:1:uniform"}), "count=N"),
        (lambda: System.from_gallery("chaplygin-sleigh").sweep(), "vary={"),
        (lambda: System.from_gallery("chaplygin-sleigh").simulate(method="runge-kutta-4"), "step=0.01"),
        (lambda: System.from_gallery("watt-governor").stability(at="q=1"), "at="),
    ]:
        message = said(work)
        assert word in message, message
        assert re.search(r"--[a-z]", message) is None, message


def test_reasons_name_keywords() -> None:
    """Of trajectories that do not begin, of linear equations, of formulations that do not apply."""
    sleigh = System.from_gallery("chaplygin-sleigh")
    found = sleigh.sweep(initial={"x'": [0, 1], "y'": [1, 0]}, t_end=1)
    assert found.failures and all("project=True" in own and "--" not in own for own in found.failures.values())
    with pytest.raises(chetaev.ChetaevError, match="in all variables, by all=True, it is one"):
        System.from_gallery("falling-rolling-disc").linearize(about="rolling", outputs=["phi"])
