"""Systems that are stated in SymPy: Lagrangians, and the objects of ``sympy.physics.mechanics``."""

from __future__ import annotations

import random
import re
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import sympy as sp
from sympy.core.function import AppliedUndef
from sympy.logic.boolalg import Boolean

from .errors import ModelWarning
from .texts import FUNCTIONS, known_functions, of_sympy
from .trees import nodes, replaced

#: Names that a model cannot declare, and those of constants of Python, which its programs cannot assign.
_RESERVED = set(
    "t pi sum sqrt ln sgn arcsin arccos arctan arctan2 arsinh arcsinh arcosh arccosh artanh arctanh None True False".split()
).union(FUNCTIONS)
_GREEK = {
    "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "ε": "epsilon", "θ": "theta", "λ": "lamda", "μ": "mu",
    "ρ": "rho", "σ": "sigma", "τ": "tau", "φ": "phi", "ψ": "psi", "ω": "omega",
}


class Origins:
    """What the user's own objects are called in a model, and back.

    Attributes
    ----------
    time : sympy.Symbol
        The time of the statement.
    objects : dict from str to symbol or function of the time
        By the names of the model.
    """

    def __init__(self, time: Any, objects: Mapping[str, Any]) -> None:
        self.time = time
        self.objects = dict(objects)

    def back(self, expression: Any) -> Any:
        """An expression of the model's names with the user's own symbols, functions and time."""
        found: dict[Any, Any] = {}
        for own in nodes([expression]):
            name = own.name if isinstance(own, sp.Symbol) else own.func.__name__ if isinstance(own, AppliedUndef) else None
            if name == "t" and isinstance(own, sp.Symbol):
                found[own] = self.time
            elif name in self.objects:
                found[own] = self.objects[name]
        return replaced([expression], found)[0]

    def name(self, word: str) -> str:
        """What the model calls an object that the user calls so, with the primes of a rate behind."""
        own = word.rstrip("'")
        if own in self.objects:
            return word
        known = {one.func.__name__ if isinstance(one, AppliedUndef) else one.name: name for name, one in self.objects.items()}
        return known.get(own, own) + word[len(own) :]

    def text(self, expression: Any) -> str:
        """An expression of the user's objects in the notation of the model."""
        t = sp.Symbol("t")
        rename: dict[Any, Any] = {self.time: t}
        for name, own in self.objects.items():
            rename[own] = sp.Function(name)(t) if isinstance(own, AppliedUndef) else sp.Symbol(name)
        return of_sympy(known_functions(expression).xreplace(rename))


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
    forces : mapping from coordinates, or their names, to expressions
        Generalized forces that are not in the Lagrangian.
    parameters : mapping from symbols or names to values, or list of these
        Values of parameters; those without stay symbols.
    controls : iterable of functions of the time or names, or mapping from these to laws
        Arbitrary functions of the time that are no coordinates.
    definitions : mapping from functions of the time to expressions
        Names for what is long.

    Attributes
    ----------
    sections : dict
        What the file of the model has.
    origins : Origins
        What stands for what.
    renamed : list of str
        Sentences on names that a model cannot declare.
    """

    def __init__(
        self,
        lagrangian: Any,
        coordinates: Sequence[Any],
        *,
        constraints: Mapping[str, Any] | Iterable[Any] = (),
        forces: Mapping[Any, Any] | None = None,
        parameters: Mapping[Any, Any] | Iterable[Any] | None = None,
        controls: Mapping[Any, Any] | Iterable[Any] = (),
        definitions: Mapping[Any, Any] | None = None,
    ) -> None:
        import sympy.physics.mechanics as me

        if isinstance(lagrangian, (me.LagrangesMethod, me.KanesMethod)) or hasattr(lagrangian, "kdes"):
            raise TypeError(f"coordinates: {type(lagrangian).__name__} states its own; they belong to a Lagrangian")
        if isinstance(constraints, (sp.Expr, Boolean)):
            constraints = [constraints]
        if isinstance(coordinates, AppliedUndef):
            coordinates = [coordinates]
        listed = constraints if isinstance(constraints, Mapping) else {
            f"constraint_{number}": own for number, own in enumerate(constraints, 1)
        }
        if not isinstance(forces or {}, Mapping):
            raise TypeError(f"forces: a mapping from coordinates to expressions is needed, not {type(forces).__name__}")
        named = dict(definitions or {})
        _no_texts({"the Lagrangian": lagrangian, **listed, **{f"the force on {key}": own for key, own in (forces or {}).items()}})
        lagrangian = _expression("the Lagrangian", lagrangian)
        equations = {name: _equation(name, own) for name, own in listed.items()}
        self._coordinates = [sp.sympify(own) for own in coordinates]
        time = _time(self._coordinates)
        forces = _by_objects(forces or {}, self._coordinates, "forces", "coordinate")
        laws = dict(controls) if isinstance(controls, Mapping) else dict.fromkeys(controls)
        lawful = [own for own in laws.values() if hasattr(own, "free_symbols")]
        whole = [known_functions(own) for own in [lagrangian, *equations.values(), *forces.values(), *named.values(), *lawful]]
        functions = sorted(_functions(whole) - set(self._coordinates) - set(named), key=str)
        known = {own: laws[key] for own in functions for key in laws if key == own or str(key) == own.func.__name__}
        for own in functions:
            if own not in known:
                raise ValueError(f"{own} is neither a coordinate nor a parameter; state it under `controls` where it is a given function of the time")
        symbols = _apart(set().union(*(own.free_symbols for own in whole)) - {time}, time)
        moving = [*self._coordinates, *known, *named]
        names = _names([*((own, own.func.__name__) for own in moving), *((own, own.name) for own in symbols)])
        self.renamed = [f"{own} is called `{name}` in the model" for own, name in names.items() if str(own).partition("(")[0] != name]
        self.origins = Origins(time, {name: own for own, name in names.items()})
        self.coordinates = [names[own] for own in self._coordinates]
        values = _values(parameters, symbols)
        self.sections: dict[str, Any] = {
            "coordinates": self.coordinates,
            "parameters": {names[own]: self._value(values.get(own, {})) for own in symbols},
            "controls": {names[own]: self._value({} if law is None else law) for own, law in known.items()},
            "define": {names[key]: self.text(own) for key, own in named.items()},
            "lagrangian": {"L": self.text(lagrangian)},
            "constraints": {name: self.text(own) for name, own in equations.items()},
            "forces": {names[key]: self._value(own) for key, own in forces.items() if own != 0},
            "assumptions": [f"{names[own]} {said}" for own in symbols if (said := _assumed(own)) is not None],
        }
        self.sections = {key: own for key, own in self.sections.items() if own}

    def _value(self, own: Any) -> Any:
        return self.text(own) if hasattr(own, "free_symbols") else own

    def in_names(self, sections: Mapping[str, Any]) -> dict[str, Any]:
        """Sections whose keys and values may be SymPy's, in the names of the model."""

        def plain(own: Any) -> Any:
            if isinstance(own, Mapping):
                return {key if isinstance(key, str) else self.text(key): plain(value) for key, value in own.items()}
            if isinstance(own, (list, tuple)):
                return [plain(value) for value in own]
            return self._value(own)

        found = {key: plain(own) for key, own in sections.items() if own is not None}
        if "assumptions" in found:
            found["assumptions"] = self.sections.get("assumptions", []) + list(found["assumptions"])
        if not isinstance(found.get("controls", {}), Mapping):
            found["controls"] = dict.fromkeys(found["controls"])
        for key, own in found.items():
            # Laws of some controls, and further definitions, leave the others.
            if isinstance(own, Mapping) and isinstance(self.sections.get(key), Mapping):
                found[key] = {**self.sections[key], **own}
        return found

    def state(self, equations: Iterable[Any], unknowns: Sequence[Any] = ()) -> None:
        """States expressions that somebody says vanish along the motion, under the name ``sympy``."""
        wanted = [sp.sympify(own) for own in equations]
        renamed = {own: sp.Symbol(f"unknown_{number}") for number, own in enumerate(unknowns, 1)}
        texts = [f"{self.text(own.xreplace(renamed))} = 0" for own in wanted if own != 0]
        names = [own.name for own in renamed.values()]
        if texts:
            self.sections["equations"] = {"sympy": {"unknowns": names, "equations": texts} if names else texts}

    def text(self, expression: Any) -> str:
        """An expression in the names of the model."""
        return self.origins.text(expression)


