"""What notebooks show of texts that the library has written: problems of a model, counts, comparisons, derivations step by step, explanations."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import groupby
from typing import Any

from .notebook import COLOURS, Html, code, heading, paragraph, plain, table, unfolding

_SEVERITIES = {"error": COLOURS["refuted"], "warning": COLOURS["conditional"]}
_COUNT = re.compile(r"(\S+): (\d+) operations: (.*)")
_STEP = re.compile(r"\d+\. ")
#: A name, with primes where it is a rate, and what it equals.
_FORMULA = re.compile(r"[^\W\d]\w*'* = ")


def _coloured(word: str, colour: str) -> Html:
    return Html(f"<b style='color:{colour}'>{word}</b>")


def problems(diagnostics: Iterable[Mapping[str, Any]], underlined: str) -> str:
    """A table of what is wrong, each at its place; the underlined text unfolds."""
    rows = []
    for own in diagnostics:
        at = own.get("at") or {}
        where = f"{at['file']}:{at['line']}:{at['column']}" if at else ""
        hints = "".join(paragraph(hint) for hint in own.get("hints", []))
        said = own["message"] if not own.get("label") else f"{own['message']}: {own['label']}"
        severity = own["severity"]
        rows.append((_coloured(severity, _SEVERITIES.get(severity, "#888888")), code(where), Html(paragraph(said) + hints)))
    if not rows:
        return paragraph("There are no errors.")
    return table(["", "where", "what it is"], rows) + unfolding("at its place", underlined)


def counts(text: str) -> str:
    """A table of operations by form; forms that do not apply say why below."""
    rows, others, heads = [], [], [""]
    for line in text.splitlines():
        found = _COUNT.fullmatch(line)
        if found is None:
            others.append(paragraph(line))
            continue
        parts = [own.split(" ", 1) for own in found[3].split(", ")]
        rows.append((code(found[1]), int(found[2]), *(int(number) for number, _ in parts)))
        heads = [kind for _, kind in parts]
    return (table(["form", "operations", *heads], rows) if rows else "") + "".join(others)


def _formulas(lines: Iterable[str]) -> str:
    return "".join(f"<div style='margin-left:1.5em'>{code(line.strip())}</div>" for line in lines)


def comparison(text: str) -> str:
    """The two forms, the differences as formulas, the verdict in its colour; long definitions unfold."""
    title, *lines = text.splitlines()
    found = heading(title)
    for kind, group in groupby(lines, _part):
        own = [line for line in group if line.strip()]
        if kind == "definitions":
            found += unfolding("where", _formulas(line for line in own if line != "where"))
        elif kind == "formulas":
            found += _formulas(own)
        else:
            found += "".join(_sentence(line) for line in own)
    return found


def differences(text: str) -> dict[str, dict[str, str]]:
    """The formulas of a comparison by what is compared and by whose they are, each with the definitions below ``where``."""
    found: dict[str, dict[str, str]] = {}
    for title, lines in _blocks(text):
        named = [line.partition(" = ") for line in lines if _FORMULA.match(line)]
        below = [line for line in lines if _part(line) == "definitions"]
        end = "".join(f"\n{line}" for line in below)
        if named:
            found[title] = {name: right + end for name, _, right in named}
    return found


def _blocks(text: str) -> Iterator[tuple[str, list[str]]]:
    """What stands below each line with a colon at its end, up to the first sentence."""
    title, is_open = "", False
    lines: list[str] = []
    for line in text.splitlines():
        if line.endswith(":") and not _FORMULA.match(line) and not line.startswith("  "):
            title, lines, is_open = line[:-1], [], True
        elif is_open and (_FORMULA.match(line) or _part(line) == "definitions"):
            lines.append(line)
        elif is_open:
            yield title, lines
            is_open = False
    if is_open:
        yield title, lines


def _part(line: str) -> str:
    if line == "where" or line.startswith("  "):
        return "definitions"
    return "formulas" if _FORMULA.match(line) else "sentences"


def _sentence(line: str) -> str:
    word = re.match(r"[a-z-]+", line)
    if word is None or word[0] not in COLOURS:
        return paragraph(line)
    rest = line[word.end() :].lstrip(": ")
    return f"<p style='margin:0.3em 0'>{_coloured(word[0], COLOURS[word[0]])} {plain(rest)}</p>"


def steps(text: str) -> str:
    """Headings, the rule of each step, its formulas, and why it holds."""
    found = ""
    for line in text.splitlines():
        if line.startswith("     "):
            found += _formulas([line])
        elif line.startswith("   ["):
            found += paragraph(line.strip(" []"))
        elif _STEP.match(line) or line.endswith(", step by step"):
            found += heading(line)
        else:
            found += paragraph(line.strip())
    return found


def explanation(text: str) -> str:
    """The id, the title, and paragraphs."""
    name, title, *lines = [own for own in text.splitlines() if own.strip()]
    joined: list[str] = []
    after_break = {line for before, line in zip(text.splitlines(), text.splitlines()[1:]) if not before.strip()}
    for line in lines:
        is_new = not joined or line in after_break or re.match(r"[A-Z]\w+: ", line) is not None
        if is_new or joined[-1] == "" or _is_title(joined[-1]):
            joined.append(line)
        else:
            joined[-1] += f" {line}"
    return f"<p>{code(name)}</p>{heading(title)}" + "".join(paragraph(own) for own in joined)


def _is_title(line: str) -> bool:
    """A short line without a stop at its end."""
    return len(line) < 60 and not line.endswith((".", ",", ":"))


def catalogue(claims: Sequence[Mapping[str, Any]]) -> str:
    """All claims by their groups, what each states behind its title."""
    found = ""
    for group, own in groupby(claims, lambda claim: str(claim["group"])):
        rows = [(code(claim["id"]), Html(unfolding(claim["title"], paragraph(claim["explanation"])))) for claim in own]
        found += unfolding(f"{group}: {len(rows)}", table(["claim", "what it states"], rows))
    return found
