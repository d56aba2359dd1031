"""What the methods of a system give: objects that print, that notebooks typeset, and that are plain data where it is asked for."""

from __future__ import annotations

import contextlib
import difflib
import errno
import functools
import html
import json
import os
import re
import tempfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

from . import formulas, notebook, written
from .asked import number, whole
from .asked import seconds as seconds_of
from .keywords import in_python, of_data

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from matplotlib.axes import Axes
    from pandas import DataFrame

    from .chetaev_native import Linear, Outcome
    from .shapes import ComplexVector, Matrices, Matrix, Vector
    from .system import System
    from .trees import Module

Json = Any

#: The longest side of a picture in pixels.
_SIDE = 8192


def write(path: str | os.PathLike[str], content: bytes) -> None:
    """Writes a file completely or not at all."""
    path = os.fspath(path)
    folder = os.path.dirname(path) or "."
    os.makedirs(folder, exist_ok=True)
    handle, partial = tempfile.mkstemp(dir=folder, suffix=".partial")
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
        os.replace(partial, path)
    except BaseException:
        with contextlib.suppress(OSError):
            os.remove(partial)
        raise


def writable(folder: str | os.PathLike[str] | None) -> None:
    """Whether a folder can be written into or made, or Python's own exception that says why not: before work is done that would be lost."""
    if folder is None:
        return
    path = os.path.abspath(os.fspath(folder))
    while not os.path.exists(path):
        path = os.path.dirname(path)
    if not os.path.isdir(path):
        raise NotADirectoryError(errno.ENOTDIR, os.strerror(errno.ENOTDIR), path)
    if not os.access(path, os.W_OK):
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES), path)


class Shown:
    """What notebooks show: Jupyter by ``_repr_mimebundle_``, marimo by ``_mime_``."""

    def _html(self) -> str:
        raise NotImplementedError

    def _latex(self) -> str | None:
        return None

    def _repr_mimebundle_(self, include: Any = None, exclude: Any = None) -> dict[str, str]:
        bundle = {"text/plain": repr(self), "text/html": self._html()}
        latex = self._latex()
        if latex is not None:
            bundle["text/latex"] = latex
        return bundle

    def _mime_(self) -> tuple[str, str]:
        return "text/html", self._html()


class Result(Shown):
    """An answer with its data."""

    #: The folder of the files that its data name, where it was written into one as it was made.
    _folder: str | None = None

    def __init__(self, data: Json, text: str) -> None:
        self._data = data
        self._text = in_python(text)

    def to_dict(self) -> Json:
        """The data, equal to what the command writes with ``--json``.

        Returns
        -------
        dict or list
            Plain data: texts, numbers, lists and dicts.
        """
        return json.loads(json.dumps(self._data))

    def __str__(self) -> str:
        return self._text.rstrip("\n")

    def __repr__(self) -> str:
        return str(self)

    def _html(self) -> str:
        return f"<pre>{html.escape(str(self))}</pre>"


class Check(Result):
    """What is wrong or doubtful in a model.

    Attributes
    ----------
    ok : bool
        Whether there is no error.
    """

    def __init__(self, data: Json, text: str, has_errors: bool) -> None:
        super().__init__(data, text or "no errors")
        self.ok = not has_errors

    @property
    def diagnostics(self) -> list[dict[str, Any]]:
        """The problems, with keywords in the place of options of the command line."""
        return list(of_data(self.to_dict()))

    def _html(self) -> str:
        return written.problems(self.diagnostics, super()._html())


class Typeset(Result):
    """One equation, which has its LaTeX.

    Attributes
    ----------
    latex : str
        In LaTeX.
    """

    def __init__(self, data: Json, text: str, latex: str) -> None:
        super().__init__(data, text)
        self.latex = latex

    def to_latex(self) -> str:
        """The equation in LaTeX.

        Returns
        -------
        str
            For mathematics in a document with amsmath.
        """
        return self.latex

    def _latex(self) -> str | None:
        return f"$\\displaystyle {self.latex}$"

    def _html(self) -> str:
        return f"<p>{html.escape(self._latex() or '')}</p>"


class Equation(Typeset):
    """An equation ``left = right``.

    Attributes
    ----------
    label : str
        What it is the equation of; may be empty.
    left, right : str
        In the notation of the model, with the names and linear systems of long ones below ``where``; ``System.sympify`` reads them with the
        ``state`` of the formulation as ``variables``.
    latex : str
        In LaTeX.
    """

    def __init__(self, data: Mapping[str, str], place: tuple[Formulation, str, int] | None = None) -> None:
        super().__init__(dict(data), f"{data['left']} = {data['right']}", data["latex"])
        self.label = data["label"]
        self.left = data["left"]
        self.right = data["right"]
        self._place = place

    def to_sympy(self) -> Any:
        """The equation in SymPy, as :meth:`Derivation.to_sympy` has it.

        Returns
        -------
        sympy.Eq
            Unknowns of linear systems that equations share stay symbols.
        """
        if self._place is None:
            raise ValueError("only the equations of a derivation are written in SymPy")
        formulation, title, number = self._place
        return formulation.to_sympy()[title][number]


class Formulation(Result):
    """The equations of motion in one form.

    Attributes
    ----------
    name, title : str
        By which it is asked for, and what it is called.
    statement, principle : str
        What it states, and the principle that it follows from.
    not_derived : str or None
        Why it does not apply, and then it has no equations; ``None`` where it does.
    state : list of str
        Names of its state, which with the coordinates make the equations a system of the first order.
    groups : dict from str to list of Equation
        The equations by their headings.
    objects : dict from str to dict
        Intermediate results, as momenta, by their names.
    """

    def __init__(self, data: dict[str, Any], derivation: Derivation | None = None) -> None:
        self.name: str = data["formulation"]
        why = data.get("not_derived")
        self.not_derived: str | None = why if why is None else in_python(why)
        self.title: str = data.get("title", self.name)
        self.statement: str = data.get("statement", "")
        self.principle: str = data.get("principle", "")
        self.state: list[str] = data.get("state", [])
        self.groups: dict[str, list[Equation]] = {
            group["title"]: [Equation(own, (self, group["title"], number)) for number, own in enumerate(group["equations"])]
            for group in data.get("groups", [])
        }
        self.objects: dict[str, dict[str, Any]] = {own["name"]: own for own in data.get("objects", [])}
        self._derivation = derivation
        lines = [self.title]
        for heading, equations in self.groups.items():
            lines += [f"{heading}:"] + [f"  {own}" for own in equations]
        super().__init__(data, "\n".join(lines) if self.not_derived is None else self.not_derived)

    @property
    def equations(self) -> list[Equation]:
        """All equations, group by group."""
        return [own for group in self.groups.values() for own in group]

    def to_latex(self) -> str:
        """The equations in an ``aligned`` environment.

        Returns
        -------
        str
            A text for a document with amsmath.
        """
        return formulas.aligned(own.latex.replace(" = ", " &= ", 1) for own in self.equations)

    def to_sympy(self) -> dict[str, list[Any]]:
        """The equations in SymPy by their headings, as :meth:`Derivation.to_sympy` has them.

        Returns
        -------
        dict from str to list of sympy.Eq
            Nothing where the formulation does not apply.
        """
        if self._derivation is None:
            raise ValueError("only the forms of a derivation are written in SymPy")
        return dict(self._derivation.to_sympy().get(self.name, {}))

    def _latex(self) -> str | None:
        return f"$${self.to_latex()}$$" if self.groups else None

    def _html(self) -> str:
        if not self.groups:
            return super()._html()
        shown = notebook.heading(self.title)
        for heading, equations in self.groups.items():
            shown += notebook.paragraph(heading) + "".join(own._html() for own in equations)
        return shown