def _no_texts(stated: Mapping[str, Any]) -> None:
    """SymPy would read `x` in a text as a symbol that is no coordinate."""
    for name, own in stated.items():
        if isinstance(own, str):
            raise TypeError(f"{name}: an expression of SymPy is needed, not the text {own!r}; System(…) itself takes texts")


def _expression(name: str, own: Any) -> Any:
    try:
        found = sp.sympify(own, strict=True)
    except sp.SympifyError:
        found = None
    if not isinstance(found, sp.Expr) or found.is_Matrix:
        raise TypeError(f"{name}: an expression of SymPy is needed, not {type(own).__name__}")
    return found


def _equation(name: str, own: Any) -> Any:
    if isinstance(own, Boolean) and not isinstance(own, sp.Equality):
        raise ValueError(f"{name}: an equation or an expression that vanishes is needed, and {own} is none")
    return own if isinstance(own, sp.Equality) else sp.Eq(sp.sympify(own), 0, evaluate=False)


def _assumed(symbol: Any) -> str | None:
    """What SymPy has been told of the sign of a symbol: expressions may have been simplified by it."""
    said = (("is_positive", "> 0"), ("is_negative", "< 0"), ("is_nonnegative", ">= 0"), ("is_nonpositive", "<= 0"), ("is_nonzero", "!= 0"))
    return next((words for asked, words in said if getattr(symbol, asked)), None)


