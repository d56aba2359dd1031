"""A mechanical system, and every question that can be asked of it."""

from __future__ import annotations

import json
import os
import warnings
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, TypeVar, overload

from . import chetaev_native as native
from . import notebook
from .asked import flag, listed, mapping, number, seconds, whole, word, words
from .errors import Interrupted, ModelWarning, OptionError
from .keywords import in_python
from .results import (
    Check,
    Columns,
    Comparison,
    Counts,
    Derivation,
    Film,
    Followed,
    LinearAlong,
    Linearization,
    Picture,
    Result,
    Shown,
    Stability,
    StabilityMap,
    Steady,
    Steps,
    Study,
    Trajectory,
    writable,
)
from .texts import exact, shown, toml

if TYPE_CHECKING:
    from .compiled import Compiled
    from .exported import Exported, Residuals
    from .from_sympy import Origins
    from .sweeps import Sweep
    from .widget import Widget

#: A number, a text of the model notation, a fraction, or a SymPy expression.
Value = Any
_DEFAULT = ("routh", "maggi")
#: Rows of one motion that are kept at most, as of ``output`` in a model.
_ROWS = 10**6
_Found = TypeVar("_Found", Study, Trajectory)


class System(Shown):
    """A mechanical system.

    Every section of a model file is a keyword; its content is a mapping, or a list where the file has one. Expressions are
    texts in the notation of the model file, numbers (a float is the decimal that it prints as), fractions, or SymPy expressions.

    Parameters
    ----------
    name : str
        A name.
    coordinates : list of str, or mapping to units, optional
        The coordinates; joints and contacts have their own.
    kinetic, potential : expression, optional
        Kinetic and potential energy.
    lagrangian : expression, or mapping with the keys ``T``, ``V``, ``L``, optional
        The Lagrangian itself.
    constraints : mapping from names to texts, list of texts, or one text, optional
        Constraints, texts or equations of SymPy, as ``"y' cos(phi) = x' sin(phi)"``.
    **sections
        ``parameters``, ``initial``, ``simulation``, ``define``, ``forces``, ``assumptions``, ``steady``, ``events``, ``bodies``, ``joints``,
        ``contacts``, …

    Examples
    --------
    A system by its energies and constraints, and one by its bodies:

    >>> skate = System(
    ...     "skate",
    ...     coordinates=["x", "y", "phi"],
    ...     parameters={"m": 1, "J": "2/5"},
    ...     kinetic="1/2 m (x'^2 + y'^2) + 1/2 J phi'^2",
    ...     constraints={"blade": "y' cos(phi) = x' sin(phi)"},
    ...     initial={"x'": 1, "phi'": 0.5},
    ... )
    >>> skate.constraints
    ['blade']
    >>> wheel = System(
    ...     "wheel",
    ...     bodies={"wheel": {"shape": "disc", "mass": 2, "radius": 0.3}},
    ...     contacts={"road": {"type": "rolling", "body": "wheel", "coordinates": ["x", "y", "heading", "lean", "roll"]}},
    ... )
    >>> wheel.coordinates
    ['x', 'y', 'heading', 'lean', 'roll']
    """

    _native: native.Model
    #: What the user's own SymPy objects are, by the names of the model, where the system was stated in SymPy.
    _own: Origins | None = None

    def __init__(
        self,
        name: str,
        *,
        coordinates: Sequence[str] | Mapping[str, Any] | None = None,
        kinetic: Value = None,
        potential: Value = None,
        lagrangian: Value = None,
        constraints: Mapping[str, Value] | Sequence[Value] | Value = None,
        **sections: Any,
    ) -> None:
        energies = dict(lagrangian) if isinstance(lagrangian, Mapping) else {"L": lagrangian}
        energies.update({"T": kinetic, "V": potential})
        content: dict[str, Any] = {"name": name}
        if coordinates is not None:
            content["coordinates"] = coordinates
        content["lagrangian"] = {key: own for key, own in energies.items() if own is not None}
        if constraints is not None:
            # One text, or one equation of SymPy.
            if isinstance(constraints, str) or not isinstance(constraints, Iterable):
                constraints = [constraints]
            named = constraints if isinstance(constraints, Mapping) else {
                f"constraint_{number}": own for number, own in enumerate(constraints, 1)
            }
            content["constraints"] = {key: own if isinstance(own, Mapping) else exact(own) for key, own in named.items()}
        content.update({key: own for key, own in sections.items() if own is not None})
        self._take(native.Model.from_text(toml({key: own for key, own in content.items() if not _is_left_out(key, own)}), None, []))

    def _take(self, model: native.Model) -> System:
        self._native = model
        said = in_python(model.warnings())
        if said:
            warnings.warn(said, ModelWarning, stacklevel=3)
        return self

    def _anew(self) -> native.Model:
        """The model read anew, to ask one question of it.

        The graph of its expressions remembers what was asked, and the order of terms in sums, and so the last bits of numbers, follow from that. What is
        computed of a graph of its own follows from the model and the options alone.
        """
        return native.Model.from_texts(*self._native.texts())

    @classmethod
    def from_file(cls, path: str | os.PathLike[str], *, set: Mapping[str, Value] | None = None) -> System:
        """Reads a model file.

        Parameters
        ----------
        path : path
            The file.
        set : mapping, optional
            Other values of parameters and sizes, exactly, as ``--set``.

        Returns
        -------
        System

        Raises
        ------
        ModelError
            With everything that is wrong, each at its place.
        OSError
            Where the file cannot be read, as :class:`FileNotFoundError`.
        """
        readable(path)
        return cls.__new__(cls)._take(native.Model.from_file(os.fspath(path), _pairs(set)))

    @classmethod
    def from_text(
        cls, text: str, *, path: str | os.PathLike[str] | None = None, set: Mapping[str, Value] | None = None
    ) -> System:
        """Reads a model from its text; what it includes is looked for beside ``path``.

        Parameters
        ----------
        text : str
            The text of a model file.
        path : path, optional
            Where the file would stand: what it includes is looked for beside it, and messages name it.
        set : mapping from names to values, optional
            Other values of parameters and sizes, exactly: ``{"m": "1/3"}``.

        Returns
        -------
        System
        """
        place = None if path is None else os.fspath(path)
        return cls.__new__(cls)._take(native.Model.from_text(text, place, _pairs(set)))

    @classmethod
    def from_gallery(cls, name: str, *, set: Mapping[str, Value] | None = None) -> System:
        """A model that comes with Chetaev; ``chetaev.gallery.list()`` names them.

        Parameters
        ----------
        name : str
            As ``chetaev.gallery.list()`` names it.
        set : mapping from names to values, optional
            Other values of parameters and sizes, exactly: ``{"m": "1/3"}``.

        Returns
        -------
        System
        """
        if not isinstance(name, str):
            raise TypeError(f"name: a text is needed, not {name!r}")
        return cls.__new__(cls)._take(native.Model.from_texts(*of_gallery(name), _pairs(set)))

    @classmethod
    def from_urdf(cls, path: str | os.PathLike[str], *, set: Mapping[str, Value] | None = None) -> System:
        """Reads the description of a robot, URDF or MJCF; what is not understood is a warning with its line.

        ``text`` of the system is the model file that it became, to which contacts can be added.

        Parameters
        ----------
        path : path
            A file in URDF or MJCF.
        set : mapping from names to values, optional
            Other values of parameters and sizes, exactly: ``{"m": "1/3"}``.

        Returns
        -------
        System
        """
        with open(path, encoding="utf-8") as file:
            text, notes = native.robot(os.fspath(path), file.read())
        for line, message in notes:
            warnings.warn(f"{os.fspath(path)}:{line}: {message}", ModelWarning, stacklevel=2)
        return cls.from_text(text, set=set)

    @classmethod
    def from_sympy(
        cls,
        lagrangian: Any,
        coordinates: Sequence[Any] | None = None,
        *,
        constraints: Mapping[str, Any] | Iterable[Any] = (),
        forces: Mapping[Any, Any] | None = None,
        parameters: Mapping[Any, Value] | None = None,
        derived: bool = False,
        name: str = "system",
        **sections: Any,
    ) -> System:
        """A system that is stated in SymPy.

        Parameters
        ----------
        lagrangian : expression, LagrangesMethod, KanesMethod or sympy.physics.mechanics.System
            The Lagrangian L(q, q', t), or an object that states a whole system.
        coordinates : sequence of functions of the time
            As ``dynamicsymbols`` makes them, of one time; needed with a Lagrangian, and with it only.
        constraints : expression, equation, sequence or mapping from names to these
            Expressions that vanish, or equations; with a Lagrangian only.
        forces : mapping from coordinates, or their names, to expressions
            Generalized forces that are not in the Lagrangian; with a Lagrangian only.
        parameters : mapping from symbols, or their names, to values; or list of these
            Those without a value stay symbols.
        derived : bool
            States beside it the equations that the object has derived; ``study(claims="equations.stated")`` decides whether they are right. A
            Lagrangian has derived none.
        **sections
            As for :class:`System`: ``initial``, ``simulation``, ``controls``, …; keys may be SymPy's too, ``initial={x.diff(t): 1}``. Laws of some
            controls leave the others, and assumptions are added to the signs that SymPy knows of symbols.
        name : str
            A name.

        Returns
        -------
        System

        Raises
        ------
        TypeError
            For what is said beside an object that states it itself, and for texts in the place of expressions.
        ValueError
            Where symbols of one name differ, or a function of the time is neither a coordinate nor a control.

        Notes
        -----
        ``derive().to_sympy()`` and ``sympify`` give the symbols, the functions and the time of the statement back. Names that a model cannot
        declare are changed, and a warning says to what. Potential energies of bodies are stated where a ``System`` has formed its equations by
        ``LagrangesMethod``; Kane's method leaves them out, and a warning says of which.

        Examples
        --------
        >>> import sympy as sp
        >>> from sympy.physics.mechanics import dynamicsymbols
        >>> th = dynamicsymbols("theta"); g, l = sp.symbols("g l")
        >>> System.from_sympy(l**2 * th.diff()**2 / 2 + g * l * sp.cos(th), [th]).coordinates
        ['theta']
        """
        from .from_sympy import Statement, statement

        if coordinates is None:
            given = constraints if isinstance(constraints, Mapping) or not isinstance(constraints, Iterable) else list(constraints)
            for word, said in (("constraints", given), ("forces", forces)):
                # What SymPy has is no truth value.
                if said is not None and said not in ([], {}):
                    raise TypeError(f"{word}: {type(lagrangian).__name__} states its own; they belong to a Lagrangian with its coordinates")
            stated = statement(lagrangian, parameters, derived=derived)
        else:
            if derived:
                raise TypeError("derived: a Lagrangian has derived no equations; LagrangesMethod, KanesMethod and System have")
            stated = Statement(
                lagrangian, coordinates, constraints=constraints, forces=forces, parameters=parameters, controls=sections.pop("controls", ()),
            )
        for sentence in stated.renamed:
            warnings.warn(sentence, ModelWarning, stacklevel=2)
        own = cls(name, **{**stated.sections, **stated.in_names(sections)})
        own._own = stated.origins
        return own

    def with_values(self, /, **values: Value) -> System:
        """The same system with other values of parameters and sizes; what follows from them changes with them.

        Parameters
        ----------
        **values : number, text, fraction or SymPy expression
            In the units of the model; for a system from SymPy in its symbols too, by which parameters may be named as well. A parameter that the
            model defines by others is set by its own name, and follows them no more.

        Returns
        -------
        System
        """
        return self._with([(self._name_of(name), self._exact(value)) for name, value in values.items()])

    def with_initial(self, values: Mapping[Any, Value]) -> System:
        """The same system with other initial values.

        Parameters
        ----------
        values : mapping from names to numbers, texts or expressions
            Coordinates and velocities, ``{"phi": 0.1, "x'": "v_0"}``; for a system from SymPy its functions and their derivatives too. What is not
            named stays as it is.

        Returns
        -------
        System

        Examples
        --------
        >>> System.from_gallery("chaplygin-sleigh").with_initial({"phi'": 2}).initial["phi'"]
        '2'
        """
        return self._with([(f"initial.{self._name_of(own)}", self._exact(value)) for own, value in mapping("initial", values).items()])

    def _name_of(self, own: Any) -> str:
        """What the model calls a parameter, a coordinate or a velocity, which is named or an object of the statement in SymPy."""
        if self._own is None:
            return own if isinstance(own, str) else exact(own)
        return self._own.name(own) if isinstance(own, str) else self._own.text(own)

    def _exact(self, value: Value) -> str:
        """A value in the names of the model."""
        return self._own.text(value) if self._own is not None and hasattr(value, "free_symbols") else exact(value)

    def _by_names(self, keyword: str, given: Any) -> dict[str, Any]:
        """A keyword from names, or objects of the statement in SymPy, to values."""
        return {self._name_of(own): value for own, value in mapping(keyword, given).items()}

    def _with(self, pairs: list[tuple[str, str]]) -> System:
        path, text, includes, overrides = self._native.texts()
        names = [name for name, _ in pairs]
        kept = [own for own in overrides if own[0] not in names]
        return _again(type(self), path, text, includes, kept + pairs, self._own)

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, (type(self), *self._native.texts(), self._own)

    def __eq__(self, other: object) -> bool:
        """Whether both are read from the same texts, with the same values set."""
        return isinstance(other, System) and self._native.texts() == other._native.texts()

    def __hash__(self) -> int:
        return hash(self._native.texts()[1])

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name

    @property
    def coordinates(self) -> list[str]:
        """Names of the coordinates."""
        return self._native.coordinates

    @property
    def parameters(self) -> dict[str, str | None]:
        """Names of the parameters with their exact values in SI units, as all computed numbers are; ``None`` where one has no value.

        Values that are given, as to ``with_values``, are in the units that the model states: a length of ``"1/2"`` here is 50 where ``units`` says cm.
        """
        return dict(self._native.parameters)

    @property
    def constraints(self) -> list[str]:
        """Names of the constraints."""
        return self._native.constraints

    @property
    def velocities(self) -> list[str]:
        """Names of the velocities, in the order of the coordinates."""
        return [f"{name}'" for name in self.coordinates]

    @property
    def masses(self) -> list[str]:
        """Names of the masses with a law of their own."""
        return self._native.masses

    @property
    def state(self) -> list[str]:
        """Names of the components of the state: coordinates, masses with a law of their own, velocities. Under a constraint of order m the derivatives
        up to order m - 1 belong to it too; those of a form of the equations are the ``state`` of ``derive(…)[0]`` and of ``to_jax(…)``."""
        return self.coordinates + self.masses + self.velocities

    @property
    def units(self) -> dict[str, str]:
        """Units as the model states them, by the names of coordinates, parameters and masses; what has none is left out. Computed numbers are in
        SI units."""
        return dict(self._native.units)

    @property
    def initial(self) -> dict[str, str]:
        """Initial values as they are stated, by the names of coordinates and velocities; guesses are among them."""
        return {name: text for name, text, _ in self._native.initial}

    @property
    def following(self) -> dict[str, str]:
        """Parameters that the model defines by others, each with what it is in terms of free ones."""
        return dict(self._anew().following)

    @property
    def text(self) -> str:
        """The model file, with the values that were set written into it; comments and order stay.

        Raises
        ------
        ModelError
            Where the file has no place for one of them, as for one of a family of parameters alone, or for one that other files take too.
        """
        return self._native.text()

    def __repr__(self) -> str:
        return f"<System {self.name}: coordinates {', '.join(self.coordinates)}; constraints {', '.join(self.constraints) or 'none'}>"

    def _html(self) -> str:
        return notebook.unfolding(repr(self)[8:-1], notebook.preformatted(shown(self._native)))

    def sympify(self, expressions: Sequence[str] | str, *, variables: Sequence[str] = ()) -> Any:
        """Expressions of the model notation in SymPy, exactly.

        Coordinates, controls and masses with a law of their own are functions of the time, ``sympy.Function("x", real=True)(t)``; of a system that
        was stated in SymPy they are the functions, the symbols and the time of the statement.

        Parameters
        ----------
        expressions : str or list of str
            Texts in the notation of the model. What equations are printed as may be given as it stands, with the names and the linear systems
            below ``where``: solutions of these are written by Cramer's rule, whose work doubles with every unknown. For systems of more than
            about ten, ``to_sympy`` of the derivation has the rows as they stand.
        variables : list of str, optional
            Names that are not the model's but those of a form of its equations: quasi-velocities that Chetaev chose, momenta. ``state`` of a
            formulation lists them: ``system.sympify(form.equations[0].right, variables=form.state)``. They are functions of the time. Without
            them the names of the model are known, its definitions and the multipliers ``lambda_NAME`` of its constraints.

        Returns
        -------
        sympy.Expr, or list of these
        """
        texts = [expressions] if isinstance(expressions, str) else list(expressions)
        found = self._in_sympy(texts, variables)
        if self._own is not None:
            found = [self._own.back(own) for own in found]
        return found[0] if isinstance(expressions, str) else found

    def _in_sympy(self, texts: Sequence[str], variables: Sequence[str] = ()) -> list[Any]:
        """Texts in SymPy, with the names of the model."""
        import sympy as sp

        from .trees import Module, replaced, solved

        module = Module(self._anew().sympy(list(texts), list(variables)), ["found"])
        # A number alone is one of Python in the module.
        found = [sp.sympify(own) for own in module.sections["found"]["all"]]
        rows = module.sections["found"].get("all: linear systems", [])
        return replaced(found, solved(rows, module.is_unknown)) if rows else found

    def lowered(self) -> str:
        """The model file with bodies, joints and contacts written out as coordinates, energies and constraints.

        Returns
        -------
        str
            The text of a model file.
        """
        return self._native.lowered()

    def check(self) -> Check:
        """Everything wrong or doubtful in the model.

        Returns
        -------
        Check
            Its ``diagnostics``, and whether there is no error.
        """
        text, data, has_errors = self._anew().check()
        return Check(json.loads(data), text, has_errors)

    @overload
    def derive(
        self, formulation: str | Iterable[str] = (), *, all: bool = False, count: Literal[False] = False, progress: bool = False
    ) -> Derivation: ...

    @overload
    def derive(
        self, formulation: str | Iterable[str] = (), *, all: bool = False, count: Literal[True], progress: bool = False
    ) -> Counts: ...

    def derive(
        self, formulation: str | Iterable[str] = (), *, all: bool = False, count: bool = False, progress: bool = False
    ) -> Derivation | Counts:
        """Derives the equations of motion.

        Parameters
        ----------
        formulation : str or list of str
            Names of formulations; Routh's and Maggi's when left out.
        all : bool
            Every formulation; those that do not apply say why.
        count : bool
            Counts the operations of the equations as they are printed; of the shortest when no formulation is named.
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.

        Returns
        -------
        Derivation or Counts
            A sequence of formulations, also by their names; with ``count`` the numbers of operations.

        Raises
        ------
        NotDerivedError
            Where a formulation that was named does not apply.
        """
        names = listed("formulation", formulation)
        with _Progress(progress) as tell:
            if count:
                return Counts(*self._anew().count(names or ["reduced"], all, tell))
            asked = (names or list(_DEFAULT), all)
            text, notes = self._anew().derive(*asked, "json", tell)
        return Derivation(self, asked, json.loads(text), notes)

    def steps(
        self,
        formulation: str | Iterable[str] = (),
        *,
        all: bool = False,
        notation: Literal["text", "latex"] = "text",
        progress: bool = False,
    ) -> Steps:
        """Writes a derivation step by step, as on a board: ``derive --steps``.

        Parameters
        ----------
        formulation : str or list of str
            Names of formulations; the shortest form when left out.
        all : bool
            Every formulation that is written step by step.
        notation : "text" or "latex"
            How it is written.
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.

        Returns
        -------
        Steps
            Its text is the derivation.
        """
        names = listed("formulation", formulation)
        with _Progress(progress) as tell:
            asked = (names or ["reduced"], all)
            return Steps(*self._anew().steps(*asked, notation, tell), self, asked)

    def compare(self, a: str, b: str, *, progress: bool = False) -> Comparison:
        """Holds two forms of the equations against each other: ``derive --compare a b``.

        Parameters
        ----------
        a : str
            A formulation.
        b : str
            Another one.
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.

        Returns
        -------
        Comparison
            Its text says what differs, and why it vanishes.
        """
        with _Progress(progress) as tell:
            text, notes = self._anew().compare(a, b, tell)
        return Comparison(self, {"a": a, "b": b, "text": text, "notes": notes}, text)

    def study(
        self,
        *,
        claims: str | Iterable[str] | None = None,
        budget: float = 60.0,
        out: str | os.PathLike[str] | None = None,
        progress: bool = False,
        t_end: Value = None,
        tolerance: float | None = None,
        step: Value = None,
        method: str | None = None,
        precision: str | None = None,
        formulation: str | None = None,
        project: bool = False,
        keep_integrals: bool = False,
        branch: int | None = None,
    ) -> Study:
        """Decides every claim and computes the motion.

        Parameters
        ----------
        claims : str or list of str, optional
            Groups and claim ids; all when left out.
        budget : float
            Work for all claims together, in seconds of a usual machine.
        out : path, optional
            Folder to write the report, the record and the trajectory into.
        progress : bool
            Whether a progress bar is shown.
        t_end : expression, optional
            End of the run.
        tolerance : float, optional
            Relative tolerance.
        step : expression, optional
            Fixed step.
        method : str, optional
            ``dormand-prince-853``, ``taylor``, ``tsitouras-5`` or ``runge-kutta-4``.
        precision : str, optional
            ``double`` or ``double-double``.
        formulation : str, optional
            The formulation whose equations are integrated.
        project : bool
            Moves inadmissible initial data to the nearest admissible state.
        keep_integrals : bool
            Keeps the first integrals that are found, by projection.
        branch : int, optional
            Which branch of the motion is followed, where there are several.

        Returns
        -------
        Study
            Verdicts by claim, and the trajectory.
        """
        named = words("claims", claims)
        if named == "":
            raise OptionError("claims: none is named; leave it out for all of them")
        asked = _asked(
            claims=named, budget=budget, t_end=t_end, tolerance=tolerance, step=step, method=method, precision=precision,
            formulation=formulation, project=project, keep_integrals=keep_integrals, branch=branch,
        )
        writable(out)
        with _Progress(progress) as tell:
            outcome = self._anew().study(asked, tell)
        return _finished(Study(outcome, outcome.summary(), (self, "study", asked)), outcome, out)

    def simulate(
        self,
        *,
        initial: Mapping[Any, Value] | None = None,
        out: str | os.PathLike[str] | None = None,
        progress: bool = False,
        t_end: Value = None,
        tolerance: float | None = None,
        step: Value = None,
        method: str | None = None,
        precision: str | None = None,
        formulation: str | None = None,
        project: bool = False,
        keep_integrals: bool = False,
        branch: int | None = None,
    ) -> Trajectory:
        """Computes the motion.

        Parameters
        ----------
        initial : mapping from names to values, optional
            Other initial values than those of the model, ``{"phi": 0.1, "x'": 2}``, as :meth:`with_initial`.
        out : path, optional
            A folder to write ``trajectory.csv`` and ``trajectory.npz`` into.
        progress : bool
            Whether a progress bar is shown.
        t_end : expression, optional
            End of the run, in the unit of time; that of the model, or 10 after the start, when left out.
        tolerance : float, optional
            Relative tolerance of the local error, from 2.3e-14 to 0.1; that of the model, or 1e-10, when left out.
        step : expression, optional
            Fixed step, in the unit of time.
        method : str, optional
            ``dormand-prince-853``, ``taylor``, ``tsitouras-5`` or ``runge-kutta-4``.
        precision : str, optional
            ``double`` or ``double-double``.
        formulation : str, optional
            The formulation whose equations are integrated.
        project : bool
            Moves inadmissible initial data to the nearest admissible state.
        keep_integrals : bool
            Keeps the first integrals that are found, by projection.
        branch : int, optional
            Which branch of the motion is followed, from 1, where there are several.

        Returns
        -------
        Trajectory
            Its columns are arrays of shape (rows,), by name: ``motion["x"]``.

        Raises
        ------
        ModelError
            Where no state satisfies the constraints, or something has no value.
        Interrupted
            By Ctrl-C; its ``result`` is the trajectory as far as it went.

        Examples
        --------
        >>> motion = System.from_gallery("chaplygin-sleigh").simulate(initial={"phi'": 2}, t_end=1)
        >>> float(motion["phi'"][0]), motion.y.shape == (len(motion), len(motion.names))
        (2.0, True)
        """
        if initial is not None:
            return self.with_initial(initial).simulate(
                out=out, progress=progress, t_end=t_end, tolerance=tolerance, step=step, method=method, precision=precision,
                formulation=formulation, project=project, keep_integrals=keep_integrals, branch=branch,
            )
        asked = _asked(
            t_end=t_end, tolerance=tolerance, step=step, method=method, precision=precision,
            formulation=formulation, project=project, keep_integrals=keep_integrals, branch=branch,
        )
        writable(out)
        with _Progress(progress) as tell:
            outcome = self._anew().simulate(asked, tell)
        return _finished(Trajectory(outcome, outcome.summary(), self, asked), outcome, out)

    def plot(
        self,
        *,
        out: str | os.PathLike[str] | None = None,
        at: float | None = None,
        ghosts: int = 0,
        width: int = 960,
        height: int = 540,
        progress: bool = False,
        t_end: Value = None,
        tolerance: float | None = None,
        step: Value = None,
        method: str | None = None,
        precision: str | None = None,
        formulation: str | None = None,
        project: bool = False,
        keep_integrals: bool = False,
        branch: int | None = None,
    ) -> Picture:
        """Draws the motion at a time.

        Parameters
        ----------
        out : path, optional
            A file to write: .svg, .png, or .json with the description of the picture.
        at : float, optional
            The time that is shown; the end when left out.
        ghosts : int
            Shows the bodies at so many earlier times too.
        width, height : int
            Width and greatest height in pixels.
        progress, t_end, tolerance, step, method, precision, formulation, project, keep_integrals, branch
            As in :meth:`simulate`.

        Returns
        -------
        Picture
        """
        motion = self.simulate(
            progress=progress, t_end=t_end, tolerance=tolerance, step=step, method=method, precision=precision,
            formulation=formulation, project=project, keep_integrals=keep_integrals, branch=branch,
        )
        picture = motion.picture(at=at, ghosts=ghosts, width=width, height=height)
        if out is not None:
            picture.save(out)
        return picture

    def film(
        self,
        *,
        out: str | os.PathLike[str] | None = None,
        seconds: float | None = None,
        width: int = 640,
        height: int = 360,
        progress: bool = False,
        t_end: Value = None,
        tolerance: float | None = None,
        step: Value = None,
        method: str | None = None,
        precision: str | None = None,
        formulation: str | None = None,
        project: bool = False,
        keep_integrals: bool = False,
        branch: int | None = None,
    ) -> Film:
        """Films the motion, as a GIF.

        Parameters
        ----------
        out : path, optional
            A .gif to write.
        seconds : float, optional
            How long the film is; as long as the motion, from 2 to 20 seconds, when left out.
        width, height : int
            Width and greatest height in pixels.
        progress, t_end, tolerance, step, method, precision, formulation, project, keep_integrals, branch
            As in :meth:`simulate`.

        Returns
        -------
        Film
        """
        motion = self.simulate(
            progress=progress, t_end=t_end, tolerance=tolerance, step=step, method=method, precision=precision,
            formulation=formulation, project=project, keep_integrals=keep_integrals, branch=branch,
        )
        film = motion.animate(seconds=seconds, width=width, height=height)
        if out is not None:
            film.save(out)
        return film

    def principles(
        self,
        *,
        compare: bool = False,
        kappa: Mapping[str, Value] | None = None,
        out: str | os.PathLike[str] | None = None,
        budget: float = 60.0,
        progress: bool = False,
        t_end: Value = None,
        tolerance: float | None = None,
        step: Value = None,
        method: str | None = None,
        precision: str | None = None,
        formulation: str | None = None,
        project: bool = False,
        keep_integrals: bool = False,
        branch: int | None = None,
    ) -> Study:
        """Tells what the variational principles say of the system.

        Parameters
        ----------
        compare : bool
            Computes the motion and the constrained extremum from the same state.
        kappa : mapping, optional
            Initial values of multipliers of the extremum, ``{"kappa_blade": 0.5}``.
        out : path, optional
            Folder to write the report, the record and the trajectory into; with ``compare``.
        budget : float
            Work for all claims together, in seconds of a usual machine.
        progress, t_end, tolerance, step, method, precision, formulation, project, keep_integrals, branch
            As in :meth:`simulate`.

        Returns
        -------
        Study
        """
        if kappa and not compare:
            raise OptionError("kappa: it needs compare=True")
        if out is not None and not compare:
            raise OptionError("out: it needs compare=True")
        asked = _asked(
            budget=budget, kappa=kappa, t_end=t_end, tolerance=tolerance, step=step, method=method, precision=precision,
            formulation=formulation, project=project, keep_integrals=keep_integrals, branch=branch,
        )
        writable(out)
        with _Progress(progress) as tell:
            outcome = self._anew().principles(asked, compare, tell)
        return _finished(Study(outcome, outcome.story(), (self, "principles", asked, compare)), outcome, out)

    def sweep(
        self,
        *,
        vary: Mapping[str, Any] | None = None,
        initial: Mapping[str, Any] | None = None,
        rows: Any = None,
        zip: bool = False,
        count: int | None = None,
        seed: int = 0,
        samples: int = 0,
        threads: int | None = None,
        stop_on_failure: bool = False,
        out: str | os.PathLike[str] | None = None,
        progress: bool = False,
        t_end: Value = None,
        tolerance: float | None = None,
        step: Value = None,
        method: str | None = None,
        precision: str | None = None,
        formulation: str | None = None,
        project: bool = False,
        keep_integrals: bool = False,
        branch: int | None = None,
    ) -> Sweep:
        """Computes many motions: parameters and initial values over ranges, from rows of values, or at random.

        Parameters
        ----------
        vary, initial : mapping from names to ranges, optional
            Values of parameters, and of coordinates and velocities: ``"0:1:20"``, ``"1:4:log:10"``, ``"0:1:uniform"`` (with ``count``), a number, or
            an array.
        rows : path, mapping from names to arrays, or data frame, optional
            One line of values for each trajectory.
        zip : bool
            Walks the ranges together instead of making their product.
        count : int, optional
            How many random values are drawn for ranges that are ``uniform``.
        seed : int
            What the random values follow from.
        samples : int
            Keeps so many states of each trajectory, a million at most, at equal intervals with both ends.
        threads : int, optional
            As many as the machine runs at once when left out; the results do not depend on them.
        stop_on_failure : bool
            Ends at the first trajectory that ends early or does not begin.
        out : path, optional
            A folder that keeps the sweep, as the command does, with ``sweep.npz`` and ``failures.csv`` once it is complete: one that was interrupted
            or killed goes on with the trajectories that are missing, whoever began it, and another one is refused.
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.
        t_end, tolerance, step, method, precision, formulation, project, keep_integrals, branch
            As in :meth:`simulate`.

        Returns
        -------
        Sweep
            A row for each trajectory.

        Raises
        ------
        Interrupted
            By Ctrl-C; its ``result`` has the trajectories that had ended.
        OptionError
            For a range that is none, and for a folder with another sweep.

        Examples
        --------
        >>> sleigh = System.from_gallery("chaplygin-sleigh")
        >>> found = sleigh.sweep(vary={"a": "0.1:0.5:5"}, initial={"phi": [0, 0.1]}, t_end=1)
        >>> len(found)
        10
        """
        from .sweeps import computed, kept, ranges, table_text

        samples, seed = whole("samples", samples, 0, _ROWS), whole("seed", seed, 0)
        count = None if count is None else whole("count", count, 1)
        threads = None if threads is None else whole("threads", threads, 1, 4096)
        asked = _asked(
            t_end=t_end, tolerance=tolerance, step=step, method=method, precision=precision,
            formulation=formulation, project=project, keep_integrals=keep_integrals, branch=branch,
        )
        varied = {
            "vary": ranges(self._by_names("vary", vary)), "initial": ranges(self._by_names("initial", initial)), "rows": table_text(rows),
            "zip": flag("zip", zip), "count": count, "seed": seed, "samples": samples,
        }
        writable(out)
        with _Progress(progress) as tell:
            prepared = self._anew().sweep(asked, varied, tell)
            if out is None:
                found, interrupted = computed(prepared, (0, prepared.count), threads, stop_on_failure, tell)
            else:
                found, interrupted = kept(prepared, out, threads, stop_on_failure, tell)
        if interrupted:
            raise Interrupted(found)
        return found

    def steady(self, *, symbolic: bool = False, progress: bool = False) -> Steady:
        """Finds all steady motions: equilibria, and motions along which everything that matters is constant.

        Parameters
        ----------
        symbolic : bool
            For parameters in general position, instead of their values in the model.
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.

        Returns
        -------
        Steady
            Its ``motions``, exact; where the equations cannot be solved exactly those that were found from starts, in numbers.

        Examples
        --------
        >>> [own["name"] for own in System.from_gallery("double-pendulum").steady().motions][:1]
        ['1']
        """
        with _Progress(progress) as tell:
            text, data = self._anew().steady(symbolic, tell)
        return Steady(self, json.loads(data), text)

    def linearize(
        self,
        *,
        about: str | None = None,
        at: str | None = None,
        speeds: str | Iterable[str] | None = None,
        outputs: str | Iterable[str] | None = None,
        symbolic: bool = False,
        numbers: bool = False,
        all: bool = False,
        save: str | os.PathLike[str] | None = None,
        progress: bool = False,
    ) -> Linearization:
        """Linear equations about a steady motion, exact.

        Parameters
        ----------
        about : str, optional
            A motion of ``steady``, the number of one that ``chetaev steady`` finds, ``rest`` (at the initial positions) or ``start`` (the initial state).
        at : str, optional
            Values of controls without a law and of parameters of a family, ``"u=1/2,theta_0=0.3"``.
        speeds : str or list of str, optional
            Independent speeds of choice: velocities, or functions linear in them.
        outputs : str or list of str, optional
            Outputs: functions of coordinates, velocities and controls; all variables when left out.
        symbolic : bool
            Leaves all parameters as symbols.
        numbers : bool
            Puts in the values of all parameters from the beginning: exact numbers alone.
        all : bool
            Also in all variables, ``E z' = A z + B u`` with coordinates, velocities and multipliers: ``to_dict()["all"]``; outputs may then be functions of
            all coordinates.
        save : path, optional
            Writes a file in the format of its end: .npz, .mat, .py (python-control), .tex, .json or .txt.
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.

        Returns
        -------
        Linearization
            The matrices as exact texts, in SymPy, in LaTeX, and the eigenvalues.
        """
        wanted = _wanted(about=about, at=at, speeds=speeds, outputs=outputs, symbolic=symbolic, numbers=numbers, all=all)
        with _Progress(progress) as tell:
            found = self._anew().stability(wanted, tell)
        result = Linearization(self, found, wanted)
        if save is not None:
            result.save(save)
        return result

    def stability(
        self, *, about: str | None = None, over: str | None = None, at: str | None = None, progress: bool = False
    ) -> Stability:
        """Decides the stability of a steady motion, also over a range of a parameter.

        Parameters
        ----------
        about : str, optional
            As in :meth:`linearize`.
        over : str, optional
            A parameter with a range, ``"v=0:10"``.
        at : str, optional
            As in :meth:`linearize`.
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.

        Returns
        -------
        Stability
            Eigenvalues; over a range its regions and critical values.
        """
        wanted = _wanted(about=about, over=over, at=at)
        with _Progress(progress) as tell:
            found = self._anew().stability(wanted, tell)
        return Stability(self, found, wanted)

    def stability_map(
        self, over: str, *, about: str | None = None, at: str | None = None, progress: bool = False
    ) -> StabilityMap:
        """Where a steady motion is stable in the plane of two parameters, ``"v=0:10,c=0.02:0.14"``: ``chetaev stability --over`` with two.

        Parameters
        ----------
        over : str
            Two parameters with their ranges.
        about, at : str, optional
            As in :meth:`linearize`.
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.

        Returns
        -------
        StabilityMap
            Regions with their boundaries.
        """
        wanted = word("over", over), word("about", about), word("at", at)
        with _Progress(progress) as tell:
            text, data, picture = self._anew().stability_map(*wanted, tell)
        return StabilityMap(json.loads(data), text, picture)

    def follow(
        self,
        *,
        about: str | None = None,
        over: str | None = None,
        orbit: bool = False,
        period: str | None = None,
        points: int = 500,
        step: float = 0.05,
        progress: bool = False,
    ) -> Followed:
        """Follows steady motions or periodic orbits over a range of a parameter, in numbers.

        Parameters
        ----------
        about : str, optional
            As in :meth:`linearize`; what is near it is searched.
        over : str, optional
            A parameter with a range, ``"eps=0.1:1"``; without it one motion is found.
        orbit : bool
            Periodic orbits, from the initial state or the motion named.
        period : str, optional
            The period of orbits, an expression of parameters; a guess of it where the equations do not contain the time.
        points : int
            At most so many on each side of the start.
        step : float
            The longest step along the curve, in parts of the range.
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.

        Returns
        -------
        Followed
            Points along the curve, and special ones.
        """
        points, step = whole("points", points, 1, 2**32 - 1), number("step", step)
        about, over, period = word("about", about), word("over", over), word("period", period)
        with _Progress(progress) as tell:
            text, data, picture = self._anew().follow(about, over, orbit, period, points, step, tell)
        return Followed(json.loads(data), text, picture)

    def along(self, *, progress: bool = False) -> LinearAlong:
        """Linear equations along the motion from the initial state: A(t), the transition matrix and its exponents, in numbers.

        Parameters
        ----------
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.

        Returns
        -------
        LinearAlong
            The matrices as arrays; its data are those of ``chetaev linearize --along --json``.

        Examples
        --------
        >>> found = System.from_gallery("chaplygin-sleigh").along()
        >>> found.variables, found.A.shape == (len(found.times), 2, 2)
        (['u', 'w'], True)
        """
        with _Progress(progress) as tell:
            text, data = self._anew().along(tell)
        return LinearAlong(json.loads(data), text)

    def sensitivity(
        self,
        by: str | Iterable[str],
        times: Iterable[float],
        *,
        second: bool = False,
        project: bool = False,
        progress: bool = False,
    ) -> Columns:
        """Derivatives of coordinates and velocities by parameters and given initial values, by the variational equations.

        Parameters
        ----------
        by : str or list of str
            Names of parameters and of given initial values, ``"a,x'"``.
        times : list of float
            Where they are wanted, ascending from the start.
        second : bool
            The second derivatives too.
        project : bool
            Whether initial data that contradict the constraints are moved to the nearest state that is admissible, as by ``simulate``; the
            derivatives are then those of the nearest state.
        progress : bool
            Whether a progress bar is shown, where tqdm is installed.

        Returns
        -------
        Columns
            A dict of arrays of shape (times,): ``t``, ``x``, ``d x/d a``, ``d2 x/d a d b``.
        """
        import numpy as np

        given = [by] if isinstance(by, str) or not isinstance(by, Iterable) else list(by)
        names = ",".join(self._name_of(own) for own in given)
        with _Progress(progress) as tell:
            columns, rows = self._anew().sensitivity(names, second, [float(t) for t in times], flag("project", project), tell)
        table = np.array(rows, dtype=np.float64).reshape(-1, len(columns))
        return Columns({name: table[:, place].copy() for place, name in enumerate(columns)})

    def compile(self, /, **values: Value) -> Compiled:
        """The equations of motion as functions of NumPy arrays, with the values of the model or these ones.

        Parameters
        ----------
        **values
            As :meth:`with_values`: what follows from them changes with them, and assumptions of the model are kept.

        Returns
        -------
        Compiled

        Raises
        ------
        ModelError
            For constraints of order two and more, whose motion ``simulate`` computes.

        Examples
        --------
        >>> from scipy.integrate import solve_ivp
        >>> f = System.from_gallery("chaplygin-sleigh").compile()
        >>> solve_ivp(f.rhs, (0, 10), f.start).success
        True
        """
        from .compiled import Compiled

        return Compiled(self.with_values(**values) if values else self)

    def widget(
        self, /, *, width: int = 720, height: int = 405, motion: Mapping[str, Any] | None = None, **ranges: tuple[float, float]
    ) -> Widget:
        """A picture of the motion with live sliders for parameters and for the time; it needs anywidget.

        Parameters
        ----------
        width, height : int
            Size of the picture in pixels.
        motion : mapping, optional
            Keywords of :meth:`simulate`.
        **ranges : pairs of numbers
            Parameters with the ends of their sliders: ``system.widget(a=(0.1, 0.5))``.

        Returns
        -------
        Widget
            A widget of anywidget.

        Examples
        --------
        >>> sleigh = System.from_gallery("chaplygin-sleigh")
        >>> live = sleigh.widget(a=(0.1, 0.5), motion={"t_end": 5})
        >>> live.values
        {'a': 0.25}
        """
        from .widget import Widget

        return Widget(self, self._by_names("ranges", ranges), (width, height), motion or {})

    def to_jax(self, formulation: str | None = None) -> Exported:
        """The equations of motion as a pure JAX function ``rhs(t, y, p)``, to be differentiated, mapped and compiled.

        Parameters
        ----------
        formulation : str, optional
            In the state of this formulation. When left out, it is the shortest of those whose equations are regular where the motion starts;
            ``Exported.formulation`` names it.

        Returns
        -------
        Exported
            Its ``rhs`` takes and gives arrays of JAX.
        """
        from .exported import jax_library

        return self._exported(jax_library, formulation)

    def to_casadi(self, formulation: str | None = None) -> Exported:
        """The equations of motion as an expression of CasADi, ``rhs(t, y, p)`` for symbols y and p: for optimal control.

        Parameters
        ----------
        formulation : str, optional
            As in :meth:`to_jax`.

        Returns
        -------
        Exported
            Its ``rhs`` takes and gives expressions of CasADi.
        """
        from .exported import casadi_library

        return self._exported(casadi_library, formulation)

    def to_opty(self) -> Residuals:
        """Equations of the first order that vanish along the motion, in SymPy, with states and parameters: what opty's ``Problem`` takes.

        Returns
        -------
        Residuals
        """
        from .exported import Residuals

        return Residuals(self)

    def _exported(self, library: Callable[[], Any], formulation: str | None) -> Exported:
        from .exported import Exported, names_of, regular_form

        name, source = regular_form(self._anew()) if formulation is None else (formulation, self._anew().derive([formulation], False, "python")[0])
        return Exported(source, library, names_of(source), name)