def _headed(page: str, titles: set[str]) -> str:
    """The fragment that ``--as mathml`` writes, its comments as headings: browsers typeset it without a script."""

    def heading(found: re.Match[str]) -> str:
        words = html.unescape(found[1])
        return f"<h4>{html.escape(words)}</h4>" if words in titles else f"<p><i>{html.escape(words)}</i></p>"

    return re.sub(r"<!-- (.*?) -->", heading, page, flags=re.DOTALL)


def part_of(parts: list[Any], which: Any, name: Callable[[Any], str]) -> Any:
    """One of several parts by its number, or by its name."""
    if not isinstance(which, str):
        return parts[which]
    for own in parts:
        if name(own) == which:
            return own
    raise KeyError(f"there is no `{which}`; there are {', '.join(map(name, parts))}")


class Derivation(Result, Sequence[Formulation]):
    """Equations of motion in one or several forms: ``derivation["maggi"]``, ``derivation[0]``.

    Attributes
    ----------
    formulations : list of Formulation
        The forms in the order in which they were asked for.
    notes : list of str
        What a reader must know.
    """

    def __init__(self, system: System, asked: tuple[list[str], bool], data: Json, notes: list[str]) -> None:
        self._system = system
        self._asked = asked
        self._shown: str | None = None
        self.notes = [in_python(own) for own in notes]
        self.formulations = [Formulation(own, self) for own in data]
        super().__init__(data, "\n\n".join(repr(own) for own in self.formulations))

    def __len__(self) -> int:
        return len(self.formulations)

    def __getitem__(self, which: Any) -> Any:
        """By number, or by the name of the formulation."""
        return part_of(self.formulations, which, lambda own: own.name)

    def __contains__(self, which: object) -> bool:
        """Whether there is a formulation of this name, or this one."""
        return which in self.formulations or which in [own.name for own in self.formulations]

    def to(self, notation: str) -> str:
        """The text of ``chetaev derive --as notation``: text, latex, mathml, sympy, json, rust, c, python, matlab or julia.

        Parameters
        ----------
        notation : str
            ``text``, ``latex``, ``mathml``, ``sympy``, ``json``, ``rust``, ``c``, ``python``, ``matlab`` or ``julia``.

        Returns
        -------
        str
            The text.
        """
        return self._system._anew().derive(*self._asked, notation)[0]

    def to_latex(self) -> str:
        """The equations in LaTeX.

        Returns
        -------
        str
            A text for a document with amsmath.
        """
        return self.to("latex")

    def to_sympy(self) -> dict[str, dict[str, list[Any]]]:
        """SymPy equations by formulation and heading, exact.

        Coordinates are ``sympy.Function("x", real=True)(t)``, parameters ``sympy.Symbol("m", real=True)``; of a system that was stated in SymPy all
        are the symbols, functions and time of the statement.

        Returns
        -------
        dict from str to dict from str to list of sympy.Eq
            Equations by formulation and heading. Unknowns of linear systems that equations share stay symbols, and the systems stand
            under the heading with ``: linear systems`` behind.
        """
        return {name: {title: list(own) for title, own in groups.items()} for name, groups in self._in_sympy.items()}

    @functools.cached_property
    def _in_sympy(self) -> dict[str, dict[str, list[Any]]]:
        sections = self._module().sections
        found = {own.name: sections[own.name.replace("-", "_")] for own in self.formulations if own.not_derived is None}
        own = self._system._own
        if own is None:
            return found
        return {
            name: {title: [own.back(one) for one in equations] for title, equations in groups.items()} for name, groups in found.items()
        }

    def __getstate__(self) -> dict[str, Any]:
        return {name: own for name, own in self.__dict__.items() if name != "_in_sympy"}

    def _module(self) -> Module:
        from .trees import Module

        names = [own.name.replace("-", "_") for own in self.formulations if own.not_derived is None]
        return Module(self.to("sympy"), names)

    def _latex(self) -> str | None:
        return "\n".join(f"$${own.to_latex()}$$" for own in self.formulations if own.groups)

    def _html(self) -> str:
        if self._shown is None:
            self._shown = _headed(self.to("mathml"), {own.title for own in self.formulations})
        return self._shown


class Counts(Result):
    """How many operations the equations of each form have as they are printed.

    Attributes
    ----------
    notes : list of str
        What a reader must know.
    """

    def __init__(self, text: str, notes: list[str]) -> None:
        super().__init__({"text": text, "notes": notes}, text)
        self.notes = [in_python(own) for own in notes]

    def _html(self) -> str:
        return written.counts(str(self)) + "".join(map(notebook.paragraph, self.notes))


class Steps(Result):
    """A derivation step by step, each step proved as it is written; its text is in the notation that was asked for.

    Attributes
    ----------
    notes : list of str
        What a reader must know.
    """

    def __init__(self, text: str, notes: list[str], system: System | None = None, asked: tuple[list[str], bool] = ([], False)) -> None:
        super().__init__({"text": text, "notes": notes}, text)
        self.notes = [in_python(own) for own in notes]
        self._system, self._asked = system, asked

    def to_latex(self) -> str:
        """The derivation in LaTeX.

        Returns
        -------
        str
            A whole document.
        """
        if self._is_latex():
            return str(self)
        if self._system is None:
            raise ValueError("only what System.steps gave is written in LaTeX")
        return self._system._anew().steps(*self._asked, "latex")[0].rstrip("\n")

    def _is_latex(self) -> bool:
        return str(self).startswith("\\documentclass")

    def _html(self) -> str:
        shown = notebook.unfolding("the document", super()._html()) if self._is_latex() else written.steps(str(self))
        return shown + "".join(map(notebook.paragraph, self.notes))


