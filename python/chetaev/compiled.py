"""Equations of motion as functions of NumPy arrays."""

from __future__ import annotations

import functools
from typing import TYPE_CHECKING, Any

from . import chetaev_native as native
from . import notebook
from .results import Shown

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from .chetaev_native import Function
    from .shapes import Vector
    from .system import System


class Compiled(Shown):
    """The equations of motion of a system as machine code.

    The state ``y`` is (coordinates, masses with a law of their own, velocities); ``state`` names its components. All functions take
    the time first, one state of shape (n,) or many of shape (…, n), and write into ``out`` where it is given. Where the equations
    have no solution the values are not finite: not a number, or infinite where a number is divided by zero.

    Attributes
    ----------
    rhs : f(t, y, out=None)
        The rates of the state, shape (…, n): ``scipy.integrate.solve_ivp(f.rhs, (0, 10), f.start, jac=f.jac)``.
    system : System
        The system, with the values that the functions have.
    state : list of str
        Names of the n components of y.
    parameters : dict from str to float
        The free parameters with their values, in SI units where the model states units; those that follow from them are computed from them.
    constraints : list of str
        Names of the constraints, for ``reactions`` and ``residuals``.
    names : list of str
        What ``definitions`` computes.

    Notes
    -----
    Arrays of other libraries are taken where they lie, if they offer DLPack on the CPU. Each function has an ``address`` for callers that know
    C only: ``void f(double t, double *y, double *values, double *data)``, the signature of Numba's and numbalsoda's right-hand sides. The last argument
    is the function's array ``data`` of shape (1 + parameters,): it says which function is meant, and has the parameters after that. It is one array,
    the same at each access. Parameters changed in it hold for calls by the address that hand it over, and not for ``f.rhs(t, y)``; what it
    says first may not be changed. It keeps the function, so that calls with it serve as long as it lives.
    SciPy's ``LowLevelCallable`` serves quadratures alone; ``solve_ivp`` takes ``f.rhs`` itself. Many states are rows here: ``solve_ivp`` with
    ``vectorized=True`` has them as columns, and takes ``lambda t, y: f.rhs(t, y.T).T``.

    Examples
    --------
    >>> from scipy.integrate import solve_ivp
    >>> import chetaev
    >>> f = chetaev.System.from_gallery("chaplygin-sleigh").compile()
    >>> solve_ivp(f.rhs, (f.t_start, 10), f.start, method="Radau", jac=f.jac).success
    True
    """

    def __init__(self, system: System) -> None:
        self.system = system
        self._native = system._anew().compile()
        self.parameters: dict[str, float] = dict(self._native.parameters)
        self.state: list[str] = self._native.state
        self.constraints: list[str] = self._native.constraints
        self.names: list[str] = self._native.definitions
        # An attribute, and no property: it is asked for before each call.
        self.rhs: Function = self._native.function("rates")
        self._known: dict[str, Function] = {"rates": self.rhs}

    @functools.cached_property
    def _start(self) -> tuple[float, list[float]]:
        return self.system._anew().start()

    @property
    def start(self) -> Vector:
        """The state from which ``simulate`` starts, shape (n,): what the model gives, and the rest from the constraints.

        Raises
        ------
        ModelError
            Where no state satisfies the constraints.
        """
        import numpy as np

        return np.array(self._start[1], dtype=np.float64)

    @property
    def t_start(self) -> float:
        """The time at which the motion starts."""
        return self._start[0]

    def _function(self, what: str) -> Function:
        if what not in self._known:
            # Of a model read anew, so that no function depends on which were asked for before.
            self._known[what] = self.system._anew().compile().function(what)
        return self._known[what]

    @property
    def jac(self) -> Function:
        """f(t, y, out=None): derivatives of the rates by the state, exact, shape (…, n, n); ``[..., i, j]`` is that of rate i by component j."""
        return self._function("jacobian")

    @property
    def mass_matrix(self) -> Function:
        """f(t, y, out=None): ∂²L/∂v∂v, shape (…, coordinates, coordinates)."""
        return self._function("mass")

    @property
    def reactions(self) -> Function:
        """f(t, y, out=None): the multipliers, shape (…, constraints), in the order of ``constraints``; zero for redundant ones."""
        return self._function("reactions")

    @property
    def residuals(self) -> Function:
        """f(t, y, out=None): what the constraints leave, shape (…, constraints), in the order of ``constraints``; zero at admissible states."""
        return self._function("residuals")

    @property
    def definitions(self) -> Function:
        """f(t, y, out=None): what the model defines by names, and its sensors, shape (…, names), in the order of ``names``."""
        return self._function("definitions")

    @property
    def is_native(self) -> bool:
        """Whether machine code runs, and not the interpreter."""
        return self.rhs.is_native

    def __call__(self, y: ArrayLike, t: ArrayLike = 0.0, out: Any = None) -> NDArray[np.float64]:
        """The rates of one state, or of many.

        Parameters
        ----------
        y : array of shape (..., n)
            States, in the order of ``state``, in SI units.
        t : float or array of shape (...)
            Times.
        out : array of shape (..., n), optional
            Where the rates are written.

        Returns
        -------
        array of shape (..., n)
            The rates, in SI units per second.
        """
        return self.rhs(t, y, out)

    def __reduce__(self) -> tuple[Any, ...]:
        return Compiled, (self.system,)

    def _html(self) -> str:
        said = notebook.paragraph(f"{self.system.name}: the rates of y = ({', '.join(self.state)})")
        return said + notebook.table(["parameter", "value"], [(notebook.code(name), value) for name, value in self.parameters.items()])

    def __repr__(self) -> str:
        return f"<Compiled {self.system.name}: y = ({', '.join(self.state)})>"


def function(text: tuple[str, str, Any, Any], what: str, parameters: list[float]) -> Function:
    """A function again that was pickled: of a model, by its name, with the values of its parameters."""
    return native.Model.from_texts(*text).compile().function(what, parameters)
