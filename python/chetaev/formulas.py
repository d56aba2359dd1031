"""Formulas that are printed in the notation of models: in SymPy and in LaTeX."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from .texts import FUNCTIONS
from .trees import nodes, replaced

if TYPE_CHECKING:
    from .system import System

#: A name.
NAME = re.compile(r"[^\W\d]\w*")
#: Letters as the other equations have them.
_VARIANTS = {"phi": "\\varphi", "epsilon": "\\varepsilon"}
#: What stands in formulas and is no name of anybody.
_WORDS = {*FUNCTIONS, "sqrt", "pi", "t", "sum", "where"}
#: What formulas call their parts: unknowns of linear systems, and what is defined below ``where``.
_UNKNOWN = re.compile(r"\b(?:s|z|y(?:aux)*)_\d+\b")
_DEFINED = re.compile(r"^\s*(\w+) = ", re.MULTILINE)


def introduced(system: System, texts: Iterable[str]) -> list[str]:
    """Names in formulas that the model has not declared: parameters of families, momenta, variations."""
    declared = {*system.coordinates, *system.parameters, *system.masses, *(f"lambda_{own}" for own in system.constraints)}
    found: set[str] = set()
    for own in texts:
        _, _, below = own.partition("\nwhere")
        found |= set(NAME.findall(own)) - set(_UNKNOWN.findall(below)) - set(_DEFINED.findall(below))
    return sorted(found - declared - _WORDS)


def in_sympy(system: System, texts: Iterable[str]) -> list[Any]:
    """Formulas, with what stands below ``where`` in each, as expressions; those with two sides as equations.

    Names that the model has not declared are functions of the time.
    """
    import sympy as sp

    found = []
    for own in texts:
        head, where, below = own.partition("\nwhere")
        sides = system.sympify([side + where + below for side in head.split(" = ")], variables=introduced(system, [own]))
        found.append(sides[0] if len(sides) == 1 else sp.Eq(*sides, evaluate=False))
    return found


def constants(expressions: list[Any], free: Iterable[str]) -> list[Any]:
    """Parameters of families are constants, and no functions of the time."""
    import sympy as sp
    from sympy.core.function import AppliedUndef

    constant = {
        own: sp.Symbol(own.func.__name__, real=True)
        for own in nodes(expressions) if isinstance(own, AppliedUndef) and own.func.__name__ in free
    }
    return replaced(expressions, constant)


def aligned(rows: Iterable[str]) -> str:
    """Rows with `&` where they are aligned, in an environment of amsmath."""
    return "\\begin{aligned}\n" + " \\\\\n".join(rows) + "\n\\end{aligned}"


def words(text: str) -> str:
    """Words among formulas."""
    return "\\text{" + re.sub(r"[#$%&_{}]", r"\\\g<0>", text) + "}"


def row(formula: Any) -> str:
    """A formula, aligned where its sides meet."""
    import sympy as sp

    if isinstance(formula, sp.Equality):
        return f"{expression(formula.lhs)} &= {expression(formula.rhs)}"
    return f"& {expression(formula)}"


def typeset(variable: str) -> str:
    """A variable: a name with its primes, or words."""
    name = variable.rstrip("'")
    if not NAME.fullmatch(name):
        return words(variable)
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


def expression(formula: Any) -> str:
    """An expression with names and dots in the place of functions of the time."""
    import sympy as sp
    from sympy.core.function import AppliedUndef

    shown = {}
    for own in nodes([formula]):
        if isinstance(own, sp.Derivative) and isinstance(own.expr, AppliedUndef):
            shown[own] = _dotted(_letter(own.expr.func.__name__), len(own.variables))
        elif isinstance(own, AppliedUndef):
            shown[own] = _letter(own.func.__name__)
        elif isinstance(own, sp.Symbol):
            shown[own] = _letter(own.name)
    # What has a brace in its name SymPy prints as it stands.
    plain = {own: sp.Symbol(text if "{" in text or len(text) == 1 else f"{{{text}}}") for own, text in shown.items()}
    return str(sp.latex(_put(formula, plain)))


def _put(expression: Any, shown: dict[Any, Any]) -> Any:
    """Derivatives before the functions in them, and the time in these last."""
    import sympy as sp

    found = [expression]
    for kind in (sp.Derivative, sp.core.function.AppliedUndef, sp.Symbol):
        found = replaced(found, {own: new for own, new in shown.items() if isinstance(own, kind)})
    return found[0]