class Comparison(Result):
    """Two forms of the equations held against each other: what differs, and why it vanishes."""

    def __init__(self, system: System, data: Json, text: str) -> None:
        super().__init__(data, text)
        self._system = system

    def to_sympy(self) -> dict[str, dict[str, Any]]:
        """The differences of the two forms in SymPy.

        Returns
        -------
        dict from str to dict from str to sympy.Expr
            By what is compared, as ``accelerations, second minus first, at any state (q, v)``, and then by whose difference it is: ``x''``.

        Examples
        --------
        >>> from chetaev import System
        >>> found = System.from_gallery("chaplygin-sleigh").compare("routh", "maggi").to_sympy()
        >>> next(iter(found.values()))
        {"x''": 0, "y''": 0, "phi''": 0}
        """
        return {
            title: dict(zip(differences, formulas.in_sympy(self._system, differences.values())))
            for title, differences in written.differences(str(self)).items()
        }

    def to_latex(self) -> str:
        """The differences in LaTeX; this needs SymPy.

        Returns
        -------
        str
            For displayed mathematics in a document with amsmath: an ``aligned`` environment for each kind of difference.
        """
        shown = []
        for title, differences in self.to_sympy().items():
            rows = [f"{formulas.typeset(name)} &= {formulas.expression(own)}" for name, own in differences.items()]
            shown.append(f"{formulas.words(title)}\\colon\\quad\n{formulas.aligned(rows)}")
        return "\n\\\\\n".join(shown)

    def _html(self) -> str:
        return written.comparison(str(self)) + "".join(map(notebook.paragraph, self._data["notes"]))


class Steady(Result):
    """All steady motions: ``motions`` with their values, exact and enclosed; families have free variables and equations.

    Where the equations cannot be solved exactly these are motions that were found from starts, in numbers, and there may be others.

    Attributes
    ----------
    complete : bool
        Whether these are all, proved.
    """

    def __init__(self, system: System, data: Json, text: str) -> None:
        super().__init__(data, text)
        self._system = system
        self.complete: bool = data["complete"]

    @property
    def motions(self) -> list[dict[str, Any]]:
        """The motions, as in the JSON of the command."""
        return list(self.to_dict()["motions"])

    def to_sympy(self) -> dict[str, dict[str, Any]]:
        """The motions in SymPy.

        Returns
        -------
        dict from str to dict
            By the name of the motion: ``values``, a dict from the variables to expressions; ``equations``, a list of expressions that vanish
            along it; ``not_negative``, a list of expressions that are not negative. Parameters of families are symbols. Numbers that have no
            formula have the digits of their enclosure.

        Examples
        --------
        >>> from chetaev import System
        >>> System.from_gallery("double-pendulum").steady().to_sympy()["2"]["values"]["b"]
        pi
        """
        from .steady import in_sympy

        return in_sympy(self._system, self._data)

    def to_latex(self) -> str:
        """The motions in LaTeX; this needs SymPy.

        Returns
        -------
        str
            For displayed mathematics in a document with amsmath: an ``aligned`` environment for each motion.
        """
        from .steady import latex

        return latex(self.to_sympy())

    def _html(self) -> str:
        data = self._data
        speeds = [(notebook.code(own["name"]), notebook.code(own["definition"])) for own in data.get("speeds", [])]
        rows = []
        for own in data["motions"]:
            values = ", ".join(f"{one['name']} = {one['exact'] if one.get('exact') is not None else one.get('value')}" for one in own["values"])
            conditions = [f"{one} = 0" for one in own["equations"]] + [f"{one} ≥ 0" for one in own["not_negative"]]
            rows.append((own["name"], notebook.code(values), ", ".join(own["free"]), "; ".join(map(str, conditions))))
        shown = notebook.table(["motion", "constant along it", "free", "where"], rows)
        named = notebook.unfolding("what the speeds are", notebook.table([], speeds)) if speeds else ""
        return shown + named + notebook.unfolding("in words", super()._html())


class StabilityMap(Result):
    """Stability over two parameters: ``growth`` on a grid, ``boundaries`` as curves, ``equations`` of these."""

    def __init__(self, data: Json, text: str, picture: str) -> None:
        super().__init__(data, text)
        self._picture = picture

    def picture(self) -> str:
        """Regions with their boundaries as SVG.

        Returns
        -------
        str
            SVG.
        """
        return self._picture

    def _html(self) -> str:
        return notebook.picture(self._picture) + notebook.unfolding("in words", super()._html())


class LinearAlong(Result):
    """Linear equations ``z' = A(t) z`` along a motion, in numbers.

    Attributes
    ----------
    variables : list of str
        The components of z: deviations from the motion.
    times : array of shape (times,)
        When.
    state : array of shape (times, variables)
        The motion in these variables.
    A : array of shape (times, variables, variables)
        The matrices.
    transition : array of shape (times, variables, variables)
        What takes deviations at the start to those at each time.
    exponents : array of shape (times, variables)
        Lyapunov exponents over the time until then, the largest first; not a number at the start, where there are none.
    """

    def __init__(self, data: Json, text: str) -> None:
        import numpy as np

        super().__init__(data, text)
        rows, count = data["rows"], len(data["variables"])
        self.variables: list[str] = list(data["variables"])
        self.times: Vector = np.array([own["t"] for own in rows], dtype=float)
        self.state: Matrix = np.array([own["state"] for own in rows], dtype=float)
        self.A: Matrices = np.array([own["A"] for own in rows], dtype=float)
        self.transition: Matrices = np.array([own["transition"] for own in rows], dtype=float)
        none = [float("nan")] * count
        self.exponents: Matrix = np.array([own["exponents"] or none for own in rows], dtype=float)

    def _html(self) -> str:
        last = len(self.times) - 1
        shown = notebook.paragraph(f"{self._data['system']}: z' = A(t) z with z = ({', '.join(self.variables)})")
        for at in sorted({0, last}):
            shown += notebook.matrix(f"A({self.times[at]:.6g})", [[f"{own:.6g}" for own in row] for row in self.A[at]])
        rows = [[float(t), *map(float, exponents)] for t, exponents in zip(self.times, self.exponents)]
        head = ["t", *(f"exponent {own + 1}" for own in range(len(self.variables)))]
        return shown + notebook.table(head, rows[1:]) + notebook.unfolding("in words", super()._html())


class Followed(Result):
    """Steady motions or orbits over a range of a parameter: ``points`` with their eigenvalues or multipliers, ``special`` ones."""

    def __init__(self, data: Json, text: str, picture: str | None = None) -> None:
        super().__init__(data, text)
        self._picture = picture

    def picture(self) -> str | None:
        """The motion, or the period of orbits, over the range, and its eigenvalues or multipliers, special points named; ``None`` without a range.

        Returns
        -------
        str or None
            SVG.
        """
        return self._picture

    @property
    def points(self) -> list[dict[str, Any]]:
        """Points of the curve: value of the parameter, state, eigenvalues or multipliers, stability; in the order of the curve."""
        return list(self.to_dict()["points"])

    @property
    def special(self) -> list[dict[str, Any]]:
        """Folds, branch points, Hopf points, multipliers on the unit circle."""
        return list(self.to_dict()["special"])

    def _html(self) -> str:
        data = self._data
        name = data.get("parameter") or "value"

        def rows(points: Any) -> str:
            keys = [key for key in ("kind", "value", "state", "period", "eigenvalues", "multipliers", "stability") if any(key in own for own in points)]
            head = [name if key == "value" else key for key in keys]
            return notebook.table(head, [[own.get(key, "") if key == "kind" else _listed(own.get(key)) for key in keys] for own in points])

        special = rows(data["special"]) if data["special"] else notebook.paragraph("No special points were met.")
        shown = notebook.picture(self._picture) + special + notebook.unfolding(f"{len(data['points'])} points", rows(data["points"]))
        return shown + notebook.unfolding("in words", super()._html())


