"""Equations of motion as functions of other array libraries: JAX, which differentiates and maps them, and CasADi for optimal control."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


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
