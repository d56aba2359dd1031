"""What notebooks show of results: tables, matrices, and evidence as sentences that unfold. No script, no style of the page."""

from __future__ import annotations

import html
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

#: Colours of verdicts, legible on light and dark pages.
COLOURS = {
    "proved": "#2e9e4f",
    "numerical": "#1f8fb3",
    "refuted": "#d0443c",
    "conditional": "#c08a12",
    "not-applicable": "#888888",
    "undecided": "#888888",
}
#: What stands in a row of the table already.
_SHOWN = {"claim", "subject", "verdict", "detail"}
_LEFT = "text-align:left;vertical-align:top"
_METHODS = {
    "exact": "in exact arithmetic",
    "structural": "from the structure of the equations",
    "modular": "by computing modulo random primes",
}


def plain(value: Any) -> str:
    """A number with six digits, a pair as a complex number, a text as it is; escaped."""
    if isinstance(value, bool) or value is None:
        return "" if value is None else "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, Sequence) and not isinstance(value, str):
        if len(value) == 2 and all(isinstance(own, float) for own in value):
            return html.escape(complex_number(value))
        return ", ".join(plain(own) for own in value)
    return html.escape(str(value))


def complex_number(pair: Sequence[float]) -> str:
    """A pair of real and imaginary part as a number."""
    real, imaginary = pair
    if imaginary == 0:
        return f"{real:.6g}"
    return f"{real:.6g} {'-' if imaginary < 0 else '+'} {abs(imaginary):.6g}i"


