"""Equations of motion as functions of NumPy arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from .chetaev_native import Function
    from .system import System


class Compiled:
    """The equations of motion of a system as machine code.

    The state ``y`` is (coordinates, masses with a law of their own, velocities); ``state`` names its components. All functions take
    the time first, one state of shape (n,) or many of shape (…, n), and write into ``out`` where it is given. Where the equations
    have no solution the values are not a number.

    Attributes
    ----------
    rhs : f(t, y, out=None)
        The rates of the state, shape (…, n): ``scipy.integrate.solve_ivp(f.rhs, (0, 10), y0, jac=f.jac)``.
    jac : f(t, y, out=None)
        Their derivatives by the state, exact, shape (…, n, n).
    mass_matrix : f(t, y, out=None)
        ∂²L/∂v∂v, shape (…, coordinates, coordinates).
    reactions : f(t, y, out=None)
        The multipliers of the constraints, in the order of ``constraints``; zero for redundant ones.
    residuals : f(t, y, out=None)
        What the constraints leave, in the same order.
    definitions : f(t, y, out=None)
        What the model defines by names, and its sensors, in the order of ``names``.

    Notes
    -----
    Arrays of other libraries are taken where they lie, if they offer DLPack on the CPU. Each function has an ``address`` for callers that know
    C only: ``void f(double t, double *y, double *values, double *data)``, the signature of Numba's and numbalsoda's right-hand sides. The last argument
    is the function's array ``data``: it says which function is meant, and has the parameters after that, which may be changed.
    SciPy's ``LowLevelCallable`` serves quadratures alone; ``solve_ivp`` takes ``f.rhs`` itself.
    """

    def __init__(self, system: System, values: Mapping[str, float]) -> None:
        self.system = system
        self._native = system._native.compile()
        self._values = dict(values)
        known = self._native.parameters
        unknown = [name for name in values if name not in dict(known)]
        if unknown:
            raise ValueError(f"`{unknown[0]}` is no parameter; there are {', '.join(name for name, _ in known)}")
        self.parameters: dict[str, float] = {name: float(values.get(name, own)) for name, own in known}
        self.state: list[str] = self._native.state
        self.constraints: list[str] = self._native.constraints
        self.names: list[str] = self._native.definitions
        self._known: dict[str, Function] = {}
        self.rhs = self._function("rates")

    def _function(self, what: str) -> Function:
        if what not in self._known:
            self._known[what] = self._native.function(what, list(self.parameters.values()))
        return self._known[what]

    @property
    def jac(self) -> Function:
        return self._function("jacobian")

    @property
    def mass_matrix(self) -> Function:
        return self._function("mass")

    @property
    def reactions(self) -> Function:
        return self._function("reactions")

    @property
    def residuals(self) -> Function:
        return self._function("residuals")

    @property
    def definitions(self) -> Function:
        return self._function("definitions")

    @property
    def is_native(self) -> bool:
        """Whether machine code runs, and not the interpreter."""
        return self.rhs.is_native

    def __call__(self, y: ArrayLike, t: ArrayLike = 0.0, out: Any = None) -> NDArray[np.float64]:
        """The rates of one state, or of many."""
        return self.rhs(t, y, out)

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (self.system, self._values)

    def __repr__(self) -> str:
        return f"<Compiled {self.system.name}: y = ({', '.join(self.state)})>"


def _again(system: System, values: dict[str, float]) -> Compiled:
    return Compiled(system, values)
