"""Steady motions in SymPy and in LaTeX."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from .trees import nodes, replaced

if TYPE_CHECKING:
    from .system import System

_NAME = re.compile(r"[^\W\d]\w*")
#: Letters as the other equations have them.
_VARIANTS = {"phi": "\\varphi", "epsilon": "\\varepsilon"}


def in_sympy(system: System, data: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """Values, equations and conditions of the motions by their names, as ``Steady.to_sympy`` gives them."""
    free = {name for motion in data["motions"] for name in motion["free"]}
    speeds = [own["name"] for own in data["speeds"]]
    declared = {*system.coordinates, *system.parameters, *system.masses}
    # Names that the model has not declared: parameters of families, and speeds.
    variables = sorted(name for name in {*free, *speeds} if _NAME.fullmatch(name) and name not in declared)
    found = {}
    for motion in data["motions"]:
        exact = {own["name"]: own["exact"] for own in motion["values"] if own.get("exact") is not None}
        parts = [list(exact.values()), motion["equations"], motion["not_negative"]]
        values, equations, conditions = (_constants(system.sympify(own, variables=variables), free) if own else [] for own in parts)
        known = {**dict(zip(exact, values)), **_enclosed(motion["values"])}
        found[motion["name"]] = {
            "values": {own["name"]: known[own["name"]] for own in motion["values"] if own["name"] in known},
            "equations": equations,
            "not_negative": conditions,
        }
    return found


def _constants(expressions: list[Any], free: Iterable[str]) -> list[Any]:
    """Parameters of families are constants, and no functions of the time."""
    import sympy as sp
    from sympy.core.function import AppliedUndef

    constant = {
        own: sp.Symbol(own.func.__name__, real=True)
        for own in nodes(expressions) if isinstance(own, AppliedUndef) and own.func.__name__ in free
    }
    return replaced(expressions, constant)


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
        rows = [f"{_name(variable)} &= {_expression(value)}" for variable, value in motion["values"].items()]
        rows += [f"{_expression(own)} &= 0" for own in motion["equations"]]
        rows += [f"{_expression(own)} &\\ge 0" for own in motion["not_negative"]]
        shown.append(f"\\text{{{name}}}\\colon\\quad\n\\begin{{aligned}}\n" + " \\\\\n".join(rows) + "\n\\end{aligned}")
    return "\n\\\\\n".join(shown)


def _name(variable: str) -> str:
    """A variable: a name with its primes, or words."""
    name = variable.rstrip("'")
    if not _NAME.fullmatch(name):
        return f"\\text{{{variable}}}"
    return _dotted(_letter(name), len(variable) - len(name))


def _letter(name: str) -> str:
    """A name with its subscripts, words upright."""
    import sympy as sp

    def part(own: str) -> str:
        found = _VARIANTS.get(own) or str(sp.latex(sp.Symbol(own)))
        return found if found.startswith("\\") or len(own) == 1 or own.isdigit() or "_" in found else f"\\mathrm{{{own}}}"

    base, *below = (part(own) for own in name.split("_") if own)
    return base if not below else f"{{{base}}}_{{{','.join(below)}}}"


def _dotted(name: str, count: int) -> str:
    return name if count == 0 else f"\\{'d' * count}ot{{{name}}}"


def _expression(expression: Any) -> str:
    """An expression with names and dots in the place of functions of the time."""
    import sympy as sp
    from sympy.core.function import AppliedUndef

    shown = {}
    for own in nodes([expression]):
        if isinstance(own, sp.Derivative) and isinstance(own.expr, AppliedUndef):
            shown[own] = _dotted(_letter(own.expr.func.__name__), len(own.variables))
        elif isinstance(own, AppliedUndef):
            shown[own] = _letter(own.func.__name__)
        elif isinstance(own, sp.Symbol):
            shown[own] = _letter(own.name)
    # What has a brace in its name SymPy prints as it stands.
    plain = {own: sp.Symbol(text if "{" in text or len(text) == 1 else f"{{{text}}}") for own, text in shown.items()}
    return str(sp.latex(_put(expression, plain)))


def _put(expression: Any, shown: dict[Any, Any]) -> Any:
    """Derivatives before the functions in them, and the time in these last."""
    import sympy as sp

    found = [expression]
    for kind in (sp.Derivative, sp.core.function.AppliedUndef, sp.Symbol):
        found = replaced(found, {own: new for own, new in shown.items() if isinstance(own, kind)})
    return found[0]