def _listed(value: Any) -> Any:
    """Pairs of real and imaginary parts as complex numbers, one after the other."""
    if isinstance(value, list) and value and all(isinstance(own, list) for own in value):
        return ", ".join(notebook.complex_number(own) for own in value)
    return [float(own) for own in value] if isinstance(value, list) and len(value) != 2 else value


class Linearization(Result):
    """Linear equations ``E z' = F z`` about a steady motion, exact.

    Attributes
    ----------
    variables : list of str
        The components of z: deviations from the motion.
    """

    def __init__(self, system: System, native: Linear, asked: Mapping[str, Any]) -> None:
        super().__init__(json.loads(native.json()), native.ranges() if isinstance(self, Stability) else native.equations())
        self._system = system
        self._native = native
        self._asked = dict(asked)
        self.variables: list[str] = self._data["variables"]

    def __reduce__(self) -> tuple[Any, ...]:
        return _linear_again, (type(self), self._system, self._asked)

    def to_latex(self) -> str:
        """The matrices in LaTeX.

        Returns
        -------
        str
            Displayed equations, for a document with amsmath.
        """
        return self._native.latex()

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a file in the format of its end: .npz, .mat, .py (python-control), .tex, .json or .txt.

        Parameters
        ----------
        path : path
            The file to write.
        """
        own = self._native
        formats: dict[str, Any] = {
            ".npz": own.npz, ".mat": own.mat, ".py": own.control, ".tex": own.latex, ".txt": own.equations,
            ".json": lambda: json.dumps(self._data, indent=2, ensure_ascii=False) + "\n",
        }
        end = os.path.splitext(path)[1]
        if end not in formats:
            raise ValueError(f"{os.fspath(path)}: the end of the name says the format: {', '.join(formats)}")
        content = formats[end]()
        write(path, content.encode() if isinstance(content, str) else bytes(content))

    def _html(self) -> str:
        data = self._data
        shown = notebook.paragraph(f"{data['system']}, steady motion {data['motion']}: E z' = F z with z = ({', '.join(self.variables)})")
        shown += "".join(notebook.matrix(name, data[name]) for name in "EFABCD" if data.get(name))
        if data.get("eigenvalues"):
            shown += notebook.table(["eigenvalues"], [[notebook.complex_number(own)] for own in data["eigenvalues"]])
        return shown + notebook.unfolding("in words", super()._html())

    def _latex(self) -> str | None:
        return self.to_latex()

    @property
    def E(self) -> list[list[str]]:
        """The left matrix, exact texts."""
        return [list(row) for row in self._data["E"]]

    @property
    def F(self) -> list[list[str]]:
        """The right matrix, exact texts."""
        return [list(row) for row in self._data["F"]]

    @property
    def eigenvalues(self) -> ComplexVector | None:
        """At the values of the model, in 1/s where the model states units, shape (variables,); ``None`` where one has no value."""
        import numpy as np

        pairs = self._data["eigenvalues"]
        return None if pairs is None else np.array([complex(re, im) for re, im in pairs])

    def to_sympy(self) -> tuple[Any, Any]:
        """The matrices E and F.

        Returns
        -------
        tuple of sympy.Matrix, sympy.Matrix
            E and F, of shape (variables, variables). Parameters that a family of motions has brought, as ``speed_1``, are symbols.
        """
        import sympy as sp

        rows = self.E + self.F
        texts = [own for row in rows for own in row]
        family = set(formulas.introduced(self._system, texts)) - set(self._data["inputs"])
        flat = formulas.constants(self._system.sympify(texts, variables=sorted(family)), family)
        width, height = len(self.variables), len(self.E)
        cells = iter(flat)
        whole = [[next(cells) for _ in range(width)] for _ in rows]
        return sp.Matrix(whole[:height]), sp.Matrix(whole[height:])


def _linear_again(kind: type[Linearization], system: System, asked: dict[str, Any]) -> Linearization:
    """Linear equations that were pickled: computed again, exactly."""
    return kind(system, system._anew().stability(asked, None), asked)


class Stability(Linearization):
    """Stability of a steady motion; over a range of a parameter ``regions`` and ``critical`` values with their enclosures."""

    def picture(self) -> str | None:
        """Eigenvalues over the range as SVG; ``None`` without a range.

        Returns
        -------
        str or None
            SVG.
        """
        return self._native.picture()

    def _html(self) -> str:
        data = self._data
        if "regions" not in data:
            return super()._html()
        name = data["parameter"]
        words = {
            "asymptotic": "all eigenvalues but the zeros of a family are left of the axis" if data["family"] else "all eigenvalues are left of the axis",
            "unstable": "an eigenvalue is right of the axis",
        }
        regions = [(f"{own['from']:g} < {name} < {own['to']:g}", words.get(own["stability"], own["stability"])) for own in data["regions"]]
        critical = [(f"{name} = {own['value']:.12g}", own["kind"]) for own in data["critical"]]
        shown = notebook.table([name, "eigenvalues"], regions)
        if critical:
            shown += notebook.table(["critical value", "what happens"], critical)
        return shown + notebook.picture(self.picture()) + notebook.unfolding("linear equations", super()._html())

    def _latex(self) -> str | None:
        return None if "regions" in self._data else super()._latex()

    @property
    def critical(self) -> list[dict[str, Any]] | None:
        """Values of the parameter at which stability changes, with enclosures; ``None`` without a range."""
        found: list[dict[str, Any]] | None = self.to_dict().get("critical")
        return found

    @property
    def regions(self) -> list[dict[str, Any]] | None:
        """Intervals of the parameter with what holds in each; ``None`` without a range."""
        found: list[dict[str, Any]] | None = self.to_dict().get("regions")
        return found


class Verdict(Result):
    """One claim with its verdict and the evidence.

    Attributes
    ----------
    claim : str
        ``id`` or ``id#subject``.
    verdict : str
        ``proved``, ``numerical``, ``refuted``, ``conditional``, ``not-applicable`` or ``undecided``.
    detail : str
        One sentence.
    data : dict
        All of the record: method, bound of the error, seed, counterexample, condition, formulas.
    """

    def __init__(self, data: dict[str, Any], system: System | None = None) -> None:
        self.data = data
        self._system = system
        subject = data["subject"]
        self.claim: str = data["claim"] if subject is None else f"{data['claim']}#{subject}"
        self.verdict: str = data["verdict"]
        self.detail: str = in_python(data["detail"])
        super().__init__(data, f"{self.claim}: {self.verdict}: {self.detail}")

    def to_sympy(self) -> list[Any]:
        """The formulas of the evidence in SymPy, as an integral that was found.

        Names that the model has not declared, as those of momenta and variations, are functions of the time.

        Returns
        -------
        list of sympy.Expr or sympy.Eq
            Those with two sides are equations; what a record leaves out for its length is left out here too.
        """
        texts = [own for own in self.data.get("formulas") or [] if own != "…"]
        if not texts:
            return []
        if self._system is None:
            raise ValueError("formulas of fields are not written in SymPy; those of a System are")
        return formulas.in_sympy(self._system, texts)

    def to_latex(self) -> str:
        """The claim, the verdict and the formulas of the evidence in LaTeX; this needs SymPy.

        Returns
        -------
        str
            For displayed mathematics in a document with amsmath.
        """
        said = formulas.words(f"{self.claim}: {self.verdict}")
        rows = [formulas.row(own) for own in self.to_sympy()]
        return f"{said}\\quad\n{formulas.aligned(rows)}" if rows else said

    def __bool__(self) -> bool:
        raise TypeError("a verdict has no truth value: compare `verdict` with one of the six words")

    def _html(self) -> str:
        return notebook.verdicts([self])


class Columns(dict[str, "Vector"], Shown):
    """Columns of one length by their names: a dict of arrays of shape (rows,)."""

    def _html(self) -> str:
        return notebook.columns(self)

    def to_dict(self) -> dict[str, list[float]]:
        """The columns as lists of numbers.

        Returns
        -------
        dict from str to list of float
            By the names of the columns.
        """
        return {name: own.tolist() for name, own in self.items()}

    def to_pandas(self) -> DataFrame:
        """A ``pandas.DataFrame`` with the time as index.

        Returns
        -------
        pandas.DataFrame
            A column for each array but ``t``.
        """
        import pandas as pd

        return pd.DataFrame(dict(self)).set_index("t")


class DenseOutput:
    """A motion at any time of its span, by polynomials of degree five between the rows.

    They have the coordinates, velocities and accelerations of both rows (Hermite's interpolation), so that what they leave out is of the
    sixth order in the distance of the rows in the coordinates, and of the fifth in the velocities. Masses with a law of their own have their rates
    at both rows, which leaves out the fourth order. ``simulate`` computes rows for times of choice where that is too much:
    ``simulation={"output": 5000}`` in the model.

    Attributes
    ----------
    names : list of str
        The coordinates, then masses with a law of their own, then the velocities: the ``state`` of the compiled functions.
    coordinates, masses : list of str
        These alone.
    t_min, t_max : float
        The span.
    """

    def __init__(self, trajectory: Trajectory) -> None:
        import numpy as np

        known = set(trajectory.names)
        self.coordinates = [name for name in trajectory.names if f"{name}'" in known and f"{name}''" in known and "'" not in name]
        system = trajectory._system
        self.masses = [] if system is None else [name for name in system.masses if name in known]
        self.names = self.coordinates + self.masses + [f"{name}'" for name in self.coordinates]
        order = np.argsort(trajectory.t, kind="stable")
        t = trajectory.t[order]
        kept = np.concatenate([[True], np.diff(t) > 0])
        self._t = t[kept]
        q, v, a = (
            np.stack([trajectory[name + primes][order][kept] for name in self.coordinates])
            for primes in ("", "'", "''")
        )
        self.t_min, self.t_max = float(self._t[0]), float(self._t[-1])
        if len(self._t) < 2:
            self._coefficients = np.stack([q, v, a / 2])
            self._masses = np.stack(_masses_and_rates(trajectory, self.masses, order[kept]))
            return
        h = np.diff(self._t)
        # What the Taylor polynomial of the left row leaves at the right one, in the three derivatives.
        left = q[:, :-1], v[:, :-1] * h, a[:, :-1] * h**2 / 2
        rest = q[:, 1:] - sum(left)
        slope = v[:, 1:] * h - left[1] - 2 * left[2]
        bend = a[:, 1:] * h**2 - 2 * left[2]
        cubic = 10 * rest - 4 * slope + bend / 2
        quartic = -15 * rest + 7 * slope - bend
        quintic = 6 * rest - 3 * slope + bend / 2
        scaled = np.stack([*left, cubic, quartic, quintic])
        self._coefficients = scaled / h ** np.arange(6)[:, None, None]
        m, rates = _masses_and_rates(trajectory, self.masses, order[kept])
        start, rise, slope = m[:, :-1], np.diff(m), rates * np.concatenate([h, h[-1:]])
        after = rates[:, 1:] * h
        cubics = np.stack([start, slope[:, :-1], 3 * rise - 2 * slope[:, :-1] - after, slope[:, :-1] + after - 2 * rise])
        self._masses = cubics / h ** np.arange(4)[:, None, None]

    def __repr__(self) -> str:
        return f"<sol(t): y = ({', '.join(self.names)}), t from {self.t_min:g} to {self.t_max:g}>"

    def __call__(self, t: ArrayLike) -> NDArray[np.float64]:
        """The state at a time, in the order of ``names``, shape (names,), or at many, shape (names, times).

        Parameters
        ----------
        t : float or array of shape (times,)
            Times of the span.

        Returns
        -------
        array
            Of shape (names,) or (names, times), in SI units.

        Raises
        ------
        ValueError
            For a time outside the span.
        """
        import numpy as np

        times = np.asarray(t, dtype=float)
        flat = np.atleast_1d(times)
        if flat.ndim != 1:
            raise ValueError("t is a number or a vector")
        if not np.all((flat >= self.t_min) & (flat <= self.t_max)):
            raise ValueError(f"the motion is known from t = {self.t_min} to {self.t_max}")
        pieces = self._coefficients.shape[2] if len(self._t) > 1 else 1
        piece = np.clip(np.searchsorted(self._t, flat, side="right") - 1, 0, pieces - 1)
        x = flat - self._t[piece]
        c = self._coefficients[:, :, piece]
        place, rate = np.zeros_like(c[0]), np.zeros_like(c[0])
        for own in c[::-1]:
            rate = rate * x + place
            place = place * x + own
        mass = np.zeros((len(self.masses), len(flat)))
        for own in self._masses[:, :, piece][::-1]:
            mass = mass * x + own
        found = np.concatenate([place, mass, rate])
        return found[:, 0] if times.ndim == 0 else found


def _masses_and_rates(trajectory: Trajectory, masses: list[str], rows: NDArray[np.intp]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Masses with a law of their own at rows of a motion, and their rates, each of shape (masses, rows)."""
    import numpy as np

    if not masses or trajectory._system is None:
        return np.zeros((0, len(rows))), np.zeros((0, len(rows)))
    f = trajectory._system.compile()
    y = np.stack([trajectory[name][rows] for name in f.state], axis=-1)
    rates = f.rhs(trajectory.t[rows], np.ascontiguousarray(y))
    return np.stack([trajectory[name][rows] for name in masses]), np.stack([rates[:, f.state.index(name)] for name in masses])


class _Remembered:
    """What a computation gave, without its native part; pictures, films and reports compute it again, with the same result."""

    def __init__(self, kept: dict[str, Any], again: tuple[Any, ...]) -> None:
        self.__dict__.update(kept)
        self._again = again

    def __reduce__(self) -> tuple[Any, ...]:
        kept = {name: own for name, own in self.__dict__.items() if name not in ("_again", "_outcome")}
        return _Remembered, (kept, self._again)

    @functools.cached_property
    def _outcome(self) -> Outcome:
        system, what, *asked = self._again
        found: Outcome = getattr(system._anew(), what)(*asked)
        return found

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self._outcome, name)


