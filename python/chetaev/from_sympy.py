"""Systems that are stated in SymPy: Lagrangians, and the objects of ``sympy.physics.mechanics``."""

from __future__ import annotations

import random
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
    controls : iterable of functions of the time
        Arbitrary functions of the time that are no coordinates.
    definitions : mapping from functions of the time to expressions
        Names for what is long.
    """

    def __init__(
        self,
        lagrangian: Any,
        coordinates: Sequence[Any],
        *,
        constraints: Mapping[str, Any] | Iterable[Any] = (),
        forces: Mapping[Any, Any] | None = None,
        parameters: Mapping[Any, Any] | None = None,
        controls: Iterable[Any] = (),
        definitions: Mapping[Any, Any] | None = None,
    ) -> None:
        listed = constraints if isinstance(constraints, Mapping) else {
            f"constraint_{number}": own for number, own in enumerate(constraints, 1)
        }
        equations = {name: own if isinstance(own, sp.Equality) else sp.Eq(own, 0, evaluate=False) for name, own in listed.items()}
        forces = dict(forces or {})
        self._coordinates = [sp.sympify(own) for own in coordinates]
        for own in self._coordinates:
            if not isinstance(own, AppliedUndef):
                raise ValueError(f"{own} is no function of the time, and no coordinate: use dynamicsymbols")
        values = {str(key): own for key, own in (parameters or {}).items()}
        named = dict(definitions or {})
        whole = [sp.sympify(own) for own in [lagrangian, *equations.values(), *forces.values(), *named.values()]]
        clock = {own.args[0] for own in self._coordinates}
        symbols = set().union(*(own.free_symbols for own in whole)) - clock
        known = sorted(set(controls), key=str)
        functions = _functions(whole) - set(self._coordinates) - set(named)
        known = [own for own in known if own in functions]
        for own in functions - set(known):
            raise ValueError(f"{own} is neither a coordinate nor a parameter")
        moving = [*self._coordinates, *known, *named]
        self.names = _names([own.func.__name__ for own in moving] + sorted(own.name for own in symbols))
        self._rename = {own: sp.Function(self.names[own.func.__name__])(*own.args) for own in moving}
        self._rename |= {own: sp.Symbol(self.names[own.name]) for own in symbols}
        self.coordinates = [self.names[own.func.__name__] for own in self._coordinates]
        self.sections: dict[str, Any] = {
            "coordinates": self.coordinates,
            "parameters": {
                self.names[own.name]: values.get(own.name, {}) for own in sorted(symbols, key=lambda own: str(own.name))
            },
            "controls": {self.names[own.func.__name__]: {} for own in known},
            "define": {self.names[key.func.__name__]: self.text(own) for key, own in named.items()},
            "lagrangian": {"L": self.text(lagrangian)},
            "constraints": {name: self.text(own) for name, own in equations.items()},
            "forces": {self.names[key.func.__name__]: self.text(own) for key, own in forces.items() if own != 0},
        }
        self.sections = {key: own for key, own in self.sections.items() if own}

    def state(self, equations: Iterable[Any], unknowns: Sequence[Any] = ()) -> None:
        """States expressions that somebody says vanish along the motion, under the name ``sympy``."""
        wanted = [sp.sympify(own) for own in equations]
        renamed = {own: sp.Symbol(f"unknown_{number}") for number, own in enumerate(unknowns, 1)}
        texts = [f"{self.text(own.xreplace(renamed))} = 0" for own in wanted if own != 0]
        names = [own.name for own in renamed.values()]
        self.sections["equations"] = {"sympy": {"unknowns": names, "equations": texts} if names else texts}

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
    auxiliary: Iterable[Any] = (),
    parameters: Mapping[Any, Any] | None = None,
    derived: Iterable[Any] = (),
) -> Statement:
    """A system of bodies and loads, with generalized speeds u and kinematical equations that vanish.

    A velocity that is no derivative of a function of the coordinates, as of a wheel whose rolling is put into it, belongs to a place
    that the coordinates do not tell. This place is a coordinate of its own here, and the velocity a constraint: Lagrange's operator of a
    kinetic energy into which constraints were put is wrong (Lindelöf's mistake). So it is with speeds that only velocity constraints
    determine, as that of a wheel about its axle: they are rates of coordinates of their own. ``auxiliary`` speeds are zero, and ``derived`` are
    expressions that are said to vanish along the motion.
    """
    t = coordinates[0].args[0]
    coordinates = list(coordinates)
    zero = {own: sp.S.Zero for own in auxiliary}
    equations = [_put(own, zero) for own in kinematics]
    solved, definitions, left = _solved(equations, [own for own in speeds if own not in zero], coordinates)
    known = zero | solved
    left += [own for own in (_put(own, known) for own in velocity) if own != 0]
    moving: set[Any] = set().union(*(own.atoms(sp.Derivative) for own in solved.values()))
    coordinates += sorted({own.expr for own in moving} - set(coordinates), key=str)
    rates = [own.diff(t) for own in coordinates]

    def in_rates(expression: Any) -> Any:
        return _put(expression, known)

    places: list[Any] = []
    positions = list(holonomic)
    constraints = {f"position_{number}": own for number, own in enumerate(positions, 1)}
    constraints |= {f"velocity_{number}": own for number, own in enumerate(left, 1)}
    taken = {own.func.__name__ for own in _functions([*coordinates, *speeds])}
    kinetic = sp.S.Zero
    bodies = list(bodies)
    velocities = [own.masscenter.vel(frame).to_matrix(frame).applyfunc(in_rates) for own in bodies]
    turned = [_Turning(own, frame, in_rates) if hasattr(own, "central_inertia") else None for own in bodies]
    vectors = [*velocities, *(own.angular for own in turned if own is not None)]
    point = _Point(coordinates, positions, [one.xreplace(definitions) for own in vectors for one in own], t)
    for number, (own, moved, turning) in enumerate(zip(bodies, velocities, turned, strict=True), 1):
        if turning is not None:
            if not point.is_turning([one.xreplace(definitions) for one in turning.angular]):
                name = f"{own.name}_turn"
                name = name if name not in taken else f"{name}_body_{number}"
                taken.add(name)
                turn = sp.Function(name)(t)
                found = turning.about_its_axis(turn.diff(t), in_rates)
                if found is None:
                    raise ValueError(
                        f"the angular velocity of {own.name} belongs to no orientation that the coordinates and the integrals of "
                        "further speeds tell: kinematical equations are missing"
                    )
                places.append(turn)
                constraints[f"turn_{number}"] = turn.diff(t) - found
            kinetic += turning.energy()
        for axis, component in zip("xyz", moved, strict=True):
            if component != 0 and not point.is_rate(component.xreplace(definitions)):
                name = f"{own.name}_{axis}"
                name = name if name not in taken else f"{name}_body_{number}"
                taken.add(name)
                place = sp.Function(name)(t)
                places.append(place)
                constraints[f"place_{len(places)}"] = place.diff(t) - component
                component = place.diff(t)
            kinetic += own.mass * component**2 / 2
    # Velocities may be stated by rates or by speeds.
    forces: dict[Any, Any] = {own: sp.S.Zero for own in coordinates}
    for place, force in loads:
        moved = place.ang_vel_in(frame) if hasattr(place, "ang_vel_in") else place.vel(frame)
        components = moved.to_matrix(frame).applyfunc(in_rates)
        applied = force.to_matrix(frame).applyfunc(in_rates)
        for own, rate in zip(coordinates, rates, strict=True):
            forces[own] += sum((f * v.diff(rate) for f, v in zip(applied, components, strict=True)), sp.S.Zero)
    derived = [in_rates(own) for own in derived]
    everything = [kinetic, *forces.values(), *constraints.values(), *derived]
    controls = _functions([*everything, *definitions.values()]) - {*coordinates, *places, *definitions}
    found = Statement(
        kinetic, coordinates + places, constraints=constraints, forces=forces, parameters=parameters, controls=controls,
        definitions=definitions,
    )
    if derived:
        found.state(derived)
    return found


def _put(expression: Any, known: Mapping[Any, Any]) -> Any:
    """Functions of the time put in, in derivatives too."""
    if not known:
        return sp.sympify(expression)
    t = next(iter(known)).args[0]
    found = sp.sympify(expression)
    while True:
        # The highest derivatives first: what is put in for a lower one may have them no more.
        order = max((own.variable_count[0][1] for own in found.atoms(sp.Derivative) if own.expr in known), default=0)
        if order == 0:
            return found.xreplace(known)
        found = found.xreplace({own.diff(t, order): sp.sympify(value).diff(t, order) for own, value in known.items()})


class _Turning:
    """How a rigid body turns: its angular velocity and its kinetic energy about the centre of mass."""

    def __init__(self, body: Any, frame: Any, in_rates: Any) -> None:
        self._body, self._frame = body, frame
        own = body.frame.ang_vel_in(frame)
        self._of_axes = own
        self._inertia = body.central_inertia
        self.angular = own.to_matrix(frame).applyfunc(in_rates)
        self._in_rates = in_rates

    def energy(self) -> Any:
        """½ ω·I·ω."""
        return self._in_rates(self._of_axes.dot(self._inertia.dot(self._of_axes)) / 2)

    def about_its_axis(self, rate: Any, in_rates: Any) -> Any:
        """Takes a rate for the turn about the axis of a body of revolution against the axes in which its inertia is stated, and gives what
        it is said to be; ``None`` where the body turns otherwise.

        So turns a wheel whose rolling is put into its angular velocity.
        """
        axes = {unit.args[0][1] for _, *pair in self._inertia.args for unit in pair}
        if len(axes) != 1:
            return None
        (own,) = axes
        matrix = self._inertia.to_matrix(own)
        apart = self._body.frame.ang_vel_in(own).to_matrix(own).applyfunc(in_rates)
        turns = [k for k in range(3) if apart[k] != 0]
        if len(turns) != 1 or not matrix.is_diagonal():
            return None
        (k,) = turns
        if sp.simplify(matrix[(k + 1) % 3, (k + 1) % 3] - matrix[(k + 2) % 3, (k + 2) % 3]) != 0:
            return None
        self._of_axes = own.ang_vel_in(self._frame) + rate * (own.x, own.y, own.z)[k]
        return apart[k]


def _solved(
    equations: Sequence[Any], speeds: Sequence[Any], coordinates: Sequence[Any]
) -> tuple[dict[Any, Any], dict[Any, Any], list[Any]]:
    """Speeds by rates from as many equations as determine them, short ones first; names for coefficients that are long, and what
    the other equations say of the rates.

    A speed that no equation determines is the rate of a path of its own.
    """
    t = coordinates[0].args[0]
    rates = [own.diff(t) for own in coordinates]
    if list(speeds) == rates:
        return {}, {}, [own for own in equations if own != 0]
    paths = [sp.Function(f"{own.func.__name__}_path")(t) for own in speeds]
    along = [*rates, *(own.diff(t) for own in paths)]
    stated = len(equations)
    equations = [*equations, *(own - path.diff(t) for own, path in zip(speeds, paths, strict=True))]
    # The equations are linear in speeds and rates.
    matrix, right = sp.linear_eq_to_matrix(list(equations), [*speeds, *along])
    ours, theirs = matrix[:, : len(speeds)], -matrix[:, len(speeds) :].row_join(-right)
    numbers = _numbers(ours)
    rows: list[int] = []
    # Short equations are of angles and their rates, long ones may have a rolling in them; paths are for what is left open.
    order = sorted(range(stated), key=lambda row: equations[row].count_ops()) + [*range(stated, ours.rows)]
    for row in order:
        if len(rows) < len(speeds) and numbers.extract([*rows, row], range(len(speeds))).rank() > len(rows):
            rows.append(row)
    coefficients = ours.extract(rows, range(len(speeds))).LUsolve(theirs.extract(rows, range(theirs.cols)))
    definitions: dict[Any, Any] = {}
    solved: dict[Any, Any] = {}
    for k, speed in enumerate(speeds):
        value = sp.S.Zero
        for j, rate in enumerate([*along, sp.S.One]):
            own = coefficients[k, j]
            if own.count_ops() > 8:
                name = sp.Function(f"{speed.func.__name__}_{j + 1}")(t)
                definitions[name] = own
                own = name
            value += own * rate
        solved[speed] = value
    left = [_put(own, solved) for number, own in enumerate(equations) if number < stated and number not in rows]
    return solved, definitions, [own for own in left if own != 0]


class _Point:
    """A random point of the positions, where functions are asked with fifty digits: what their derivatives say along the positions there."""

    def __init__(self, coordinates: Sequence[Any], holonomic: Iterable[Any], everything: Iterable[Any], t: Any) -> None:
        import mpmath

        self.mp: Any = mpmath
        self.t = t
        self.places = [t, *coordinates]
        self.rates = [own.diff(t) for own in coordinates]
        conditions = [sp.sympify(own) for own in holonomic]
        whole = [sp.sympify(own) for own in [*conditions, *everything]]
        symbols = set().union(*(own.free_symbols for own in whole)) - {t}
        # Other functions of the time have values and derivatives of their own.
        free = sorted(_functions(whole) - set(coordinates), key=str)
        self.free = {own: [sp.Dummy() for _ in range(3)] for own in free}
        self.others: list[Any] = sorted(symbols, key=str) + [name for own in self.free.values() for name in own]
        with mpmath.workdps(50):
            self.values = [mpmath.mpf(random.uniform(0.3, 1.2)) for _ in self.places]
            self.constants = [mpmath.mpf(random.uniform(0.3, 1.2)) for _ in self.others]
            self.along: Any = mpmath.eye(len(self.places))
            if conditions:
                self._meet(conditions)

    def function(self, expressions: Sequence[Any]) -> Any:
        """Of places, rates and constants, in this order."""
        names = [sp.Dummy() for _ in [*self.places, *self.rates, *self.others]]
        renamed: dict[Any, Any] = dict(zip([*self.places, *self.rates, *self.others], names, strict=True))
        for own, (value, rate, bend) in self.free.items():
            renamed[own] = renamed[value] + renamed[rate] * names[0]
            renamed |= {own.diff(self.t): renamed[rate], own.diff(self.t, 2): renamed[bend]}
        plain = [sp.sympify(own).xreplace(renamed) for own in expressions]
        return sp.lambdify(names, plain, modules="mpmath", cse=True)

    def _meet(self, conditions: Sequence[Any]) -> None:
        """Newton's steps of least norm to the positions, and the directions along them."""
        mp, count = self.mp, len(self.places)
        slopes = [own.diff(place) for own in conditions for place in self.places]
        found = self.function([*conditions, *slopes])
        for _ in range(60):
            numbers = found(*self.values, *[0] * len(self.rates), *self.constants)
            left = mp.matrix(numbers[: len(conditions)])
            slope = mp.matrix(len(conditions), count)
            for number, value in enumerate(numbers[len(conditions) :]):
                slope[number // count, number % count] = value
            slope[:, 0] = mp.zeros(len(conditions), 1)
            u, sizes, v = mp.svd_r(slope, full_matrices=True)
            rank = sum(1 for own in sizes if own > 1e-12)
            if mp.norm(left) < mp.mpf(10) ** -40:
                break
            step = mp.zeros(count, 1)
            for k in range(rank):
                step += v[k, :].T * ((u[:, k].T * left)[0] / sizes[k])
            self.values = [value - step[k] for k, value in enumerate(self.values)]
        else:
            raise ValueError("no positions were found that satisfy the holonomic constraints")
        self.along = v[rank:, :]

    def curls(self, components: Sequence[Any]) -> tuple[list[list[Any]], list[Any]]:
        """Of a vector linear in the rates: its coefficients A along the positions, of the time first; and for each component the differences
        ∂A_j/∂x_i − ∂A_i/∂x_j along the positions."""
        function = self.function(components)
        mp, n, count = self.mp, len(self.rates), len(self.places)
        step = mp.mpf(10) ** -15

        def coefficients(at: Sequence[Any]) -> list[list[Any]]:
            free = function(*at, *[0] * n, *self.constants)
            rates = [function(*at, *[int(own == number) for own in range(n)], *self.constants) for number in range(n)]
            return [[start, *(own[number] - start for own in rates)] for number, start in enumerate(free)]

        slopes = []
        for number in range(count):
            ends = [coefficients([own + sign * step * (k == number) for k, own in enumerate(self.values)]) for sign in (1, -1)]
            slopes.append([[(p - m) / (2 * step) for p, m in zip(*own, strict=True)] for own in zip(*ends, strict=True)])
        curls = []
        for number in range(len(components)):
            curl = mp.matrix(count, count)
            for i in range(count):
                for j in range(count):
                    curl[i, j] = slopes[i][number][j] - slopes[j][number][i]
            curls.append(self.along * curl * self.along.T)
        here = coefficients(self.values)
        return [list(self.along * mp.matrix(own)) for own in here], curls

    def is_rate(self, component: Any) -> bool:
        """Whether a velocity is the derivative of a function of coordinates and time: its coefficients have no curl.

        Where it seems not to be so, nothing wrong comes of it.
        """
        with self.mp.workdps(50):
            _, (curl,) = self.curls([component])
            return bool(self.mp.mnorm(curl, "f") < 1e-18)

    def is_turning(self, components: Sequence[Any]) -> bool:
        """Whether a vector is the angular velocity of an orientation that coordinates and time determine.

        In the axes of an observer at rest its coefficients then satisfy ∂Ω_j/∂q_i − ∂Ω_i/∂q_j = Ω_i × Ω_j (Maurer and Cartan).
        """
        with self.mp.workdps(50):
            values, curls = self.curls(components)
            count = len(values[0])
            for axis in range(3):
                a, b = values[(axis + 1) % 3], values[(axis + 2) % 3]
                for i in range(count):
                    for j in range(count):
                        if abs(curls[axis][i, j] - (a[i] * b[j] - b[i] * a[j])) > 1e-18:
                            return False
            return True


def _numbers(matrix: Any) -> Any:
    """A matrix at a random point, with what rounding leaves taken for zero."""
    atoms = matrix.atoms(sp.Derivative, AppliedUndef, sp.Symbol)
    point = {own: sp.Float(random.uniform(0.3, 1.2), 40) for own in atoms}
    values = matrix.xreplace(point).evalf(40)
    return values.applyfunc(lambda own: own if abs(own) > 1e-20 else sp.S.Zero)


def _functions(expressions: Iterable[Any]) -> set[Any]:
    return set().union(*(sp.sympify(own).atoms(AppliedUndef) for own in expressions))


def statement(what: Any, parameters: Mapping[Any, Any] | None = None, *, derived: bool = False) -> Statement:
    """What a ``KanesMethod``, a ``LagrangesMethod`` or a ``System`` of ``sympy.physics.mechanics`` states.

    With ``derived`` the equations are stated too that the object has derived.
    """
    import sympy.physics.mechanics as me

    is_lagrange, is_kane = isinstance(what, me.LagrangesMethod), isinstance(what, me.KanesMethod)
    if is_lagrange:
        return _of_lagrange(what, parameters, derived)
    if is_kane:
        equations = list(what.mass_matrix * sp.Matrix([own.diff(own.args[0]) for own in what.u]) - what.forcing) if derived else []
        # As they were stated, and not solved for the rates.
        kinematics = what._k_kqdot_implicit * sp.Matrix(what._qdot) + what._k_ku_implicit * sp.Matrix(what.u) + what._f_k_implicit
        return of_bodies(
            what._inertial, list(what.q), list(what.u), list(kinematics),
            what.bodies, what.loads or [],
            holonomic=list(what._f_h),
            velocity=list(what._k_nh * sp.Matrix(what.u) + what._f_nh) if what._k_nh else [],
            auxiliary=list(what._uaux), parameters=parameters, derived=equations,
        )
    if type(what).__name__ == "System" and hasattr(what, "kdes"):
        if derived:
            return statement(what.eom_method, parameters, derived=True)
        loads = list(what.loads) + [own for actuator in what.actuators for own in actuator.to_loads()]
        return of_bodies(
            what.frame, list(what.q), list(what.u), list(what.kdes), list(what.bodies), loads,
            holonomic=list(what.holonomic_constraints), velocity=list(what.nonholonomic_constraints), parameters=parameters,
        )
    raise TypeError(f"{type(what).__name__} states no system that is known here")


def _of_lagrange(method: Any, parameters: Mapping[Any, Any] | None, derived: bool) -> Statement:
    coordinates = list(method.q)
    forces: dict[Any, Any] = {own: sp.S.Zero for own in coordinates}
    frame = method.inertial
    for place, force in method.forcelist or []:
        moved = place.ang_vel_in(frame) if hasattr(place, "ang_vel_in") else place.vel(frame)
        for own in coordinates:
            forces[own] += moved.diff(own.diff(), frame, var_in_dcm=False).dot(force)
    lagrangian, constraints = sp.Matrix([method._L])[0], list(method.coneqs)
    controls = _functions([lagrangian, *forces.values(), *constraints]) - set(coordinates)
    found = Statement(lagrangian, coordinates, constraints=constraints, forces=forces, parameters=parameters, controls=controls)
    if derived:
        found.state(list(method.eom), list(method.lam_vec))
    return found
