"""A functional of fields over space: what it is stationary for, and whether this is what it is said to be."""

from __future__ import annotations

import html
import json
import os
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from . import chetaev_native as native
from . import formulas, notebook
from .asked import words
from .claims import explain, verify
from .errors import ModelWarning
from .keywords import in_python
from .results import Check, Explanation, Json, Result, Shown, Typeset, Verdict, Verification, part_of, write
from .system import Value, _pairs, _Progress, of_gallery, readable
from .texts import shown


class FieldEquation(Typeset):
    """The coefficient of one variation, which vanishes.

    Attributes
    ----------
    of : str
        The variation: ``δu_k``.
    text : str
        The equation in the notation of the model.
    latex : str
        The same in LaTeX.
    """

    def __init__(self, data: Mapping[str, Any]) -> None:
        super().__init__(dict(data), f"{data['of']}: {data['equation']}", data["latex"])
        self.of: str = data["of"]
        self.text: str = data["equation"]

    def _html(self) -> str:
        return f"<p>{html.escape(self.of)}: {html.escape(self._latex() or '')}</p>"


class FieldEquations(Result):
    """The equations of the interior, or the conditions on a piece of the boundary.

    Attributes
    ----------
    title : str
        ``Euler equations``, or ``conditions on S_u``.
    indexed : list of FieldEquation
        In index notation; empty where no index occurs.
    components : list of FieldEquation
        In components.
    """

    def __init__(self, data: Mapping[str, Any], derivation: FieldDerivation | None = None) -> None:
        self.title: str = data["title"]
        self.indexed = [FieldEquation(own) for own in data["indexed"]]
        self.components = [FieldEquation(own) for own in data["components"]]
        self._derivation = derivation
        super().__init__(dict(data), "\n".join([self.title, *(f"  {own}" for own in self.equations)]))

    @property
    def equations(self) -> list[FieldEquation]:
        """In index notation where there is one, else in components."""
        return self.indexed or self.components

    def to_latex(self) -> str:
        """The equations in an ``aligned`` environment.

        Returns
        -------
        str
            A text for a document with amsmath.
        """
        return formulas.aligned(own.latex.replace(" = ", " &= ", 1) for own in self.equations)

    def to_sympy(self) -> list[Any]:
        """The equations in SymPy, in components, as :meth:`FieldDerivation.to_sympy` has them.

        Returns
        -------
        list of sympy expressions
            What vanishes.
        """
        if self._derivation is None:
            raise ValueError("only the parts of a derivation are written in SymPy")
        return self._derivation.to_sympy()[self.title]

    def _latex(self) -> str | None:
        return f"$${self.to_latex()}$$" if self.equations else None

    def _html(self) -> str:
        shown = "".join(own._html() for own in self.equations)
        return f"<h4>{html.escape(self.title[:1].upper() + self.title[1:])}</h4>\n{shown or '<p>nothing is free</p>'}"


class FieldDerivation(Result, Sequence[FieldEquations]):
    """Euler equations, and the natural conditions on each piece of the boundary.

    Attributes
    ----------
    parts : list of FieldEquations
        The Euler equations, then the conditions, piece by piece.
    """

    def __init__(self, functional: Functional, data: Json, text: str) -> None:
        super().__init__(data, text)
        self._functional = functional
        self.parts = [FieldEquations(own, self) for own in data["parts"]]

    def __len__(self) -> int:
        return len(self.parts)

    def __getitem__(self, which: Any) -> Any:
        """By number, or by the title."""
        return part_of(self.parts, which, lambda own: own.title)

    @property
    def euler(self) -> FieldEquations:
        """The Euler equations."""
        return self.parts[0]

    def to(self, notation: str) -> str:
        """The text of ``chetaev derive --as notation``: text, latex, mathml, sympy or json.

        Parameters
        ----------
        notation : str
            ``text``, ``latex``, ``mathml``, ``sympy`` or ``json``.

        Returns
        -------
        str
            The text.
        """
        return self._functional._native.derive(notation)

    def to_latex(self) -> str:
        """A whole document.

        Returns
        -------
        str
            A text for a document with amsmath.
        """
        return self.to("latex")

    def to_sympy(self) -> dict[str, list[Any]]:
        """SymPy equations by the title of their part, exact. Derivatives are symbols of their own: ``u_1,12``.

        Returns
        -------
        dict from str to list of sympy expressions
            What vanishes, by headings.
        """
        space: dict[str, Any] = {}
        exec(compile(self.to("sympy"), "<chetaev>", "exec"), space)
        return {
            own.title: [equation for group in space[f"part_{number}"].values() for equation in group]
            for number, own in enumerate(self.parts, 1)
        }

    def _latex(self) -> str | None:
        rows = [own.latex.replace(" = ", " &= ", 1) for part in self.parts for own in part.equations]
        return f"$${formulas.aligned(rows)}$$" if rows else None

    def _html(self) -> str:
        return "\n".join(part._html() for part in self.parts)