def remembered(outcome: Any, again: tuple[Any, ...] | None) -> _Remembered:
    """A computation as it is pickled."""
    if isinstance(outcome, _Remembered):
        return outcome
    if again is None:
        raise TypeError("only what the methods of a System gave is pickled")
    kept = {name: getattr(outcome, name) for name in ("interrupted", "status", "notices", "has_motion")}
    return _Remembered(kept, again)


class Trajectory(Result):
    """A computed motion, by name and by axis.

    ``motion["x"]``, ``motion["x'"]``, ``motion["lambda_blade"]`` are arrays of shape (rows,); ``motion[["x", "y"]]`` is an array of shape (rows, 2);
    ``motion[0]`` and ``motion[10:20]`` are rows of ``y``, shape (columns,) and (10, columns). ``"x" in motion`` asks for a name, and a loop goes over
    the names, as of a mapping; ``len(motion)`` counts the rows, as of an array. Quantities are in SI units where the model states units.

    Attributes
    ----------
    names : list of str
        Names of the columns: ``t``, coordinates, velocities, accelerations, multipliers, ``energy``, integrals.
    """

    def __init__(
        self, outcome: Any, text: str, system: System | None = None, asked: Mapping[str, Any] | None = None, again: tuple[Any, ...] | None = None
    ) -> None:
        self._outcome: Outcome = outcome
        self._system = system
        self._again = again if again is not None or asked is None else (system, "simulate", asked)
        super().__init__(json.loads(outcome.run([])), text)
        names, columns = self._outcome.columns()
        self.names: list[str] = names
        self._columns: Matrix = columns

    def __reduce__(self) -> tuple[Any, ...]:
        kept = {name: own for name, own in self.__dict__.items() if name not in ("sol", "verdicts")}
        return _unpickled, (Trajectory, {**kept, "_outcome": remembered(self._outcome, self._again)})

    @overload
    def __getitem__(self, which: str | int) -> Vector: ...

    @overload
    def __getitem__(self, which: list[str] | tuple[str, ...] | slice) -> Matrix: ...

    def __getitem__(self, which: Any) -> Any:
        """Columns by their names, rows by their numbers."""
        if isinstance(which, str):
            return self._columns[self._place(which)]
        if isinstance(which, (list, tuple)) and which and all(isinstance(own, str) for own in which):
            return self._columns[[self._place(own) for own in which]].T
        return self.y[which]

    def _place(self, name: str) -> int:
        if name in self.names:
            return self.names.index(name)
        # Of redundant constraints only sums of multipliers are determined.
        parts = [own for own in self.names if name in re.findall(r"[A-Za-z_0-9']+", own)]
        hint = f"; `{name}` itself is not determined, only {', '.join(f'`{own}`' for own in parts)}" if parts else ""
        raise KeyError(f"there is no column `{name}`{hint}; there are {', '.join(self.names)}")

    def __contains__(self, name: object) -> bool:
        return name in self.names

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return int(self._columns.shape[1])

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[Any]:
        """``numpy.asarray(motion)`` is ``motion.y``."""
        import numpy as np

        return np.array(self.y, dtype=dtype, copy=True if copy is None else copy)

    def keys(self) -> list[str]:
        """Names of the columns; with this, ``dict(trajectory)`` works.

        Returns
        -------
        list of str
            The same as ``names``.
        """
        return list(self.names)

    @property
    def t(self) -> Vector:
        """The times, shape (rows,)."""
        return self["t"]

    @property
    def y(self) -> Matrix:
        """All columns in the order of ``names``, shape (rows, columns); the time is the first."""
        return self._columns.T

    @functools.cached_property
    def verdicts(self) -> list[Verdict]:
        """What was decided of the motion: its error, drifts, what the model expects."""
        return [Verdict(own, self._system) for own in json.loads(self._outcome.record([]))["verdicts"]]

    @functools.cached_property
    def sol(self) -> DenseOutput:
        """The motion between the rows: ``trajectory.sol(t)``."""
        return DenseOutput(self)

    def sensitivities(self, by: str | Sequence[str]) -> Columns:
        """Derivatives of coordinates and velocities by parameters and given initial values, at the times of the rows.

        Parameters
        ----------
        by : str or list of str
            Names, as of :meth:`chetaev.System.sensitivity`.

        Returns
        -------
        Columns
            A dict of arrays of shape (rows,): ``t``, ``x``, ``d x/d a``, …
        """
        if self._system is None:
            raise ValueError("sensitivities are computed of what System.simulate gave")
        project = self._again is not None and self._again[2]["project"]
        return self._system.sensitivity(by, self.t, project=project)

    @property
    def finished(self) -> bool:
        """Whether the end of the time span was reached."""
        return bool(self._data["finished"])

    @property
    def reason(self) -> str:
        """Why it ended."""
        return in_python(str(self._data["reason"]))

    @property
    def notices(self) -> list[str]:
        """What a reader must know."""
        return [in_python(own) for own in self._data["notices"]]

    @property
    def drift(self) -> dict[str, float | None]:
        """Largest changes of constraints, energy and integrals along the motion, absolute and in the units of what is named. What to hold them
        against stands in :attr:`scales`."""
        return {own["name"]: own["value"] for own in self._data["drifts"]}

    @property
    def scales(self) -> dict[str, float]:
        """Largest magnitudes along the motion of what :attr:`drift` names and the columns have, so that
        ``motion.drift["energy"] / motion.scales["energy"]`` is the relative change."""
        import numpy as np

        return {name: float(np.max(np.abs(self[name]))) for name in self.drift if name in self.names}

    @property
    def events(self) -> list[dict[str, Any]]:
        """Events that were met: ``event``, its name; ``t``, the time; ``zero``, how its function passes zero; ``state``, names with values."""
        return list(self.to_dict()["events"])

    def to_numpy(self) -> Matrix:
        """One array of shape (rows, columns), as ``y``.

        Returns
        -------
        array of shape (rows, columns)
            In SI units.
        """
        return self.y

    def to_pandas(self) -> DataFrame:
        """A ``pandas.DataFrame`` with the time as index.

        Returns
        -------
        pandas.DataFrame
            A row for each time.
        """
        import pandas as pd

        frame = pd.DataFrame({name: self[name] for name in self.names})
        return frame.set_index("t")

    def to_polars(self) -> Any:
        """A ``polars.DataFrame``.

        Returns
        -------
        polars.DataFrame
            A row for each time, which is the first column.
        """
        import polars as pl  # pyright: ignore[reportMissingImports]

        return pl.DataFrame({name: self[name] for name in self.names})

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over the time.

        Returns
        -------
        xarray.Dataset
            A variable over ``t`` for each column.
        """
        import xarray as xr

        return xr.Dataset({name: ("t", self[name]) for name in self.names[1:]}, coords={"t": self.t})

    def to_arrow(self) -> Any:
        """A ``pyarrow.Table``.

        Returns
        -------
        pyarrow.Table
            A row for each time, which is the first column.
        """
        import pyarrow as pa

        return pa.table({name: pa.array(self[name]) for name in self.names})

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def to_csv(self) -> str:
        """The text of ``trajectory.csv``.

        Returns
        -------
        str
            With a line of names.
        """
        return self._outcome.csv()

    def plot(self, names: Sequence[str] | str | None = None, ax: Axes | None = None) -> Axes:
        """Draws columns over the time by matplotlib.

        Parameters
        ----------
        names : str or list of str, optional
            Columns; the coordinates when left out.
        ax : matplotlib.axes.Axes, optional
            Where; a new figure when left out.

        Returns
        -------
        matplotlib.axes.Axes
        """
        if isinstance(names, str):
            names = [names]
        if ax is None:
            import matplotlib.pyplot as plt

            _, ax = plt.subplots()
        wanted = list(names) if names is not None else [own["name"] for own in self._data["initial"] if "'" not in own["name"]]
        for name in wanted:
            ax.plot(self.t, self[name], label=name)
        ax.set_xlabel("t")
        ax.legend()
        return ax

    def picture(self, *, at: float | None = None, ghosts: int = 0, width: int = 960, height: int = 540) -> Picture:
        """The drawing at a time, the end when left out, with the bodies at so many earlier times.

        Parameters
        ----------
        at : float, optional
            The time that is shown; the end when left out.
        ghosts : int
            At how many earlier times the bodies are shown too.
        width : int
            Width in pixels.
        height : int
            Greatest height in pixels.

        Returns
        -------
        Picture

        Raises
        ------
        ValueError
            For a time outside the motion.
        """
        first, last = sorted((self._data["t_start"], self._data["t"]))
        if at is not None and not first <= number("at", at) <= last:
            raise ValueError(f"at: the motion is known from t = {first:g} to {last:g}, and not at {at}")
        size = whole("width", width, 1, _SIDE), whole("height", height, 1, _SIDE)
        return Picture(self._outcome, at, whole("ghosts", ghosts, 0, 1000), size, self._again)

    def animate(self, *, seconds: float | None = None, width: int = 640, height: int = 360) -> Film:
        """The moving drawing, of so many seconds.

        Parameters
        ----------
        seconds : float, optional
            How long the film is; as long as the motion, from 2 to 20 seconds, when left out.
        width : int
            Width in pixels.
        height : int
            Greatest height in pixels.

        Returns
        -------
        Film
            A GIF, which notebooks show.
        """
        length = None if seconds is None else seconds_of("seconds", seconds)
        return Film(self._outcome, length, (whole("width", width, 1, _SIDE), whole("height", height, 1, _SIDE)))

    def report(self) -> str:
        """The report, one HTML page with equations, plots and animation.

        Returns
        -------
        str
            HTML that needs nothing else.
        """
        return self._outcome.page([])

    def save_report(self, path: str | os.PathLike[str]) -> None:
        """Writes the report.

        Parameters
        ----------
        path : path
            The .html to write.
        """
        write(path, self.report().encode())

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes ``trajectory.csv``, ``trajectory.npz`` and, where the model states events, ``events.csv``.

        Parameters
        ----------
        folder : path
            A folder, which is made where there is none.
        """
        self._save(folder)

    def _save(self, folder: str | os.PathLike[str]) -> dict[str, Any]:
        """What the data say of what was written."""
        files = _data_files(self._outcome)
        for name, content in files.items():
            write(os.path.join(folder, name), content)
        return {"files": list(files)}

    def render_static(self) -> str:
        """HTML with the report inside, which exported notebooks keep.

        Returns
        -------
        str
            HTML.
        """
        return f'<iframe srcdoc="{html.escape(self.report())}" style="width:100%;height:40em;border:0"></iframe>'

    def _html(self) -> str:
        data = self._data
        said = f"t = {data['t_start']:g} … {data['t']:g}, {len(self)} rows, {data['steps']} steps of {data['method']}: {self.reason}"
        ends = zip(data["initial"], data["final"])
        state = [(notebook.code(one["name"]), one["value"], other["value"]) for one, other in ends]
        scales = self.scales
        drifts = [(name, value, scales.get(name)) for name, value in self.drift.items()]
        shown = notebook.paragraph(said) + notebook.table(["", "at the start", "at the end"], state)
        shown += notebook.unfolding("drift", notebook.table(["of", "largest change", "largest magnitude"], drifts))
        if data["events"]:
            met = [(own["event"], own["t"]) for own in data["events"]]
            shown += notebook.unfolding(f"{len(met)} events", notebook.table(["event", "t"], met))
        return shown + notebook.unfolding("verdicts", notebook.verdicts(self.verdicts)) + "".join(map(notebook.paragraph, self.notices))


