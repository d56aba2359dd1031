"""What equations are printed as is read again, in SymPy too: every form of every model."""

from __future__ import annotations

import math
import os
import random
import warnings
from typing import Any

import pytest

import chetaev
from chetaev import System
from chetaev.trees import nodes, replaced, solved

sp = pytest.importorskip("sympy")
mpmath = pytest.importorskip("mpmath")

MODELS = [name for name in chetaev.gallery.list() if not name.startswith(("elasticity/", "fields/"))]
IS_FULL = os.environ.get("CHETAEV_TESTS") == "full"
#: Rows of linear systems under one heading, of which Cramer's rule is written out.
MOST_ROWS = 40
#: Those with linear systems in their equations, and a few others; the full run has all.
USUAL = ["chaplygin-sleigh", "rattleback", "leaking-pendulum", "bodies/chain", "bodies/spherical-robot", "falling-rolling-disc"]


def number(expression: Any, point: dict[str, Any]) -> Any:
    """The value of an expression at a point, by names, with fifty digits."""
    found: dict[Any, Any] = {}
    functions = {"Abs": mpmath.fabs, "sign": mpmath.sign, "log": mpmath.log, "atan2": mpmath.atan2}
    for own in nodes([expression]):
        if isinstance(own, sp.Derivative):
            found[own] = point[f"{own.expr.func.__name__}{own.derivative_count * chr(39)}"]
        elif isinstance(own, sp.core.function.AppliedUndef):
            found[own] = point[own.func.__name__]
        elif isinstance(own, sp.Symbol):
            found[own] = point[own.name]
        elif own.is_Rational:
            found[own] = mpmath.mpf(own.p) / own.q
        elif own.is_Add:
            found[own] = mpmath.fsum(found[part] for part in own.args)
        elif own.is_Mul:
            found[own] = mpmath.fprod(found[part] for part in own.args)
        elif own.is_Pow:
            found[own] = mpmath.power(found[own.base], found[own.exp])
        elif own.is_NumberSymbol or own.is_Float:
            found[own] = mpmath.mpf(own.evalf(50))
        elif own.is_Function:
            function = functions.get(own.func.__name__) or getattr(mpmath, own.func.__name__)
            found[own] = function(*(found[part] for part in own.args))
    return found[expression]


class Point(dict[str, Any]):
    """Random values of what is free, the same when asked again; what the model defines, as a quasi-velocity, has its value."""

    def __init__(self, system: System, variables: list[str]) -> None:
        super().__init__()
        self.system = system
        self.variables = variables

    def __missing__(self, name: str) -> Any:
        found = self.system.sympify(name, variables=self.variables)
        called = found.expr.func.__name__ + found.derivative_count * "'" if isinstance(found, sp.Derivative) else getattr(found, "name", None)
        is_free = name in (called, found.func.__name__)
        self[name] = mpmath.mpf(random.Random(name).uniform(0.3, 1.3)) if is_free else number(found, self)
        return self[name]


def agree(one: Any, other: Any) -> bool:
    return bool(mpmath.fabs(one - other) <= mpmath.mpf(10) ** -30 * (1 + mpmath.fabs(one)))


@pytest.mark.parametrize("name", MODELS if IS_FULL else USUAL)
def test_printed_equations_are_read_in_sympy(name: str) -> None:
    """`sympify` of the texts against `to_sympy`, which prints the expressions themselves."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        system = System.from_gallery(name)
    derived = system.derive("reduced", all=False) if not IS_FULL else system.derive(["reduced", "routh"])
    compared = 0
    for form in derived:
        module = derived._module()
        sections = module.sections[form.name.replace("-", "_")]
        for title, equations in form.groups.items():
            rows = sections.get(f"{title}: linear systems", [])
            if len(rows) > MOST_ROWS:
                continue
            texts = [text for own in equations for text in (own.left, own.right)]
            ours = system.sympify(texts, variables=form.state)
            # By another way: numbers for the unknowns, found by solving the systems as they are stated.
            theirs = [side for own in sections[title] for side in (own.lhs, own.rhs)]
            if rows:
                theirs = replaced(theirs, solved(rows, module.is_unknown))
            with mpmath.workdps(50):
                point = Point(system, form.state)
                for a, b in zip(ours, theirs, strict=True):
                    assert agree(number(a, point), number(b, point)), title
                    compared += 1
    assert compared > 0


def test_solutions_are_those_of_the_system() -> None:
    """Cramer's rule against SymPy's own elimination, with unknowns of one system in the coefficients of the next."""
    a, b, c, u, v, w = sp.symbols("a b c u v w")
    rows = [sp.Eq(a * u + b * v, c), sp.Eq(b * u - v * sp.sin(a), 1), sp.Eq((u + v) * w, a * u)]
    found = solved(rows, lambda own: own in (u, v, w))
    byhand = sp.solve(rows, [u, v, w], dict=True)[0]
    assert all(sp.simplify(found[own] - byhand[own]) == 0 for own in (u, v, w))


@pytest.mark.parametrize(
    ("text", "wanted"),
    [
        ("w_1 + w_2\nwhere\n  a w_1 + x w_2 = 1\n  x w_1 + a w_2 = 0", lambda a, x: (a - x) / (a**2 - x**2)),
        ("v^2 + 1\nwhere\n  v = sin(x) + a", lambda a, x: (sp.sin(x) + a) ** 2 + 1),
    ],
)
def test_texts_with_definitions_are_exact(text: str, wanted: Any) -> None:
    system = System("s", coordinates=["x"], parameters=["a"], kinetic="1/2 a x'^2")
    found = system.sympify(text)
    (x,) = found.atoms(sp.core.function.AppliedUndef)
    a = next(own for own in found.free_symbols if own.name == "a")
    assert sp.simplify(found - wanted(a, x)) == 0
    assert math.isfinite(float(found.subs({a: 2, x: sp.Rational(1, 3)})))


def test_numbers_alone_are_those_of_sympy() -> None:
    system = System("s", coordinates=["x"], kinetic="1/2 x'^2")
    found = system.sympify(["0", "2/6", "x - x"])
    assert found == [0, sp.Rational(1, 3), 0]
    assert all(isinstance(own, sp.Expr) for own in found)


def test_advice_on_functions_that_are_not_there_is_right() -> None:
    """What is advised is the function, at numbers where both are defined."""
    for name, at in [("acot", 0.7), ("asec", 1.7), ("acsc", 1.7), ("sech", 0.7), ("csch", 0.7), ("coth", 0.7), ("asech", 0.7), ("acsch", 0.7), ("acoth", 1.7)]:
        with pytest.raises(chetaev.ModelError) as caught:
            System("s", coordinates=["x"], kinetic="1/2 x'^2", potential=f"{name}(x)")
        hint = caught.value.hint
        assert hint is not None and hint.startswith("write ")
        advised = hint.removeprefix("write ").partition(",")[0]
        system = System("s", coordinates=["x"], kinetic="1/2 x'^2")
        found = system.sympify(advised)
        (x,) = found.atoms(sp.core.function.AppliedUndef)
        assert abs(float(found.subs(x, at)) - float(getattr(mpmath, name)(at))) < 1e-12, name