class FunctionalStudy(Result):
    """Claims about a functional with their verdicts.

    Attributes
    ----------
    verdicts : list of Verdict
        All of them; ``study["functional.euler#plate"]`` is one.
    ok : bool
        Whether everything is as the model expects: exit status 0 of the command.
    """

    def __init__(self, functional: Functional, record: str, summary: str, page: str, is_as_expected: bool) -> None:
        super().__init__(json.loads(record), summary)
        self._functional = functional
        self._page = page
        self.ok = is_as_expected
        self.verdicts = [Verdict(own) for own in self._data["verdicts"]]

    def __getitem__(self, claim: str) -> Verdict:
        for own in self.verdicts:
            if own.claim == claim:
                return own
        raise KeyError(f"`{claim}` was not decided")

    def __iter__(self) -> Iterator[Verdict]:
        return iter(self.verdicts)

    @property
    def notices(self) -> list[str]:
        """What a reader must know."""
        return [in_python(own) for own in self._data["notices"]]

    def summary(self) -> str:
        """The text that the command prints, with keywords in the place of options.

        Returns
        -------
        str
            The text.
        """
        return self._text

    def to_latex(self) -> str:
        """The Euler equations and natural conditions in LaTeX, as :meth:`FieldDerivation.to_latex` has them.

        Returns
        -------
        str
            A text for a document with amsmath.
        """
        return self._functional.derive().to_latex()

    def to_sympy(self) -> dict[str, list[Any]]:
        """The Euler equations and natural conditions in SymPy, as :meth:`FieldDerivation.to_sympy` has them.

        Returns
        -------
        dict from str to list of sympy expressions
            What vanishes, by headings.
        """
        return self._functional.derive().to_sympy()

    def report(self) -> str:
        """The report, one HTML page.

        Returns
        -------
        str
            HTML that needs nothing else.
        """
        return self._page

    def save_report(self, path: str | os.PathLike[str]) -> None:
        """Writes the report.

        Parameters
        ----------
        path : path
            The .html to write.
        """
        write(path, self._page.encode())

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes what the command writes: ``report.html``, and ``study.json`` with its checksum.

        Parameters
        ----------
        folder : path
            A folder, which is made where there is none.
        """
        self._save(folder)

    def _save(self, folder: str | os.PathLike[str]) -> list[Any]:
        """The names and checksums of what was written."""
        import hashlib

        page = self._page.encode()
        write(os.path.join(folder, "report.html"), page)
        files = [{"name": "report.html", "sha256": hashlib.sha256(page).hexdigest()}]
        text = json.dumps(self._data | {"files": files}, indent=2, ensure_ascii=False) + "\n"
        write(os.path.join(folder, "study.json"), text.encode())
        return list(files)

    def verify(self) -> Verification:
        """Decides the record again from the texts in it.

        Returns
        -------
        Verification
            What is said of each verdict.
        """
        return verify(self)

    def render_static(self) -> str:
        """HTML with the report inside, which exported notebooks keep.

        Returns
        -------
        str
            HTML.
        """
        return f'<iframe srcdoc="{html.escape(self.report())}" style="width:100%;height:40em;border:0"></iframe>'

    def _html(self) -> str:
        return notebook.verdicts(self.verdicts) + "".join(map(notebook.paragraph, self.notices))


class Functional(Shown):
    """A functional of fields over space.

    It is made by :meth:`from_file`, :meth:`from_text` or :meth:`from_gallery`.

    Examples
    --------
    >>> plate = Functional.from_gallery("fields/plate")
    >>> plate.derive().euler
    Euler equations
      δw: D (w,xxxx + 2 w,xxyy + w,yyyy) - q = 0
    >>> plate.study()["functional.euler#plate"].verdict
    'proved'
    """

    _native: native.Functional

    def __init__(self) -> None:
        raise TypeError("a functional is read by from_file, from_text or from_gallery")

    @classmethod
    def _of(cls, functional: native.Functional) -> Functional:
        own = cls.__new__(cls)
        own._native = functional
        said = in_python(functional.warnings())
        if said:
            warnings.warn(said, ModelWarning, stacklevel=3)
        return own

    @classmethod
    def from_file(cls, path: str | os.PathLike[str], *, set: Mapping[str, Value] | None = None) -> Functional:
        """Reads a model file with ``kind = "functional"``.

        Parameters
        ----------
        path : path
            The file.
        set : mapping, optional
            Other values of sizes and parameters, exactly, as ``--set``: ``{"d": 3}``.

        Returns
        -------
        Functional

        Raises
        ------
        ModelError
            With everything that is wrong, each at its place.
        OSError
            Where the file cannot be read, as :class:`FileNotFoundError`.
        """
        readable(path)
        return cls._of(native.Functional.from_file(os.fspath(path), _pairs(set)))

    @classmethod
    def from_text(
        cls, text: str, *, path: str | os.PathLike[str] | None = None, set: Mapping[str, Value] | None = None
    ) -> Functional:
        """Reads a functional from its text; what it includes is looked for beside ``path``.

        Parameters
        ----------
        text : str
            The text of a model file.
        path : path, optional
            Where the text is thought to stand.
        set : mapping, optional
            Other values of sizes and parameters.

        Returns
        -------
        Functional
        """
        place = None if path is None else os.fspath(path)
        return cls._of(native.Functional.from_text(text, place, _pairs(set)))

    @classmethod
    def from_gallery(cls, name: str, *, set: Mapping[str, Value] | None = None) -> Functional:
        """A functional that comes with Chetaev; ``chetaev.gallery.list()`` names them.

        Parameters
        ----------
        name : str
            ``elasticity/p4p``, ``fields/plate``, …
        set : mapping, optional
            Other values of sizes and parameters.

        Returns
        -------
        Functional
        """
        return cls._of(native.Functional.from_texts(*of_gallery(name), _pairs(set)))

    def with_values(self, /, **values: Value) -> Functional:
        """The same functional with other values of sizes and parameters.

        Parameters
        ----------
        **values : number, text, fraction or SymPy expression
            By the names of sizes and parameters.

        Returns
        -------
        Functional
        """
        path, text, includes, overrides = self._native.texts()
        kept = [own for own in overrides if own[0] not in values]
        return self._of(native.Functional.from_texts(path, text, includes, kept + _pairs(values)))

    def __reduce__(self) -> tuple[Any, ...]:
        return _again, self._native.texts()

    @property
    def name(self) -> str:
        """Its name."""
        return self._native.name

    @property
    def level(self) -> str | None:
        """Its level in a hierarchy of functionals, as the file states it."""
        return self._native.level

    @property
    def dimensions(self) -> int:
        """The number of dimensions of space."""
        return self._native.dimensions

    @property
    def fields(self) -> dict[str, str]:
        """Names of the fields that are varied with their kinds: ``scalar``, ``vector``, ``symmetric``, ``matrix``."""
        return {name: kind for name, kind, _, _ in self._native.fields}

    @property
    def parameters(self) -> dict[str, str | None]:
        """Names of the parameters with their exact values; ``None`` where one has no value."""
        return dict(self._native.parameters)

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
        fields = ", ".join(f"{name} ({kind})" for name, kind in self.fields.items())
        return f"<Functional {self.name}: {fields}; {self.dimensions} dimension{'s' if self.dimensions > 1 else ''}>"

    def _html(self) -> str:
        return notebook.unfolding(repr(self)[12:-1], notebook.preformatted(shown(self._native)))

    def check(self) -> Check:
        """Everything wrong or doubtful in the file.

        Returns
        -------
        Check
            Its ``diagnostics``, and whether there is no error.
        """
        text, data, has_errors = self._native.check()
        return Check(json.loads(data), text, has_errors)

    def derive(self) -> FieldDerivation:
        """Derives the Euler equations and the natural conditions on each piece of the boundary.

        Returns
        -------
        FieldDerivation
            Equations by where they hold.

        Raises
        ------
        NotDerivedError
            Where the densities have derivatives of an order for which no conditions on the boundary are derived.
        """
        return FieldDerivation(self, json.loads(self._native.derive("json")), self._native.derive("text"))

    def study(
        self,
        *,
        claims: str | Iterable[str] | None = None,
        out: str | os.PathLike[str] | None = None,
        progress: bool = False,
    ) -> FunctionalStudy:
        """Decides every claim.

        Parameters
        ----------
        claims : str or list of str, optional
            Claim ids, such as ``functional.euler``; all when left out.
        out : path, optional
            Folder to write the report and the record into.
        progress : bool
            Whether a progress bar is shown.

        Returns
        -------
        FunctionalStudy
            Verdicts on the claims.
        """
        named = words("claims", claims) or ""
        with _Progress(progress) as tell:
            found = FunctionalStudy(self, *self._native.study(named, tell))
        if out is not None:
            found._data["files"] = found._save(out)
            found._folder = os.path.abspath(out)
        return found

    def explain(self, claim: str = "functional.euler") -> Explanation:
        """What a claim states and how it is decided: :func:`chetaev.explain`.

        Parameters
        ----------
        claim : str
            The id of a claim.

        Returns
        -------
        Explanation
        """
        return explain(claim)


def _again(path: str, text: str, includes: Any, overrides: Any) -> Functional:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", ModelWarning)
        return Functional._of(native.Functional.from_texts(path, text, includes, overrides))