def _unpickled(cls: Any, kept: dict[str, Any]) -> Any:
    made = cls.__new__(cls)
    made.__dict__.update(kept)
    return made


def _data_files(outcome: Outcome) -> dict[str, bytes]:
    files = {"trajectory.csv": outcome.csv().encode(), "trajectory.npz": bytes(outcome.npz())}
    events = outcome.events()
    if events is not None:
        files["events.csv"] = events.encode()
    return files


class Picture(Shown):
    """The drawing of a motion at a time; notebooks show it."""

    def __init__(
        self, outcome: Any, at: float | None, ghosts: int, size: tuple[int, int], again: tuple[Any, ...] | None = None
    ) -> None:
        self._outcome: Outcome = outcome
        self._asked = (at, ghosts, size)
        self._again = again

    def __reduce__(self) -> tuple[Any, ...]:
        return Picture, (remembered(self._outcome, self._again), *self._asked, self._again)

    def to_svg(self) -> str:
        """The picture as SVG.

        Returns
        -------
        str
            SVG.
        """
        return bytes(self._outcome.picture("svg", *self._asked)).decode()

    def to_png(self) -> bytes:
        """The picture as PNG.

        Returns
        -------
        bytes
            The content of a .png.
        """
        return bytes(self._outcome.picture("png", *self._asked))

    def to_dict(self) -> Json:
        """The description of the picture, equal to ``scene.json``.

        Returns
        -------
        dict
            Plain data.
        """
        return json.loads(self._outcome.scene())

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes .svg, .png, or .json with the description of the picture.

        Parameters
        ----------
        path : path
            The file to write.
        """
        contents: dict[str, Any] = {
            ".svg": lambda: self.to_svg().encode(),
            ".png": self.to_png,
            ".json": lambda: self._outcome.scene().encode(),
        }
        end = os.path.splitext(path)[1]
        if end not in contents:
            raise ValueError(f"{os.fspath(path)}: a picture is written as .svg or .png, its description as .json")
        write(path, contents[end]())

    def _repr_svg_(self) -> str:
        return self.to_svg()

    def _html(self) -> str:
        return self.to_svg()

    def __repr__(self) -> str:
        return "<picture of a motion>"


class Film(Shown):
    """The moving drawing of a motion, a GIF; notebooks show it.

    Attributes
    ----------
    content : bytes
        The content of the .gif.
    """

    def __init__(self, outcome: Outcome, seconds: float | None, size: tuple[int, int]) -> None:
        self.content: bytes = bytes(outcome.film(seconds, size))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes a .gif.

        Parameters
        ----------
        path : path
            The .gif to write.
        """
        if os.path.splitext(path)[1] != ".gif":
            raise ValueError(f"{os.fspath(path)}: a film is written as .gif")
        write(path, self.content)

    def _html(self) -> str:
        import base64

        return f'<img src="data:image/gif;base64,{base64.b64encode(self.content).decode()}">'

    def __repr__(self) -> str:
        return f"<film of {len(self.content)} bytes>"


