"""Systems that are stated in SymPy: Lagrangians, and the objects of ``sympy.physics.mechanics``."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef

from .texts import of_sympy

#: Names that a model cannot declare.
_RESERVED = set(
    "t pi sum sin cos tan cot sec csc asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp log ln sqrt abs sign".split()
)
_GREEK = {
    "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "ε": "epsilon", "θ": "theta", "λ": "lamda", "μ": "mu",
    "ρ": "rho", "σ": "sigma", "τ": "tau", "φ": "phi", "ψ": "psi", "ω": "omega",
}


class Statement:
    """A system stated in SymPy, as the sections of a model.

    Parameters
    ----------
    lagrangian : expression
        L as a function of coordinates and their derivatives.
    coordinates : sequence of functions of the time
        The coordinates.
    constraints : sequence of expressions that vanish, or equations; or a mapping from names to these
        Constraints on coordinates and their derivatives.
    forces : mapping from coordinates to expressions
        Generalized forces that are not in the Lagrangian.
    parameters : mapping from symbols or names to values
        Values of parameters; those without stay symbols.
    """

    def __init__(
        self,
        lagrangian: Any,
        coordinates: Sequence[Any],
        *,
        constraints: Mapping[str, Any] | Iterable[Any] = (),
        forces: Mapping[Any, Any] | None = None,
        parameters: Mapping[Any, Any] | None = None,
    ) -> None:
        named = constraints if isinstance(constraints, Mapping) else {
            f"constraint_{number}": own for number, own in enumerate(constraints, 1)
        }
        equations = {name: own if isinstance(own, sp.Equality) else sp.Eq(own, 0, evaluate=False) for name, own in named.items()}
        forces = dict(forces or {})
        self._coordinates = [sp.sympify(own) for own in coordinates]
        for own in self._coordinates:
            if not isinstance(own, AppliedUndef):
                raise ValueError(f"{own} is no function of the time, and no coordinate: use dynamicsymbols")
        values = {str(key): own for key, own in (parameters or {}).items()}
        whole = [sp.sympify(lagrangian), *equations.values(), *map(sp.sympify, forces.values())]
        clock = {own.args[0] for own in self._coordinates}
        symbols = set().union(*(own.free_symbols for own in whole)) - clock
        functions = set().union(*(own.atoms(AppliedUndef) for own in whole)) - set(self._coordinates)
        for own in functions:
            raise ValueError(f"{own} is neither a coordinate nor a parameter")
        self.names = _names([own.func.__name__ for own in self._coordinates] + sorted(own.name for own in symbols))
        self._rename = {own: sp.Function(self.names[own.func.__name__])(*own.args) for own in self._coordinates}
        self._rename |= {own: sp.Symbol(self.names[own.name]) for own in symbols}
        self.coordinates = [self.names[own.func.__name__] for own in self._coordinates]
        self.sections: dict[str, Any] = {
            "coordinates": self.coordinates,
            "parameters": {
                self.names[own.name]: values.get(own.name, {}) for own in sorted(symbols, key=lambda own: str(own.name))
            },
            "lagrangian": {"L": self.text(lagrangian)},
            "constraints": {name: self.text(own) for name, own in equations.items()},
            "forces": {self.names[key.func.__name__]: self.text(own) for key, own in forces.items() if own != 0},
        }
        self.sections = {key: own for key, own in self.sections.items() if own}

    def text(self, expression: Any) -> str:
        """An expression in the names of the model."""
        return of_sympy(sp.sympify(expression).xreplace(self._rename))


def _names(wanted: Iterable[str]) -> dict[str, str]:
    """Names that a model can declare, no two the same."""
    taken: set[str] = set()
    found: dict[str, str] = {}
    for name in wanted:
        plain = "".join(_GREEK.get(letter, letter) for letter in name)
        plain = re.sub(r"[^A-Za-z0-9_]+", "_", re.sub(r"[{}\\]", "", plain)).strip("_") or "x"
        if plain[0].isdigit() or plain in _RESERVED or plain.startswith(("lambda_", "kappa_")) or plain == "lambda":
            plain = f"x_{plain}"
        own, number = plain, 2
        while own in taken:
            own, number = f"{plain}_{number}", number + 1
        taken.add(own)
        found[name] = own
    return found


def of_bodies(
    frame: Any,
    coordinates: Sequence[Any],
    speeds: Sequence[Any],
    kinematics: Sequence[Any],
    bodies: Iterable[Any],
    loads: Iterable[Any],
    *,
    holonomic: Iterable[Any] = (),
    velocity: Iterable[Any] = (),
    parameters: Mapping[Any, Any] | None = None,
) -> Statement:
    """A system of bodies and loads, with generalized speeds u and kinematical equations that vanish."""
    t = coordinates[0].args[0]
    rates = [own.diff(t) for own in coordinates]
    speeds = list(speeds)
    # The kinematical equations are linear in the speeds.
    matrix, right = sp.linear_eq_to_matrix(list(kinematics), speeds)
    solved = dict(zip(speeds, matrix.LUsolve(right), strict=True)) if speeds != rates else {}

    def in_rates(expression: Any) -> Any:
        return sp.sympify(expression).subs(solved).doit() if solved else sp.sympify(expression)

    kinetic = sum((own.kinetic_energy(frame) for own in bodies), sp.S.Zero)
    # Velocities may be stated by rates or by speeds.
    forces: dict[Any, Any] = {own: sp.S.Zero for own in coordinates}
    for place, force in loads:
        moved = place.ang_vel_in(frame) if hasattr(place, "ang_vel_in") else place.vel(frame)
        components = moved.to_matrix(frame).applyfunc(in_rates)
        applied = force.to_matrix(frame).applyfunc(in_rates)
        for own, rate in zip(coordinates, rates, strict=True):
            forces[own] += sum((f * v.diff(rate) for f, v in zip(applied, components, strict=True)), sp.S.Zero)
    constraints = {f"position_{number}": own for number, own in enumerate(holonomic, 1)}
    constraints |= {f"velocity_{number}": in_rates(own) for number, own in enumerate(velocity, 1)}
    return Statement(in_rates(kinetic), coordinates, constraints=constraints, forces=forces, parameters=parameters)


def statement(what: Any, parameters: Mapping[Any, Any] | None = None) -> Statement:
    """What a ``KanesMethod``, a ``LagrangesMethod`` or a ``System`` of ``sympy.physics.mechanics`` states."""
    import sympy.physics.mechanics as me

    if isinstance(what, me.LagrangesMethod):
        return _of_lagrange(what, parameters)
    if isinstance(what, me.KanesMethod):
        return of_bodies(
            what._inertial, list(what.q), list(what.u), list(what._k_kqdot * sp.Matrix(what._qdot) + what._k_ku * sp.Matrix(what.u) + what._f_k),
            what.bodies, what.loads or [],
            holonomic=list(what._f_h),
            velocity=list(what._k_nh * sp.Matrix(what.u) + what._f_nh) if what._k_nh else [],
            parameters=parameters,
        )
    if type(what).__name__ == "System" and hasattr(what, "kdes"):
        loads = list(what.loads) + [own for actuator in what.actuators for own in actuator.to_loads()]
        return of_bodies(
            what.frame, list(what.q), list(what.u), list(what.kdes), list(what.bodies), loads,
            holonomic=list(what.holonomic_constraints), velocity=list(what.nonholonomic_constraints), parameters=parameters,
        )
    raise TypeError(f"{type(what).__name__} states no system that is known here")


def _of_lagrange(method: Any, parameters: Mapping[Any, Any] | None) -> Statement:
    coordinates = list(method.q)
    forces: dict[Any, Any] = {own: sp.S.Zero for own in coordinates}
    frame = method.inertial
    for place, force in method.forcelist or []:
        moved = place.ang_vel_in(frame) if hasattr(place, "ang_vel_in") else place.vel(frame)
        for own in coordinates:
            forces[own] += moved.diff(own.diff(), frame, var_in_dcm=False).dot(force)
    return Statement(sp.Matrix([method._L])[0], coordinates, constraints=list(method.coneqs), forces=forces, parameters=parameters)
