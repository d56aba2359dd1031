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
        Names of the components of p, in order, with the values of the model.
    p : array of shape (parameters,)
        These values.
    start : array of shape (n,)
        The state at the start.
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

    Attributes
    ----------
    equations : sympy.Matrix of shape (states, 1)
        Expressions in the states, their derivatives, the parameters and the time.
    states : list of sympy functions of the time
        Coordinates, then speeds. A velocity that is a speed itself is called as its coordinate, with ``_dot`` behind.
    parameters : dict from sympy symbols to float
        With the values of the model.
    time : sympy.Symbol
        The time.
    """

    def __init__(self, system: System) -> None:
        import sympy as sp

        derived = system.derive("reduced")
        found = derived.to_sympy()["reduced"]
        rows = [own.lhs - own.rhs for title in ("equations of motion", "kinematics") for own in found.get(title, [])]
        if any(title.endswith(": linear systems") for title in found):
            raise NotImplementedError("the shortest equations share solutions of linear systems, which stand in no residual")
        self.time: Any = next(own for row in rows for own in row.atoms(sp.Derivative)).variables[0]

        def function(name: str) -> Any:
            return sp.Function(name, real=True)(self.time)

        speeds = []
        for name in derived[0].state:
            if name.endswith("'"):
                place, speed = function(name[:-1]), function(f"{name[:-1]}_dot")
                rate = place.diff(self.time)
                rows = [own.xreplace({place.diff(self.time, 2): speed.diff(self.time)}).xreplace({rate: speed}) for own in rows]
                rows.append(rate - speed)
                speeds.append(speed)
            else:
                speeds.append(function(name))
        self.states: list[Any] = [function(name) for name in system.coordinates] + speeds
        self.equations: Any = sp.Matrix(rows)
        symbols = self.equations.free_symbols - {self.time}
        values = {name: float(sp.sympify(value)) for name, value in system.compile().parameters.items()}
        self.parameters: dict[Any, float] = {own: values[own.name] for own in sorted(symbols, key=str)}

    def __repr__(self) -> str:
        return f"<{len(self.states)} residuals of {', '.join(own.func.__name__ for own in self.states)}>"