def table(head: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """A table; cells that are no texts of HTML already are written by :func:`plain`."""
    heads = "".join(f"<th style='{_LEFT}'>{html.escape(own)}</th>" for own in head)
    lines = ["".join(f"<td style='{_LEFT}'>{_cell(own)}</td>" for own in row) for row in rows]
    body = "".join(f"<tr>{own}</tr>" for own in lines)
    return f"<table>{f'<thead><tr>{heads}</tr></thead>' if heads else ''}<tbody>{body}</tbody></table>"


class Html(str):
    """A text of HTML."""


def _cell(value: Any) -> str:
    return str(value) if isinstance(value, Html) else plain(value)


def code(text: str) -> Html:
    """A formula in the notation of the model."""
    return Html(f"<code>{html.escape(text)}</code>")


def preformatted(text: str) -> str:
    """A text with its lines and spaces."""
    return f"<pre>{html.escape(text)}</pre>"


def paragraph(text: str) -> str:
    """A sentence."""
    return f"<p style='margin:0.3em 0'>{html.escape(text)}</p>" if text else ""


def heading(text: str) -> str:
    """A heading of a part."""
    return f"<h4>{html.escape(text)}</h4>"


def unfolding(summary: str, body: str) -> str:
    """What is shown when it is asked for."""
    return f"<details><summary>{html.escape(summary)}</summary>{body}</details>" if body else html.escape(summary)


def matrix(name: str, rows: Sequence[Sequence[str]]) -> str:
    """A matrix in brackets; nothing where it has no entries."""
    if not rows or not rows[0]:
        return ""
    lines = "".join(
        "<tr style='background:none'>" + "".join(f"<td style='text-align:center'><i>{html.escape(own)}</i></td>" for own in row) + "</tr>"
        for row in rows
    )
    bracket = "display:inline-table;vertical-align:middle;border-left:1px solid;border-right:1px solid;border-radius:0.5em"
    return f"<span style='margin-right:1.5em'><i>{html.escape(name)}</i> = <table style='{bracket}'>{lines}</table></span>"


def evidence(verdict: Mapping[str, Any]) -> str:
    """What a record says of a verdict, in sentences; nothing is left out."""
    left = {key: own for key, own in verdict.items() if key not in _SHOWN and own not in (None, [], "", {})}
    found = []
    method, where = left.pop("method", None), left.pop("on", None)
    if method is not None:
        found.append(f"Decided {_METHODS.get(method, f'by the method “{method}”')}{f', {where}' if where else ''}.")
    elif where is not None:
        found.append(f"Decided {where}.")
    samples, seed = left.pop("samples", None), left.pop("seed", None)
    if samples is not None:
        drawn = f", drawn with the seed {seed}" if seed is not None else ""
        found.append(f"{'One sample was' if samples == 1 else f'{samples} samples were'} looked at{drawn}.")
    elif seed is not None:
        found.append(f"What was drawn at random follows from the seed {seed}.")
    for key, words in (("error_bound", "The probability of an error is at most {}."), ("residual", "The largest residual is {}.")):
        value = left.pop(key, None)
        if value is not None:
            found.append(words.format(f"{value:.3g}" if isinstance(value, float) else value))
    condition = left.pop("condition", None)
    if condition is not None:
        failed = verdict.get("verdict") == "not-applicable"
        found.append(f"{'What it needs does not hold' if failed else 'The condition is'}: {condition}.")
    counter = left.pop("counterexample", None)
    if counter is not None:
        found.append(f"Counterexample: {counterexample(counter)}.")
    expected = left.pop("expected", None)
    if expected is not None:
        found.append(f"The model expects: {plain(expected) if not isinstance(expected, str) else expected}.")
    seconds, formulas = left.pop("seconds", None), left.pop("formulas", None)
    if seconds is not None:
        found.append(f"It took {seconds:.2g} s.")
    body = "".join(paragraph(own) for own in found)
    if formulas:
        body += paragraph("Formulas:") + "<ul>" + "".join(f"<li>{code(str(own))}</li>" for own in formulas) + "</ul>"
    return body + "".join(paragraph(f"{key.replace('_', ' ').capitalize()}: {sentence(own)}.") for key, own in left.items())


def counterexample(found: Mapping[str, Any]) -> str:
    """The point, and what does not vanish there."""
    at = [f"{own['name']} = {own['exact'] if own.get('exact') is not None else _between(own.get('enclosure'))}" for own in found.get("point", [])]
    said = f"at {', '.join(at)}: " if at else ""
    return f"{said}{found.get('quantity', 'the residual')} lies {_between(found.get('residual'))}"


def _between(ends: Any) -> str:
    if not ends:
        return "anywhere"
    return f"between {ends[0]} and {ends[-1]}" if len(ends) > 1 else f"at {ends[0]}"


def sentence(value: Any) -> str:
    """Data of any kind as words."""
    if isinstance(value, Mapping):
        return "; ".join(f"{str(key).replace('_', ' ')} {sentence(own)}" for key, own in value.items() if own not in (None, [], ""))
    if isinstance(value, Sequence) and not isinstance(value, str):
        return ", ".join(sentence(own) for own in value)
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def verdicts(all_of_them: Iterable[Any]) -> str:
    """A table of verdicts, the evidence of each behind what it says."""
    rows = [
        (
            code(own.claim),
            Html(f"<b style='color:{COLOURS.get(own.verdict, '#888888')}'>{html.escape(own.verdict)}</b>"),
            Html(unfolding(own.detail, evidence(own.data))),
        )
        for own in all_of_them
    ]
    return table(["claim", "verdict", "what was found"], rows) if rows else ""


def columns(named: Mapping[str, Any], ends: int = 4) -> str:
    """Arrays of one length as a table of the first and the last rows."""
    names = list(named)
    count = len(next(iter(named.values()), []))
    whole = list(range(count))
    kept: list[int | None] = [*whole] if count <= 2 * ends + 1 else [*whole[:ends], None, *whole[-ends:]]
    rows = [["…"] * len(names) if row is None else [float(named[name][row]) for name in names] for row in kept]
    return table(names, rows)


def picture(svg: str | None) -> str:
    """A picture with the width of the page at most."""
    return f"<div style='max-width:60em'>{svg}</div>" if svg else ""