def _again(cls: type[System], path: str, text: str, includes: Any, overrides: Any, own: Origins | None = None) -> System:
    # What is doubtful was said when it was read first.
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelWarning)
        made = cls.__new__(cls)._take(native.Model.from_texts(path, text, includes, overrides))
    made._own = own
    return made


def readable(path: str | os.PathLike[str]) -> None:
    """Whether a file can be read, or Python's own exception that says why not."""
    with open(path, "rb"):
        pass


def of_gallery(name: str) -> tuple[str, str, list[tuple[str, str]]]:
    """Path, text and the files beside it of a model of the gallery."""
    texts = dict(native.gallery(name)[1])
    inside = f"{name.rpartition('/')[2]}/model.toml"
    own = inside if inside in texts else "model.toml"
    return own, texts[own], list(texts.items())


def _pairs(values: Mapping[str, Value] | None) -> list[tuple[str, str]]:
    return [(name, exact(value)) for name, value in mapping("values", values).items()]


def _is_left_out(name: str, section: Any) -> bool:
    """Whether a section is not written: the Lagrangian of a system whose bodies have the energies. What is unknown is refused though it is empty."""
    return name == "lagrangian" and not section


def _asked(**options: Any) -> dict[str, Any]:
    """All options, with those that are exact expressions as texts."""
    usual = {
        "claims": None, "budget": None, "t_end": None, "tolerance": None, "step": None, "method": None, "precision": None,
        "formulation": None, "project": False, "keep_integrals": False, "branch": None,
    }
    asked = {**usual, **options}
    for name in ("t_end", "step"):
        if asked[name] is not None:
            asked[name] = exact(asked[name])
    for name, kind in (("budget", seconds), ("tolerance", number)):
        if asked[name] is not None:
            asked[name] = kind(name, asked[name])
    for name in ("project", "keep_integrals"):
        asked[name] = flag(name, asked[name])
    if asked["branch"] is not None:
        asked["branch"] = whole("branch", asked["branch"], 1)
    for name in ("claims", "method", "precision", "formulation"):
        asked[name] = word(name, asked[name])
    asked["kappa"] = _pairs(options.get("kappa"))
    return asked


