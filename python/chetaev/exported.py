"""Equations of motion for other libraries: JAX, which differentiates and maps them, CasADi and opty for optimal control."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from . import notebook
from .errors import NotDerivedError
from .results import Shown
from .trees import nodes, replaced

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .chetaev_native import Model
    from .results import Formulation
    from .shapes import Vector
    from .system import System


class Exported(Shown):
    """The equations of motion as a pure function ``rhs(t, y, p)`` of another library.

    Attributes
    ----------
    source : str
        The text of the function, as ``derive --as python`` writes it.
    rhs : f(t, y, p)
        The rates of the state y for the parameters p.
    state : list of str
        Names of the components of y.
    parameters : dict from str to float
        Names of the components of p, in order, with the values of the model: the free parameters, of which those that follow are computed, then
        controls without a law and their derivatives, which have no values.
    p : array of shape (parameters,)
        These values.
    formulation : str
        Whose equations these are.
    start : array of shape (n,)
        The state from which ``simulate`` starts, in this order; not a number where the model determines none.
    """

    def __init__(self, source: str, library: Callable[[], Any], names: tuple[list[str], list[str]], formulation: str) -> None:
        self.formulation = formulation
        self._library = library
        space: dict[str, Any] = {}
        # The text begins with the import of NumPy, of which only these two arrays are made.
        exec(compile(source, "<chetaev>", "exec"), space)
        self.start: Vector = space["start"]
        self.p: Vector = space["parameters"]
        self.source = source
        self.state, known = names
        self.parameters: dict[str, float] = dict(zip(known, map(float, self.p)))
        space["np"] = library()
        self.rhs: Callable[[Any, Any, Any], Any] = space["rhs"]

    def __reduce__(self) -> tuple[Any, ...]:
        known = next(name for name, own in _LIBRARIES.items() if own is self._library)
        return _exported, (self.source, known, (self.state, list(self.parameters)), self.formulation)

    def __repr__(self) -> str:
        return f"<rhs(t, y, p): y = ({', '.join(self.state)}), p = ({', '.join(self.parameters)})>"

    def _html(self) -> str:
        rows = [("y", name, float(value)) for name, value in zip(self.state, self.start)]
        rows += [("p", name, value) for name, value in self.parameters.items()]
        shown = notebook.paragraph(f"rhs(t, y, p), the rates of y by the form {self.formulation}")
        text = notebook.preformatted(self.source)
        return shown + notebook.table(["", "component", "start or value"], rows) + notebook.unfolding("its text", text)


#: Forms of the equations in which functions are written, the shortest first.
_FORMS = ("reduced", "maggi", "routh", "gibbs-appell")


def regular_form(model: Model) -> tuple[str, str]:
    """The first form of the equations that has numbers where the motion starts, with its function; the first of all where none has, or where a value
    is missing."""
    first: tuple[str, str] | None = None
    for name in _FORMS:
        try:
            source = model.derive([name], False, "python")[0]
        except NotDerivedError:
            continue
        first = first or (name, source)
        if _is_regular(source, model):
            return name, source
    if first is None:
        raise NotDerivedError("no form of the equations can be written as a function")
    return first


def _is_regular(source: str, model: Model) -> bool:
    space: dict[str, Any] = {}
    exec(compile(source, "<chetaev>", "exec"), space)
    start, parameters = space["start"], space["parameters"]
    if not (np.all(np.isfinite(start)) and np.all(np.isfinite(parameters))):
        # Nothing can be said, and another form has no more numbers.
        return True
    with np.errstate(all="ignore"):
        try:
            rates = space["rhs"](model.start()[0], start, parameters)
        except (np.linalg.LinAlgError, ZeroDivisionError):
            return False
    return bool(np.all(np.isfinite(rates)))


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


#: The libraries of which functions are made.
_LIBRARIES = {"jax": jax_library, "casadi": casadi_library}


def _exported(source: str, library: str, names: tuple[list[str], list[str]], formulation: str) -> Exported:
    """A function again that was pickled."""
    return Exported(source, _LIBRARIES[library], names, formulation)


def names_of(source: str) -> tuple[list[str], list[str]]:
    """Names of the state and of the parameters, as the text of the function tells them."""
    found = []
    for head in ("y = (", "p = ("):
        _, _, rest = source.partition(f"    {head}")
        inside, _, _ = rest.partition(")\n")
        found.append([name.strip() for name in inside.split(",") if name.strip()])
    return found[0], found[1]


class Residuals(Shown):
    """Equations of the first order as opty takes them, in SymPy: what vanishes along the motion.

    ``opty.Problem(objective, gradient, own.equations, own.states, nodes, interval, known_parameter_map=own.parameters, time_symbol=own.time)``

    Attributes
    ----------
    equations : sympy.Matrix of shape (states + unknowns, 1)
        Expressions in the states, their derivatives, the unknowns, the inputs, the parameters and the time.
    states : list of sympy functions of the time
        Coordinates, then speeds, then masses with a law of their own. A velocity that is a speed itself is called as its coordinate, with
        ``_dot`` behind.
    unknowns : list of sympy functions of the time
        The multipliers of the constraints, where the shortest equations share linear systems, as those of a bicycle do: then these are Routh's
        equations with all velocities as speeds, and the constraints are the last of the equations. opty finds these functions as it finds inputs.
        Other systems have none.
    inputs : list of sympy functions of the time
        Controls without a law, which opty finds.
    parameters : dict from sympy symbols to float
        Free parameters, with the values of the model; those without a value are left out, and opty finds them.
    time : sympy.Symbol
        The time.
    """

    def __init__(self, system: System) -> None:
        import sympy as sp

        derived, found = _stated(system)
        rows = [own.lhs - own.rhs for title in ("equations of motion", "kinematics", "masses", "constraints") for own in found.get(title, [])]
        time = next(own for own in nodes(rows) if isinstance(own, sp.Derivative)).variables[0]

        def function(name: str) -> Any:
            return sp.Function(name, real=True)(time)

        multipliers = {f"lambda_{name}" for name in system.constraints} if derived.name == "routh" else set()
        met = {own.name: own for own in nodes(rows) if isinstance(own, sp.Symbol) and own.name in multipliers}
        unknowns = {own: function(name) for name, own in sorted(met.items())}
        whole, added = replaced(rows, unknowns), []
        count = len(rows) - len(found["constraints"]) if unknowns else len(rows)
        speeds = []
        for name in derived.state:
            if name.endswith("'"):
                place, speed = function(name[:-1]), function(f"{name[:-1]}_dot")
                rate = place.diff(time)
                whole = replaced(replaced(whole, {place.diff(time, 2): speed.diff(time)}), {rate: speed})
                added.append(rate - speed)
                speeds.append(speed)
            else:
                speeds.append(function(name))
        masses = [own.lhs.expr for own in found.get("masses", [])]
        states = [function(name) for name in system.coordinates] + speeds + masses
        follow = system.following
        values = dict(zip(follow, system._in_sympy(list(follow.values()))))
        whole = [*whole[:count], *added, *whole[count:]]
        symbols = [own for own in nodes(whole) if isinstance(own, sp.Symbol)]
        whole = replaced(whole, {own: values[own.name] for own in symbols if own.name in values})
        parts = nodes(whole)
        known = {name: value for name, value in system.parameters.items() if value is not None}
        numbers = dict(zip(known, map(float, system._in_sympy(list(known.values())))))
        free = sorted((own for own in parts if isinstance(own, sp.Symbol) and own.name in numbers), key=str)
        given = {*states, *unknowns.values()}
        inputs = sorted((own for own in parts if isinstance(own, sp.core.function.AppliedUndef) and own not in given), key=str)
        back = system._own.back if system._own is not None else lambda own: own
        self.time: Any = back(time)
        self.states: list[Any] = [back(own) for own in states]
        self.unknowns: list[Any] = list(unknowns.values())
        self.inputs: list[Any] = [back(own) for own in inputs]
        self.equations: Any = sp.Matrix([back(own) for own in whole])
        self.parameters: dict[Any, float] = {back(own): numbers[own.name] for own in free}

    def __repr__(self) -> str:
        return f"<{self.equations.rows} residuals of {', '.join(own.func.__name__ for own in self.states)}>"

    def _html(self) -> str:
        rows = [(str(at + 1), notebook.code(str(own))) for at, own in enumerate(self.equations)]
        found = {"states": self.states, "unknowns": self.unknowns, "inputs": self.inputs}
        named: list[tuple[str, Any]] = [(name, ", ".join(str(own.func.__name__) for own in list_)) for name, list_ in found.items() if list_]
        named += [(str(name), value) for name, value in self.parameters.items()]
        return notebook.table(["", "vanishes along the motion"], rows) + notebook.unfolding("what occurs", notebook.table([], named))

    def _latex(self) -> str | None:
        import sympy as sp

        rows = " \\\\\n".join(f"{sp.latex(own)} &= 0" for own in self.equations)
        return f"\\begin{{aligned}}\n{rows}\n\\end{{aligned}}"


def _stated(system: System) -> tuple[Formulation, dict[str, list[Any]]]:
    """The equations of which residuals are made: the shortest; Routh's where these share linear systems, which opty would have to write out."""
    for name in ("reduced", "routh"):
        derived = system.derive(name)
        found = derived._module().sections[name]
        if name == "reduced":
            used = ("equations of motion", "kinematics", "masses")
        else:
            # The formulas of the multipliers are not needed: they are unknowns.
            used = ("equations of motion", "constraints", "masses")
        if not any(f"{title}: linear systems" in found for title in used):
            return derived[0], {title: found[title] for title in used if title in found}
    raise NotImplementedError("the equations of this system share solutions of linear systems in every form that is tried: reduced, Routh's")
