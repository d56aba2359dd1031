"""SymPy expressions that share their parts: walked part by part, where SymPy walks every branch of the tree."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

#: An unknown of a linear system, as a module of SymPy expressions declares it.
_UNKNOWN = re.compile(r"^\w+ = sp\.Symbol\('(\w+)', real=True\)$", re.MULTILINE)


class Module:
    """A written module of SymPy expressions, as ``derive --as sympy`` gives it.

    Attributes
    ----------
    sections : dict from str to dicts
        Lists of expressions or equations by section and heading. Under a heading with ``: linear systems`` behind are the rows of linear systems
        in unknowns that are left as symbols.
    unknowns : set of str
        Names of these.
    """

    def __init__(self, source: str, sections: Iterable[str]) -> None:
        space: dict[str, Any] = {}
        exec(compile(source, "<chetaev>", "exec"), space)
        self.sections: dict[str, dict[str, list[Any]]] = {name: space[name] for name in sections}
        # The names of the model are declared before the first section.
        starts = [source.find(f"\n{name} = {{}}\n") for name in self.sections]
        self.unknowns = set(_UNKNOWN.findall(source[min(starts, default=0) :]))

    def is_unknown(self, symbol: Any) -> bool:
        """Whether a symbol is an unknown of a linear system."""
        return symbol.name in self.unknowns


def nodes(expressions: Iterable[Any]) -> list[Any]:
    """All parts of expressions, each once, parts of a part before it."""
    found: dict[Any, None] = {}
    for expression in expressions:
        stack = [(expression, False)]
        while stack:
            own, is_done = stack.pop()
            if own in found:
                continue
            if is_done or not own.args:
                found[own] = None
                continue
            stack.append((own, True))
            stack.extend((part, False) for part in own.args if part not in found)
    return list(found)


def replaced(expressions: Sequence[Any], replacements: Mapping[Any, Any]) -> list[Any]:
    """Expressions with parts replaced, as ``xreplace`` does."""
    image: dict[Any, Any] = {}
    for own in nodes(expressions):
        if own in replacements:
            image[own] = replacements[own]
        elif own.args:
            parts = [image[part] for part in own.args]
            image[own] = own if all(a is b for a, b in zip(parts, own.args)) else own.func(*parts)
        else:
            image[own] = own
    return [image[own] for own in expressions]


def solved(equations: Iterable[Any], is_unknown: Callable[[Any], bool]) -> dict[Any, Any]:
    """The unknowns of linear systems as functions of the rest, by Cramer's rule: nothing is divided by but determinants.

    Parameters
    ----------
    equations : iterable of sympy.Eq
        The rows of one system after those of the other. The coefficients of each may contain the unknowns of those before it.
    is_unknown : f(symbol)
        Whether a symbol is an unknown.
    """
    import sympy as sp

    known: dict[Any, Any] = {}
    rows: list[Any] = []
    own: list[Any] = []
    for row in equations:
        row = row.lhs - row.rhs
        rows.append(row)
        met = sorted((one for one in nodes([row]) if isinstance(one, sp.Symbol) and is_unknown(one)), key=str)
        own += [one for one in met if one not in known and one not in own]
        if len(rows) == len(own):
            known.update(_cramer(replaced(rows, known), own))
            rows, own = [], []
    if rows:
        raise ValueError("the rows of a linear system do not determine its unknowns")
    return known


def _cramer(rows: Sequence[Any], unknowns: Sequence[Any]) -> dict[Any, Any]:
    import sympy as sp

    none = dict.fromkeys(unknowns, sp.S.Zero)
    # Rows are linear: a coefficient is the derivative, and the derivative of a sum that shares parts is taken by its terms.
    matrix = [[_coefficient(row, one) for one in unknowns] for row in rows]
    right = [-own for own in replaced(list(rows), none)]
    whole = _determinant(matrix)
    found = {}
    for place, one in enumerate(unknowns):
        other = [[b if k == place else a for k, a in enumerate(row)] for row, b in zip(matrix, right)]
        found[one] = _determinant(other) / whole
    return found


def _coefficient(row: Any, unknown: Any) -> Any:
    """Of a symbol in a sum of products, in each of which it stands once at most."""
    import sympy as sp

    if row == unknown:
        return sp.S.One
    if unknown not in nodes([row]):
        return sp.S.Zero
    if row.is_Add:
        return sp.Add(*(_coefficient(own, unknown) for own in row.args))
    if row.is_Mul:
        parts = [own for own in row.args if unknown in nodes([own])]
        if len(parts) == 1:
            return sp.Mul(*(own for own in row.args if own is not parts[0]), _coefficient(parts[0], unknown))
    raise ValueError(f"{unknown} does not stand in a linear equation")


def _determinant(matrix: Sequence[Sequence[Any]]) -> Any:
    """By the first row that is left, each minor once."""
    import sympy as sp

    minors: dict[tuple[int, ...], Any] = {(): sp.S.One}

    def minor(columns: tuple[int, ...]) -> Any:
        if columns not in minors:
            row = matrix[len(matrix) - len(columns)]
            terms = [
                (-1) ** place * row[column] * minor(columns[:place] + columns[place + 1 :])
                for place, column in enumerate(columns)
                if row[column] != 0
            ]
            minors[columns] = sp.Add(*terms)
        return minors[columns]

    return minor(tuple(range(len(matrix))))