def _wanted(**options: Any) -> dict[str, Any]:
    """What is asked of linear equations, lists joined by commas."""
    asked = {"about": None, "speeds": None, "outputs": None, "symbolic": False, "numbers": False, "all": False, "over": None, "at": None, **options}
    for name in ("speeds", "outputs"):
        asked[name] = words(name, asked[name])
    for name in ("about", "over", "at"):
        asked[name] = word(name, asked[name])
    for name in ("symbolic", "numbers", "all"):
        asked[name] = flag(name, asked[name])
    return asked


def _finished(result: _Found, outcome: native.Outcome, out: str | os.PathLike[str] | None) -> _Found:
    """What was computed, written into a folder; its data name the files, as those of the command do."""
    if out is not None:
        result._data |= result._save(out)
        result._folder = os.path.abspath(out)
    if outcome.interrupted:
        raise Interrupted(result)
    return result


class _Progress:
    """A progress bar where tqdm is installed, else nothing."""

    def __init__(self, wanted: bool) -> None:
        self._bar: Any = None
        if wanted:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self._bar = tqdm(total=100, bar_format="{desc} {percentage:3.0f} %|{bar}| {elapsed}")

    def __enter__(self) -> Callable[[str, float | None], None] | None:
        return self._tell if self._bar is not None else None

    def _tell(self, what: str, fraction: float | None) -> None:
        self._bar.set_description_str(what)
        if fraction is not None:
            self._bar.n = round(100 * fraction)
        self._bar.refresh()

    def __exit__(self, *_: object) -> None:
        if self._bar is not None:
            self._bar.close()
