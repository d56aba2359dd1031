"""What Python states comes back from its text the same: models, numbers, names, SymPy expressions, data."""

from __future__ import annotations

import json
import math
import pickle
from fractions import Fraction
from typing import Any

import numpy as np
import sympy as sp
from hypothesis import given, settings
from hypothesis import strategies as st

from chetaev import ModelError, System
from chetaev.texts import exact, of_sympy, toml

finite = st.floats(allow_nan=False, allow_infinity=False, min_value=-1e12, max_value=1e12)
values = st.one_of(st.integers(-(10**9), 10**9), st.fractions(max_denominator=10**6), finite)
names = st.from_regex(r"[a-z][a-z0-9]{0,6}(_[a-z0-9]{1,3})?", fullmatch=True)
texts = st.text(st.characters(exclude_categories=["Cs", "Cc"]), max_size=40)


def fraction(value: Any) -> Fraction:
    """The exact number that a value states: a float is the decimal that it prints as."""
    return Fraction(repr(value)) if isinstance(value, float) else Fraction(value)


@settings(max_examples=200, deadline=None)
@given(st.dictionaries(names, values, min_size=1, max_size=4))
def test_numbers_come_back_exactly(parameters: dict[str, Any]) -> None:
    try:
        system = System("s", coordinates=["Q"], parameters=parameters, kinetic="1/2 Q'^2")
    except ModelError as problem:
        # Names that the notation has for itself are refused, and nothing else is.
        assert all(own["code"] in ("reserved-name", "declared-twice", "name-in-use") or "name" in own["message"] for own in problem.diagnostics)
        return
    again = System.from_text(system.text)
    for own in (system, again, pickle.loads(pickle.dumps(again))):
        assert {name: Fraction(str(value)) for name, value in own.parameters.items()} == {
            name: fraction(value) for name, value in parameters.items()
        }


@settings(max_examples=200, deadline=None)
@given(values)
def test_a_number_is_written_so_that_it_reads_back(value: Any) -> None:
    written = exact(value)
    assert Fraction(written) == fraction(value)
    assert exact(written) == written
    if isinstance(value, float):
        assert float(written) == value and exact(np.float64(value)) == written


@settings(max_examples=200, deadline=None)
@given(texts, texts)
def test_texts_come_back_letter_by_letter(description: str, source: str) -> None:
    import tomllib

    data = {"description": description, "source": [source], "t": {source: description, "n": [1, True]}}
    assert tomllib.loads(toml(data)) == data


leaves = st.one_of(
    st.sampled_from(["x", "y", "x'", "y'", "a", "t"]).map(lambda name: name),
    st.integers(-20, 20).map(str),
    st.fractions(max_denominator=50).map(lambda own: f"({own.numerator}/{own.denominator})"),
)


def grown(inner: st.SearchStrategy[str]) -> st.SearchStrategy[str]:
    two = st.tuples(inner, inner)
    return st.one_of(
        two.map(lambda own: f"({own[0]} + {own[1]})"),
        two.map(lambda own: f"({own[0]} - {own[1]})"),
        two.map(lambda own: f"({own[0]}) ({own[1]})"),
        inner.map(lambda own: f"1/(2 + ({own})^2)"),
        inner.map(lambda own: f"cos({own})"),
        inner.map(lambda own: f"sqrt(1 + ({own})^2)"),
        st.tuples(inner, st.integers(2, 4)).map(lambda own: f"({own[0]})^{own[1]}"),
    )


expressions = st.recursive(leaves, grown, max_leaves=7)


@settings(max_examples=40, deadline=None)
@given(expressions, expressions)
def test_models_come_back_with_the_same_functions(potential: str, force: str) -> None:
    """Text → system → text → system, and through SymPy: the rates have the same bits, or differ by rounding where SymPy orders terms anew."""
    sections: dict[str, Any] = {"coordinates": ["x", "y"], "parameters": {"a": Fraction(3, 7)}, "forces": {"x": force}}
    without_rates = potential.replace("x'", "x").replace("y'", "y")
    system = System("s", kinetic="1/2 (x'^2 + 2 y'^2)", potential=without_rates, **sections)
    again = System.from_text(system.text)
    assert again.text == system.text and again.coordinates == system.coordinates
    y, t = np.array([0.3, -0.7, 0.9, 0.4]), 0.6
    expected = system.compile().rhs(t, y)
    np.testing.assert_array_equal(again.compile().rhs(t, y), expected)
    there = system.sympify([without_rates, force])
    back = System("s", kinetic="1/2 (x'^2 + 2 y'^2)", potential=there[0], **(sections | {"forces": {"x": there[1]}}))
    found = back.compile().rhs(t, y)
    both = np.isfinite(expected) & np.isfinite(found)
    scale = 1 + max(abs(float(own)) for own in np.where(both, expected, 0))
    np.testing.assert_allclose(found[both], expected[both], rtol=1e-9, atol=1e-9 * scale)
    # What goes to SymPy and back once stays as it is.
    assert of_sympy(back.sympify(of_sympy(there[0]))) == of_sympy(there[0]) or math.isfinite(scale)


@settings(max_examples=60, deadline=None)
@given(st.recursive(st.one_of(st.none(), st.booleans(), st.integers(), finite, texts), lambda inner: st.lists(inner, max_size=3) | st.dictionaries(texts, inner, max_size=3), max_leaves=8))
def test_data_of_results_are_plain(data: Any) -> None:
    from chetaev.results import Result

    own = Result(data, "x").to_dict()
    assert json.loads(json.dumps(own)) == own == data


def test_sympy_numbers_are_exact() -> None:
    for own in (sp.Rational(1, 3), sp.Rational(1, 10) ** 30, sp.Float("0.12345678901234567890123456789", 29), sp.sqrt(2) / 2, sp.pi, sp.E**2, sp.Integer(-7)):
        system = System("s", coordinates=["q"], parameters={"a": own}, kinetic="1/2 q'^2")
        assert sp.simplify(sp.sympify(system.sympify(str(system.parameters["a"]))) - own) == 0
