"""What SymPy's own tests and docstrings derive by Kane's and Lagrange's methods: are these the equations of the motion?

SymPy's test functions are run as they are installed, and each system that they form is taken over with the equations derived for it. The verdict is
a proof for all states and parameters (`equations.stated`).
"""

from __future__ import annotations

import doctest
import importlib
import inspect
import warnings
from collections.abc import Callable, Iterator
from typing import Any

import pytest

from chetaev import System

me = pytest.importorskip("sympy.physics.mechanics")

MODULES = [
    "actuator", "joint", "jointsmethod", "kane", "kane2", "kane3", "kane4", "kane5", "lagrange", "lagrange2", "linearize", "models", "system_class",
]
WORDS = ("KanesMethod", "LagrangesMethod", "JointsMethod", "form_eoms", "kanes_equations", "multi_mass", "n_link")
#: Tests that form no equations: of mistakes, of names of keywords, of what is refused.
NONE = {
    "jointsmethod.test_jointmethod_duplicate_coordinates_speeds", "joint.test_weld_joint", "kane.test_invalid_coordinates",
    "kane5.test_kane_rolling_disc_kdes_callable", "lagrange.test_invalid_coordinates",
}
CLASSES_OF_MISTAKES = ("TestSystem", "TestValidateSystem")
#: Where the answer is another one than `proved`, and why.
OTHERWISE = {
    # The acceleration of the centre is taken from that of the point of contact by the rule for two points of one body. The point of contact is no
    # point of the body: its velocity is zero at all times, and the acceleration of the matter there is not.
    "kane.test_aux": "refuted",
    # A particle on a rod has two freedoms, and three angles: SymPy's mass matrix is singular too.
    "kane.test_issue_24887": "not-applicable",
    # Forces on frames and points without any mass.
    "kane2.test_sub_qdot2": "not-applicable",
}
# Two are proved which are no rolling discs: `lagrange.test_rolling_disc` and `linearize.test_linearize_rolling_disc_lagrange` put the rolling into the kinetic
# energy, and what is proved is that the equations are those of this energy (docs/book/audit.md, "The rolling put into the kinetic energy").

#: After so many systems the rest of a long test is left out.
ENOUGH = {
    "jointsmethod.test_four_bar_linkage_with_manual_constraints": 1, "kane.test_aux": 2, "kane.test_implicit_kinematics": 1,
    "kane.test_issue_24887": 1, "kane.test_rolling_disc": 1, "kane3.test_bicycle": 1, "linearize.test_linearize_rolling_disc_kane": 1,
}
DOCSTRINGS = ["kane", "lagrange", "system", "jointsmethod", "actuator"]


class Enough(Exception):
    """Ends a test of SymPy."""


def cases() -> Iterator[tuple[str, Callable[[], Any]]]:
    """Tests that speak of methods which derive equations."""
    for name in MODULES:
        module = importlib.import_module(f"sympy.physics.mechanics.tests.test_{name}")
        for key, own in list(vars(module).items()):
            if getattr(own, "__module__", "") != module.__name__:
                continue
            if inspect.isclass(own) and key.startswith("Test") and key not in CLASSES_OF_MISTAKES:
                for test, function in inspect.getmembers(own, inspect.isfunction):
                    if test.startswith("test") and any(word in inspect.getsource(function) for word in WORDS):
                        yield f"{name}.{key}.{test}", lambda own=own, test=test: getattr(prepared(own), test)()  # type: ignore[misc]
            elif inspect.isfunction(own) and key.startswith("test") and any(word in inspect.getsource(own) for word in WORDS):
                yield f"{name}.{key}", own


def prepared(kind: Any) -> Any:
    """An object of a class of tests, after its fixtures."""
    own = kind()
    for value in vars(kind).values():
        if "ixture" in type(value).__name__ and hasattr(value, "_get_wrapped_function"):
            value._get_wrapped_function()(own)
    return own


CASES = dict(cases())


def formed(work: Callable[[], Any], count: int | None = None) -> list[Any]:
    """The methods by which equations are formed."""
    found: list[Any] = []
    with pytest.MonkeyPatch.context() as patch:
        for kind, name in ((me.KanesMethod, "kanes_equations"), (me.LagrangesMethod, "form_lagranges_equations")):
            old = getattr(kind, name)

            def new(self: Any, *arguments: Any, old: Any = old, **keywords: Any) -> Any:
                result = old(self, *arguments, **keywords)
                found.append(self)
                if len(found) == count:
                    raise Enough
                return result

            patch.setattr(kind, name, new)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            try:
                work()
            except Enough:
                pass
    return found


def verdict(method: Any) -> str:
    system = System.from_sympy(method, derived=True)
    return system.study(claims="equations.stated")["equations.stated#sympy"].verdict


@pytest.mark.parametrize("name", CASES)
def test_what_a_test_of_sympy_derives(name: str) -> None:
    found = formed(CASES[name], ENOUGH.get(name))
    assert (name in NONE) == (not found)
    assert [verdict(own) for own in found] == [OTHERWISE.get(name, "proved")] * len(found)


@pytest.mark.parametrize("name", DOCSTRINGS)
def test_what_a_docstring_of_sympy_derives(name: str) -> None:
    module = importlib.import_module(f"sympy.physics.mechanics.{name}")
    found: list[Any] = []
    for test in doctest.DocTestFinder().find(module):
        found += formed(lambda: doctest.DocTestRunner(verbose=False).run(test, out=lambda _: None))
    assert found
    assert [verdict(own) for own in found] == ["proved"] * len(found)


def test_the_disc_of_sympy_is_right_without_the_rule_for_two_points() -> None:
    """The same system as in `test_aux`, whose centre has the rate of its velocity as its acceleration."""
    kane = importlib.import_module("sympy.physics.mechanics.tests.test_kane")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(me.Point, "a2pt_theory", lambda *_: None)
        found = formed(kane.test_aux, 2)
    assert [verdict(own) for own in found] == ["proved", "proved"]