def _time(coordinates: Sequence[Any]) -> Any:
    """The one symbol that all coordinates are functions of."""
    for own in coordinates:
        if not isinstance(own, AppliedUndef) or len(own.args) != 1:
            raise ValueError(f"{own} is no function of the time, and no coordinate: use dynamicsymbols")
    clocks = sorted({own.args[0] for own in coordinates}, key=sp.srepr)
    if len(clocks) != 1 or not isinstance(clocks[0], sp.Symbol):
        raise ValueError(f"coordinates are functions of one time, not of {', '.join(sp.srepr(own) for own in clocks) or 'nothing'}")
    for number, own in enumerate(coordinates):
        if own in coordinates[:number]:
            raise ValueError(f"coordinates: {own} is named twice")
    return clocks[0]


def _apart(symbols: set[Any], time: Any) -> list[Any]:
    """Symbols in the order of their names; two of one name are a mistake that SymPy does not see."""
    ordered = sorted(symbols, key=lambda own: (str(own.name), sp.srepr(own)))
    for one, other in zip([time, *ordered], ordered):
        if one.name == other.name:
            raise ValueError(f"there are two symbols of the name `{one.name}`, with different assumptions: {sp.srepr(one)} and {sp.srepr(other)}")
    for own in ordered:
        if own.name == time.name:
            raise ValueError(f"there are two symbols of the name `{time.name}`: {sp.srepr(time)} is the time, and {sp.srepr(own)} is not")
    return ordered


def _found(key: Any, among: Sequence[Any], where: str, what: str) -> Any:
    """One of several objects, by itself or by its name."""
    for own in among:
        if own == key or isinstance(key, str) and key in (str(own), getattr(own, "name", None) or own.func.__name__):
            return own
    raise ValueError(f"{where}: {key} is no {what}; there are {', '.join(map(str, among)) or 'none'}")


