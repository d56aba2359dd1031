"""Functionals side by side (theory 4 §§1-3): `functional.duality`, `functional.descent`, `functional.degeneration`, `functional.legendre`.

Two functionals are read on the same jets; what the densities differ by must vanish at random points of the equations that the verdict names.
"""
import re

from expressions import ZERO, NotCheckable, add, mul, num, sub, sym, total
from functionals import Functional, rules_of
from index_notation import slots

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


def duality(cx, verdict):
    f, own = cx.functional, cx.data["duality"]
    other = cx.other(own["with"])
    if "flux" not in own:
        whole = add(f.density, other.density)
        es = [total(f.scope.totals(f.scope.partial(whole, j), j[1]) if len(j[1]) % 2 == 0 else
                    sub(ZERO, f.scope.totals(f.scope.partial(whole, j), j[1])) for j in f.jets_of(whole) if j[0] == c)
              for c in {j[0] for j in f.jets_of(whole)}]
        return ("confirmed" if cx.vanish(f, es) else "rejected"), WHY
    tree = f.scope.tree(own["flux"])
    flux = [f.scope.components(tree)[(i,)] for i in range(f.d)]
    inside = sub(add(f.density, other.density), total(f.scope.total(w, i) for i, w in enumerate(flux)))
    pairs = [(None, inside)]
    for name, piece in f.pieces.items():
        through = piece.put(total(mul(f.scope.tensors["n"][(i,)], w) for i, w in enumerate(flux)))
        pairs.append((name, total([through, piece.density, other.pieces[name].density])))
    return agree(cx, f, pairs, verdict)


def descent(cx, verdict):
    above = cx.other(cx.data["descent"]["from"])
    f = cx.functional
    pairs = [(None, sub(above.density, f.density))]
    pairs += [(name, sub(piece.density, f.pieces[name].density)) for name, piece in above.pieces.items() if name in f.pieces]
    if set(re.findall(r"\(([^)]*)\)", verdict["detail"].split(" on ")[0])) - set(above.equations):
        return "rejected", "the verdict imposes what is not stated above"
    above.scope.jets |= f.scope.jets
    rules = rules_of(f, [e for e in f.imposed if e.on is None])
    return agree(cx, above, pairs, verdict, cx.data["descent"].get("imposing", []), rules)


def degeneration(cx, verdict):
    own = cx.data["degenerations"][verdict["subject"]]
    other = cx.other(own["becomes"])
    parameters = {name: other.scope.tensors[name] for name in other.data.get("parameters", {})}
    f = Functional(cx.data, own["at"], parameters)
    pairs = [(None, sub(f.density, other.density))]
    pairs += [(name, sub(piece.density, other.pieces[name].density)) for name, piece in f.pieces.items() if name in other.pieces]
    return agree(cx, other, pairs, verdict)


def legendre(cx, verdict):
    """A + B = A' X and B'(A'(X)) = X with both formulas, at X in the range of one of the gradients."""
    f, name = cx.functional, verdict["subject"]
    functions = {n: {k: v for k, v in own.items() if k != "conjugate"} for n, own in f.scope.functions.items()}
    other = f.scope.functions[name]["conjugate"]
    if "value" not in functions[name] or "value" not in functions[other]:
        return "rejected", "a function without a formula"
    f.scope.functions, before = functions, f.scope.functions
    try:
        times = [m for _, m in slots(functions[name]["of"], f.d)]
        at = tuple(sym(f"argument {k}", 0) for k in range(len(times)))
        slope = lambda g, x: tuple(f.scope.function(g, x, (k,)) for k in range(len(times)))
        for x in (at, slope(name, at)):
            image = slope(other, x)
            whole = [f.scope.function(other, x), f.scope.function(name, image), *(mul(num(-m), mul(a, b)) for m, a, b in zip(times, x, image))]
            if cx.vanish(f, [total(whole), *(sub(a, b) for a, b in zip(slope(name, image), x))]):
                return "confirmed", "both formulas, at random arguments modulo primes"
    finally:
        f.scope.functions = before
    if any(w in str(functions) for w in ("exp", "cosh", "sinh", "log", "sin", "cos")):
        raise NotCheckable("exponentials and logarithms that may depend on each other")
    return "rejected", "the formulas are not conjugate"


CLAIMS = {"functional.duality": duality, "functional.descent": descent, "functional.degeneration": degeneration, "functional.legendre": legendre}
