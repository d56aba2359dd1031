"""Equations of motion for other libraries: JAX, which differentiates and maps them, CasADi and opty for optimal control."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .system import System


class Exported:
    """The equations of motion as a pure function ``rhs(t, y, p)`` of another library.

    Attributes
    ----------
    rhs : f(t, y, p)
        The rates of the state y for the parameters p.
    state : list of str
        Names of the components of y.
    parameters : dict from str to float
        Names of the components of p, in order, with the values of the model: the free parameters, of which those that follow are computed, then
        controls without a law and their derivatives, which have no values.
    p : array of shape (parameters,)
        These values.
    start : array of shape (n,)
        The state from which ``simulate`` starts, in this order; not a number where the model determines none.
    """

    def __init__(self, source: str, library: Any, names: tuple[list[str], list[str]]) -> None:
        space: dict[str, Any] = {}
        # The text begins with the import of NumPy, of which only these two arrays are made.
        exec(compile(source, "<chetaev>", "exec"), space)
        self.start: NDArray[np.float64] = space["start"]
        self.p: NDArray[np.float64] = space["parameters"]
        self.source = source
        self.state, known = names
        self.parameters: dict[str, float] = dict(zip(known, map(float, self.p)))
        space["np"] = library
        self.rhs: Callable[[Any, Any, Any], Any] = space["rhs"]

    def __repr__(self) -> str:
        return f"<rhs(t, y, p): y = ({', '.join(self.state)}), p = ({', '.join(self.parameters)})>"


def jax_library() -> Any:
    """JAX's NumPy."""
    import jax.numpy

    return jax.numpy


def casadi_library() -> Any:
    """CasADi's functions under the names that NumPy has for them."""
    import casadi as ca

    def array(rows: Any, dtype: Any = None) -> Any:
        columns = [ca.horzcat(*row) if isinstance(row, (list, tuple)) else row for row in rows]
        return ca.vertcat(*columns)

    def solve(matrix: Any, right: Any) -> Any:
        return ca.vertsplit(ca.solve(matrix, right))

    same = ("sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log", "sqrt", "sign")
    other = {
        "arcsin": "asin", "arccos": "acos", "arctan": "atan", "arctan2": "atan2", "arcsinh": "asinh", "arccosh": "acosh",
        "arctanh": "atanh", "abs": "fabs",
    }
    functions = {name: getattr(ca, name) for name in same} | {ours: getattr(ca, theirs) for ours, theirs in other.items()}
    return SimpleNamespace(array=array, linalg=SimpleNamespace(solve=solve), pi=ca.pi, nan=float("nan"), **functions)


def names_of(source: str) -> tuple[list[str], list[str]]:
    """Names of the state and of the parameters, as the text of the function tells them."""
    found = []
    for head in ("y = (", "p = ("):
        _, _, rest = source.partition(f"    {head}")
        inside, _, _ = rest.partition(")\n")
        found.append([name.strip() for name in inside.split(",") if name.strip()])
    return found[0], found[1]


class Residuals:
    """Equations of the first order as opty takes them, in SymPy: what vanishes along the motion.

    ``opty.Problem(objective, gradient, own.equations, own.states, nodes, interval, known_parameter_map=own.parameters, time_symbol=own.time)``

    Attributes
    ----------
    equations : sympy.Matrix of shape (states, 1)
        Expressions in the states, their derivatives, the inputs, the parameters and the time.
    states : list of sympy functions of the time
        Coordinates, then speeds, then masses with a law of their own. A velocity that is a speed itself is called as its coordinate, with
        ``_dot`` behind.
    inputs : list of sympy functions of the time
        Controls without a law, which opty finds.
    parameters : dict from sympy symbols to float
        Free parameters, with the values of the model; those without a value are left out, and opty finds them.
    time : sympy.Symbol
        The time.
    """

    def __init__(self, system: System) -> None:
        import sympy as sp

        derived = system.derive("reduced")
        found = derived._in_sympy()["reduced"]
        shared = _shared([own for title, rows in found.items() if title.endswith(": linear systems") for own in rows])
        titles = ("equations of motion", "kinematics", "masses")
        rows = [own.lhs - own.rhs for title in titles for own in found.get(title, [])]
        rows = [own.xreplace(shared) for own in rows]
        time = next(own for row in rows for own in row.atoms(sp.Derivative)).variables[0]

        def function(name: str) -> Any:
            return sp.Function(name, real=True)(time)

        speeds = []
        for name in derived[0].state:
            if name.endswith("'"):
                place, speed = function(name[:-1]), function(f"{name[:-1]}_dot")
                rate = place.diff(time)
                rows = [own.xreplace({place.diff(time, 2): speed.diff(time)}).xreplace({rate: speed}) for own in rows]
                rows.append(rate - speed)
                speeds.append(speed)
            else:
                speeds.append(function(name))
        masses = [own.lhs.expr for own in found.get("masses", [])]
        states = [function(name) for name in system.coordinates] + speeds + masses
        follow = system.following
        values = dict(zip(follow, _plain(system, list(follow.values()))))
        own = {symbol: values[symbol.name] for row in rows for symbol in row.free_symbols if symbol.name in values}
        equations = sp.Matrix([row.xreplace(own) for row in rows])
        symbols = sorted(equations.free_symbols - {time}, key=str)
        known = {name: value for name, value in system.parameters.items() if value is not None}
        numbers = dict(zip(known, map(float, _plain(system, list(known.values())))))
        inputs = sorted(equations.atoms(sp.core.function.AppliedUndef) - set(states), key=str)
        back = system._own.back if system._own is not None else lambda own: own
        self.time: Any = back(time)
        self.states: list[Any] = [back(own) for own in states]
        self.inputs: list[Any] = [back(own) for own in inputs]
        self.equations: Any = equations.applyfunc(back)
        self.parameters: dict[Any, float] = {back(own): numbers[own.name] for own in symbols if own.name in numbers}

    def __repr__(self) -> str:
        return f"<{len(self.states)} residuals of {', '.join(own.func.__name__ for own in self.states)}>"


def _plain(system: System, texts: list[str]) -> list[Any]:
    """Texts of the model in SymPy, with the names of the model."""
    space: dict[str, Any] = {}
    exec(compile(system._native.sympy(texts), "<chetaev>", "exec"), space)
    return list(space["found"]["all"])


def _shared(equations: list[Any]) -> dict[Any, Any]:
    """Solutions of linear systems that equations share, one after the other: each may have those before it in its coefficients."""
    import sympy as sp

    known: dict[Any, Any] = {}
    open_rows = [own.lhs - own.rhs for own in equations]
    names = {own for row in open_rows for own in _unknowns(row)}
    while open_rows:
        first = min(range(len(open_rows)), key=lambda at: len(_unknowns(open_rows[at]) - set(known)))
        block, own = [], _unknowns(open_rows[first]) - set(known)
        for row in open_rows:
            if _unknowns(row) - set(known) <= own:
                block.append(row)
        if len(block) != len(own):
            raise NotImplementedError("the shortest equations share solutions of linear systems that stand in no residual")
        ordered = sorted(own, key=str)
        matrix, right = sp.linear_eq_to_matrix([row.xreplace(known) for row in block], ordered)
        known.update(zip(ordered, matrix.LUsolve(right)))
        open_rows = [row for row in open_rows if row not in block]
    assert names <= set(known)
    return known


def _unknowns(row: Any) -> set[Any]:
    import sympy as sp

    return {own for own in row.atoms(sp.Symbol) if own.name.startswith("reduced_s_")}