def _by_objects(given: Mapping[Any, Any], among: Sequence[Any], where: str, what: str) -> dict[Any, Any]:
    """What is said by names or by objects, by the objects; once of each."""
    found: dict[Any, Any] = {}
    for key, own in given.items():
        known = _found(key, among, where, what)
        if known in found:
            raise ValueError(f"{where}: {known} is named twice")
        found[known] = own
    return found


def _values(given: Mapping[Any, Any] | Iterable[Any] | None, symbols: Sequence[Any]) -> dict[Any, Any]:
    """Values of parameters by their symbols."""
    listed = given if isinstance(given, Mapping) else {own: {} for own in given or ()}
    return _by_objects(listed, symbols, "parameters", "symbol of the statement")


def _names(wanted: Iterable[tuple[Any, str]]) -> dict[Any, str]:
    """Names that a model can declare, no two the same."""
    taken: set[str] = set()
    found: dict[Any, str] = {}
    for key, name in wanted:
        plain = "".join(_GREEK.get(letter, letter) for letter in name)
        plain = re.sub(r"[^A-Za-z0-9_]+", "_", re.sub(r"[{}\\]", "", plain)).strip("_") or "x"
        if plain[0].isdigit() or plain in _RESERVED or plain.startswith(("lambda_", "kappa_")) or plain == "lambda":
            plain = f"x_{plain}"
        own, number = plain, 2
        while own in taken:
            own, number = f"{plain}_{number}", number + 1
        taken.add(own)
        found[key] = own
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
    potential: Any = 0,
    parameters: Any = None,
    derived: Iterable[Any] = (),
) -> Statement:
    """A system of bodies and loads, with generalized speeds u and kinematical equations that vanish.

    A velocity that is no derivative of a function of the coordinates, as of a wheel whose rolling is put into it, belongs to a place
    that the coordinates do not tell. This place is a coordinate of its own here, and the velocity a constraint: Lagrange's operator of a
    kinetic energy into which constraints were put is wrong (Lindelöf's mistake). So it is with speeds that only velocity constraints
    determine, as that of a wheel about its axle: they are rates of coordinates of their own. ``auxiliary`` speeds are zero, ``potential`` is an energy of the
    forces that are no loads, and ``derived`` are
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
    constraints = _constraints(positions, left)
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
    lagrangian = kinetic - in_rates(potential)
    everything = [lagrangian, *forces.values(), *constraints.values(), *derived]
    controls = _functions([*everything, *definitions.values()]) - {*coordinates, *places, *definitions}
    found = Statement(
        lagrangian, coordinates + places, constraints=constraints, forces=forces, parameters=parameters, controls=controls,
        definitions=definitions,
    )
    if derived:
        found.state(derived)
    return found


def _constraints(positions: Iterable[Any], velocities: Iterable[Any]) -> dict[str, Any]:
    """Constraints by their names: those on positions, then those on velocities."""
    kinds = (("position", positions), ("velocity", velocities))
    return {f"{kind}_{number}": own for kind, listed in kinds for number, own in enumerate(listed, 1)}


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
        self._constant = sorted(symbols, key=str)
        draw = random.Random(33)
        with mpmath.workdps(50):
            for _ in range(10):
                self.values = [mpmath.mpf(draw.uniform(0.3, 1.2)) for _ in self.places]
                self.constants = [mpmath.mpf(draw.uniform(0.3, 1.2)) for _ in self.others]
                self.along: Any = mpmath.eye(len(self.places))
                if not conditions or self._meet(conditions):
                    return
        raise ValueError("no positions were found that satisfy the holonomic constraints")

    def function(self, expressions: Sequence[Any]) -> Any:
        """Of places, rates and constants, in this order."""
        names = [sp.Dummy() for _ in [*self.places, *self.rates, *self.others]]
        renamed: dict[Any, Any] = dict(zip([*self.places, *self.rates, *self.others], names, strict=True))
        for own, (value, rate, bend) in self.free.items():
            renamed[own] = renamed[value] + renamed[rate] * names[0]
            renamed |= {own.diff(self.t): renamed[rate], own.diff(self.t, 2): renamed[bend]}
        plain = [sp.sympify(own).xreplace(renamed) for own in expressions]
        return sp.lambdify(names, plain, modules="mpmath", cse=True)

    def _meet(self, conditions: Sequence[Any]) -> bool:
        """Newton's steps of least norm to positions, and the directions along them; constants are changed too, as loops of random lengths do not
        close. Whether it came to a point."""
        mp, count = self.mp, len(self.places)
        unknown = [*self.places, *self._constant]
        slopes = [own.diff(place) for own in conditions for place in unknown]
        found = self.function([*conditions, *slopes])
        for _ in range(60):
            numbers = found(*self.values, *[0] * len(self.rates), *self.constants)
            if any(mp.im(own) != 0 for own in numbers):
                return False
            numbers = [mp.re(own) for own in numbers]
            left = mp.matrix(numbers[: len(conditions)])
            slope = mp.matrix(len(conditions), len(unknown))
            for number, value in enumerate(numbers[len(conditions) :]):
                slope[number // len(unknown), number % len(unknown)] = value
            slope[:, 0] = mp.zeros(len(conditions), 1)
            if mp.norm(left) < mp.mpf(10) ** -40:
                _, sizes, v = mp.svd_r(slope[:, :count], full_matrices=True)
                self.along = v[sum(1 for own in sizes if own > 1e-12) :, :]
                return True
            u, sizes, v = mp.svd_r(slope, full_matrices=True)
            step = mp.zeros(len(unknown), 1)
            for k in range(sum(1 for own in sizes if own > 1e-12)):
                step += v[k, :].T * ((u[:, k].T * left)[0] / sizes[k])
            self.values = [value - step[k] for k, value in enumerate(self.values)]
            for k in range(len(self._constant)):
                self.constants[k] -= step[count + k]
        return False

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
    atoms = sorted(matrix.atoms(sp.Derivative, AppliedUndef, sp.Symbol), key=sp.srepr)
    draw = random.Random(33)
    point = {own: sp.Float(draw.uniform(0.3, 1.2), 40) for own in atoms}
    values = matrix.xreplace(point).evalf(40)
    return values.applyfunc(lambda own: own if abs(own) > 1e-20 else sp.S.Zero)


def _functions(expressions: Iterable[Any]) -> set[Any]:
    return set().union(*(sp.sympify(own).atoms(AppliedUndef) for own in expressions))


def statement(what: Any, parameters: Any = None, *, derived: bool = False) -> Statement:
    """What a ``KanesMethod``, a ``LagrangesMethod`` or a ``System`` of ``sympy.physics.mechanics`` states.

    With ``derived`` the equations are stated too that the object has derived.
    """
    import sympy.physics.mechanics as me

    is_lagrange, is_kane = isinstance(what, me.LagrangesMethod), isinstance(what, me.KanesMethod)
    if is_lagrange:
        return _of_lagrange(what, parameters, derived)
    if is_kane:
        if what.bodies is None or what.forcing is None:
            raise ValueError("this KanesMethod has not formed its equations, and knows no bodies: call kanes_equations first")
        _without_potential(what.bodies)
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
            if what.eom_method is None:
                raise ValueError("derived: this System has not formed its equations: call form_eoms first")
            if isinstance(what.eom_method, me.LagrangesMethod):
                return _of_lagrange(what.eom_method, parameters, True, _speeds(what))
            return statement(what.eom_method, parameters, derived=True)
        # Those that the user has put in the place of all, or those that are no derivatives of finite ones.
        velocity = what.nonholonomic_constraints if what._vel_constrs is None else what.velocity_constraints
        loads = list(what.loads) + [own for actuator in what.actuators for own in actuator.to_loads()]
        # Of the two methods by which a System forms equations only Lagrange's reads the potential energies of bodies.
        is_whole = isinstance(what.eom_method, me.LagrangesMethod)
        potential = sum((own.potential_energy for own in what.bodies), sp.S.Zero) if is_whole else sp.S.Zero
        if not is_whole:
            _without_potential(what.bodies)
        return of_bodies(
            what.frame, list(what.q), list(what.u), list(what.kdes), list(what.bodies), loads,
            holonomic=list(what.holonomic_constraints), velocity=list(velocity), auxiliary=list(what.u_aux), potential=potential,
            parameters=parameters,
        )
    raise TypeError(f"{type(what).__name__} states no system that is known here")


def _without_potential(bodies: Iterable[Any]) -> None:
    """Says which potential energies are not stated."""
    names = [own.name for own in bodies if own.potential_energy != 0]
    if names:
        said = (
            f"the potential energy of {', '.join(names)} is left out, as Kane's method leaves it out: its force is to be among the loads; a System "
            "whose equations are formed by LagrangesMethod has it"
        )
        warnings.warn(said, ModelWarning, stacklevel=4)


def _speeds(system: Any) -> dict[Any, Any]:
    """The generalized speeds of a System of SymPy by the rates of its coordinates."""
    speeds = [own for own in system.u if own not in system.q]
    matrix, right = sp.linear_eq_to_matrix(list(system.kdes), speeds)
    return dict(zip(speeds, matrix.LUsolve(right), strict=True)) if speeds else {}


def _of_lagrange(method: Any, parameters: Any, derived: bool, speeds: Mapping[Any, Any] | None = None) -> Statement:
    """What a LagrangesMethod states; ``speeds`` are put in by the rates of the coordinates."""
    if derived and method.eom is None:
        raise ValueError("derived: this LagrangesMethod has not formed its equations: call form_lagranges_equations first")
    coordinates = list(method.q)
    known = dict(speeds or {})
    forces: dict[Any, Any] = {own: sp.S.Zero for own in coordinates}
    frame = method.inertial
    for place, force in method.forcelist or []:
        moved = place.ang_vel_in(frame) if hasattr(place, "ang_vel_in") else place.vel(frame)
        components = moved.to_matrix(frame).applyfunc(lambda own: _put(own, known))
        applied = force.to_matrix(frame).applyfunc(lambda own: _put(own, known))
        for own in coordinates:
            forces[own] += sum((f * v.diff(own.diff()) for f, v in zip(applied, components, strict=True)), sp.S.Zero)
    lagrangian = _put(sp.Matrix([method._L])[0], known)
    # SymPy has the rates of constraints on positions before the others; what they hold the system to are the positions.
    positions = list(method._hol_coneqs)
    constraints = _constraints([_put(own, known) for own in positions], [_put(own, known) for own in method.coneqs[len(positions) :]])
    controls = sorted(_functions([lagrangian, *forces.values(), *constraints.values()]) - set(coordinates), key=str)
    for own in controls:
        said = f"{own} is no coordinate of this LagrangesMethod, and is taken for a control, a given function of the time"
        warnings.warn(said, ModelWarning, stacklevel=4)
    found = Statement(lagrangian, coordinates, constraints=constraints, forces=forces, parameters=parameters, controls=controls)
    if derived:
        equations = [sp.sympify(_put(own, known)) for own in method.eom]
        if all(own == 0 for own in equations):
            said = "SymPy has derived 0 = 0 from this Lagrangian, which stands in speeds and not in rates of coordinates: no equations are stated"
            warnings.warn(said, ModelWarning, stacklevel=4)
        found.state(equations, list(method.lam_vec))
    return found