class Study(Result):
    """Claims with their verdicts, and the motion. ``study["energy.integral"]`` is a verdict.

    Attributes
    ----------
    verdicts : list of Verdict
        All of them.
    trajectory : Trajectory or None
        The motion, where the model has the values for one.
    """

    def __init__(self, outcome: Any, text: str, again: tuple[Any, ...] | None = None) -> None:
        self._outcome: Outcome = outcome
        self._again = again
        super().__init__(json.loads(outcome.record([])), text)
        system = None if again is None else again[0]
        self.verdicts = [Verdict(own, system) for own in self._data["verdicts"]]
        self.trajectory = Trajectory(outcome, outcome.summary(), system, None, again) if outcome.has_motion else None

    def __reduce__(self) -> tuple[Any, ...]:
        return _unpickled, (Study, {**self.__dict__, "_outcome": remembered(self._outcome, self._again)})

    def __contains__(self, claim: object) -> bool:
        """Whether a claim of this id, or this verdict, is among them."""
        return any(claim in (own, own.claim) for own in self.verdicts)

    def __len__(self) -> int:
        return len(self.verdicts)

    def __getitem__(self, claim: str) -> Verdict:
        for own in self.verdicts:
            if own.claim == claim:
                return own
        near = difflib.get_close_matches(claim, [own.claim for own in self.verdicts])
        raise KeyError(f"`{claim}` was not decided{'; there is ' + ', '.join(near) if near else ''}")

    def __iter__(self) -> Iterator[Verdict]:
        return iter(self.verdicts)

    @property
    def ok(self) -> bool:
        """Whether everything is as the model expects, and the motion ended as it should: exit status 0 of the command."""
        return self._outcome.status == 0

    @property
    def notices(self) -> list[str]:
        """What a reader must know."""
        return [in_python(own) for own in self._outcome.notices]

    def summary(self) -> str:
        """The text that the command prints, with keywords in the place of options.

        Returns
        -------
        str
            The text.
        """
        return in_python(self._outcome.summary())

    def report(self) -> str:
        """The report, one HTML page.

        Returns
        -------
        str
            HTML that needs nothing else.
        """
        return self._outcome.page([])

    def save_report(self, path: str | os.PathLike[str]) -> None:
        """Writes the report.

        Parameters
        ----------
        path : path
            The .html to write.
        """
        write(path, self.report().encode())

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes what the command writes: the trajectory, ``report.html``, and ``study.json`` with checksums of the others.

        Parameters
        ----------
        folder : path
            A folder, which is made where there is none.
        """
        self._save(folder)

    def _save(self, folder: str | os.PathLike[str]) -> dict[str, Any]:
        """What the data say of what was written."""
        import hashlib

        files = _data_files(self._outcome) if self._outcome.has_motion else {}
        names = list(files)
        files["report.html"] = self._outcome.page(names).encode()
        record = json.loads(self._outcome.record(names))
        for name, content in files.items():
            write(os.path.join(folder, name), content)
            record["files"].append({"name": name, "sha256": hashlib.sha256(content).hexdigest()})
        text = json.dumps(record, indent=2, ensure_ascii=False) + "\n"
        write(os.path.join(folder, "study.json"), text.encode())
        return {key: record[key] for key in ("files", "trajectory") if key in record}

    def to_sympy(self) -> dict[str, list[Any]]:
        """The formulas of the evidence in SymPy by their claims, as :meth:`Verdict.to_sympy`.

        Returns
        -------
        dict from str to list of sympy.Expr or sympy.Eq
            Claims without formulas are left out.

        Examples
        --------
        >>> from chetaev import System
        >>> list(System.from_gallery("chaplygin-sleigh").study(claims="energy.integral").to_sympy())
        ['energy.integral']
        """
        return {own.claim: own.to_sympy() for own in self.verdicts if own.data.get("formulas")}

    def to_latex(self) -> str:
        """The claims with their verdicts and the formulas of the evidence in LaTeX; this needs SymPy.

        Returns
        -------
        str
            For displayed mathematics in a document with amsmath, a line for each claim.
        """
        return "\n\\\\\n".join(own.to_latex() for own in self.verdicts)

    def verify(self, *, budget: float = 120.0, independent: bool = False) -> Verification:
        """Decides the record again by other random choices, or has it examined by a program that shares nothing: :func:`chetaev.verify`.

        Parameters
        ----------
        budget : float
            Work allowed for each of the two replays, in seconds of a usual machine.
        independent : bool
            Lets the checker examine the record instead.

        Returns
        -------
        Verification
            What is said of each verdict.
        """
        from .claims import verify

        return verify(self, budget=budget, independent=independent)

    def render_static(self) -> str:
        """HTML with the report inside, which exported notebooks keep.

        Returns
        -------
        str
            HTML.
        """
        return f'<iframe srcdoc="{html.escape(self.report())}" style="width:100%;height:40em;border:0"></iframe>'

    def _html(self) -> str:
        return notebook.verdicts(self.verdicts) + "".join(notebook.paragraph(own) for own in self.notices)


class Explanation(Result):
    """What a claim or a formulation states, and how it is decided."""

    def _html(self) -> str:
        return written.catalogue(self._data) if isinstance(self._data, list) else written.explanation(str(self))


class Verification(Result):
    """What a replay says of each verdict of a record.

    Attributes
    ----------
    agrees : bool
        Whether nothing disagrees.
    """

    def __init__(self, data: Json, agrees: bool) -> None:
        # What the checker says of a claim, in its own words.
        keys = ("outcome", "verdict", "why") if data and "outcome" in data[0] else ("result", "recorded", "detail")
        width = max((len(own["claim"]) for own in data), default=0)
        lines = [f"{own[keys[0]]:<10} {own['claim']:<{width}} {own[keys[1]]:<14} {own[keys[2]]}" for own in data]
        super().__init__(data, "\n".join(lines))
        self.agrees = agrees
        self._keys = ("claim", *keys)

    def _html(self) -> str:
        return notebook.table(self._keys, [[own[key] for key in self._keys] for own in self._data])
