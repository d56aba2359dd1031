"""Functionals side by side (theory 4 §§1-3): two are read on the same jets, and what their densities differ by must vanish at random points
of the equations that the verdict names.
"""
import re

from rules import rules_of

WHY = "the densities put in, at random points modulo primes"


def named(text, place):
    """The labels that a verdict names for a place: `in the interior modulo (3) and (4)`."""
    found = re.search(re.escape(place) + r" modulo ((?:\([^)]*\)(?:, | and )?)+)", text)
    return re.findall(r"\(([^)]*)\)", found[1]) if found else []


def agree(cx, f, pairs, verdict, own=(), known=()):
    """Whether expressions, each for the interior or a piece, vanish modulo what the verdict names and what is imposed."""
    for name, e in pairs:
        place = "in the interior" if name is None else f"on {name}"
        labels = [*named(verdict["detail"], place), *own]
        piece = f.pieces.get(name)
        if any(l not in f.equations for l in labels):
            return "rejected", f"the verdict names equations that are not stated: {labels}"
        stated = [f.equations[l] for l in dict.fromkeys(labels)]
        rules = rules_of(f, [q for q in stated if q.on is None])
        here = rules_of(f, [q for q in stated if q.on == name], piece) if piece else []
        if not cx.vanish(f, [e], here + rules + list(known), piece.place() if piece else None):
            return "rejected", f"{WHY}: {place} they differ"
    return "confirmed", WHY
