"""Steady motions in SymPy and in LaTeX."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from .formulas import NAME, aligned, constants, expression, typeset, words

if TYPE_CHECKING:
    from .system import System


def in_sympy(system: System, data: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Values, equations and conditions of the motions by their names, as ``Steady.to_sympy`` gives them."""
    free = {name for motion in data["motions"] for name in motion["free"]}
    speeds = [own["name"] for own in data["speeds"]]
    declared = {*system.coordinates, *system.parameters, *system.masses}
    # Names that the model has not declared: parameters of families, and speeds.
    variables = sorted(name for name in {*free, *speeds} if NAME.fullmatch(name) and name not in declared)
    found = {}
    for motion in data["motions"]:
        exact = {own["name"]: own["exact"] for own in motion["values"] if own.get("exact") is not None}
        parts = [list(exact.values()), motion["equations"], motion["not_negative"]]
        values, equations, conditions = (constants(system.sympify(own, variables=variables), free) if own else [] for own in parts)
        known = {**dict(zip(exact, values)), **_enclosed(motion["values"])}
        found[motion["name"]] = {
            "values": {own["name"]: known[own["name"]] for own in motion["values"] if own["name"] in known},
            "equations": equations,
            "not_negative": conditions,
        }
    return found


def _enclosed(values: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """Numbers that have no formula, with as many digits as are certain; 15 where they were found in double precision."""
    import sympy as sp

    found = {}
    for own in values:
        if own.get("exact") is None and own.get("enclosure"):
            low, high = (sp.Rational(end) for end in own["enclosure"])
            found[own["name"]] = sp.Float((low + high) / 2, 20)
        elif own.get("exact") is None and own.get("value") is not None:
            found[own["name"]] = sp.Float(own["value"], 15)
    return found


def latex(motions: Mapping[str, Mapping[str, Any]]) -> str:
    """The motions one below the other, a line for each value, equation and condition."""
    shown = []
    for name, motion in motions.items():
        rows = [f"{typeset(variable)} &= {expression(value)}" for variable, value in motion["values"].items()]
        rows += [f"{expression(own)} &= 0" for own in motion["equations"]]
        rows += [f"{expression(own)} &\\ge 0" for own in motion["not_negative"]]
        shown.append(f"{words(name)}\\colon\\quad\n{aligned(rows)}")
    return "\n\\\\\n".join(shown)
