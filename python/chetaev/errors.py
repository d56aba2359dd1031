"""Exceptions and warnings."""

from __future__ import annotations

import json
from typing import Any

from .keywords import in_python, of_data


class ChetaevError(Exception):
    """Anything that Chetaev refuses.

    Attributes
    ----------
    rendered : str
        What it prints.
    diagnostics : list of dict
        Problems of a model, as ``chetaev check --json`` writes them, with keywords in the place of options; empty where it is none of a model.
    """

    def __init__(self, rendered: str, data: str = "[]") -> None:
        super().__init__(rendered, data)
        self.rendered = in_python(rendered.rstrip())
        self.diagnostics: list[dict[str, Any]] = of_data(json.loads(data))

    def __str__(self) -> str:
        return self.rendered


class ModelError(ChetaevError, ValueError):
    """A model is wrong. It prints every problem with its line, the text underlined, and advice.

    Attributes
    ----------
    diagnostics : list of dict
        All problems, as ``chetaev check --json`` writes them, with keywords in the place of options.
    file, line, column, text, hint
        Of the first error: name of the file, line and column from 1, the offending text, and the first advice; ``None`` where there is none.
    """

    @property
    def _first(self) -> dict[str, Any]:
        errors = [own for own in self.diagnostics if own["severity"] == "error"]
        return (errors or self.diagnostics or [{}])[0]

    def _at(self, what: str) -> Any:
        return self._first.get("at", {}).get(what)

    @property
    def file(self) -> str | None:
        """Name of the file."""
        found: str | None = self._at("file")
        return found

    @property
    def line(self) -> int | None:
        """Line, from 1."""
        found: int | None = self._at("line")
        return found

    @property
    def column(self) -> int | None:
        """Column, from 1."""
        found: int | None = self._at("column")
        return found

    @property
    def text(self) -> str | None:
        """The offending text."""
        found: str | None = self._at("text")
        return found

    @property
    def hint(self) -> str | None:
        """The first advice."""
        hints = self._first.get("hints")
        return str(hints[0]) if hints else None


class OptionError(ChetaevError, ValueError):
    """The value of a keyword is wrong."""


class NotDerivedError(ChetaevError, ValueError):
    """A formulation does not apply to the system; the message says which requirement fails, with its evidence."""


class ModelWarning(UserWarning):
    """Something in a model is doubtful."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C ended a computation.

    Attributes
    ----------
    result : Trajectory, Study or Sweep
        What there was.
    """

    def __init__(self, result: Any) -> None:
        super().__init__("interrupted; what was computed is in the attribute `result` of this exception")
        self.result = result
