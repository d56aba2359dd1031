"""`functional.noether`: currents of translations, rotations and scalings (E. Noether 1918; J, L and M of elasticity).

A symmetry moves the place by xi and the fields by eta; with Q = eta - xi_k u,k the density changes by S = sum dL/du_J D_J Q + D_i(L xi_i),
data staying functions of the place. The current printed has D_i C_i + sum E Q = S identically, and S vanishes where E = 0, or does not.
"""
import re
from fractions import Fraction
from types import SimpleNamespace

from expressions import ZERO, NotCheckable, add, mul, neg, num, says, sub, sym, total
from index_notation import slots
from rules import rules_of


def generator(f, subject, detail):
    """xi for each variable and eta for each component."""
    scope, names = f.scope, f.scope.coordinates
    at = lambda i: sym(names[i], "x")
    kind, _, rest = subject.partition("-")
    if kind == "translation" and rest in names:
        return [num(int(x == rest)) for x in names], {}
    if kind == "rotation":
        a, b = next((a, b) for a in range(f.d) for b in range(f.d) if f"{names[a]}-{names[b]}" == rest)
        return [neg(at(b)) if i == a else at(a) if i == b else ZERO for i in range(len(names))], turned(f, a, b)
    if subject != "scaling":
        raise NotCheckable("a symmetry of another kind")
    powers = dict(re.findall(r"(\w+) with the exponent (-?\d+(?:/\d+)?)", detail))
    fields = [name for name, on in f.on.items() if on is None]
    if set(powers) != set(fields):
        raise NotCheckable("the exponents of a scaling are not told")
    eta = {c: mul(num(Fraction(powers[name])), sym(c, ())) for name in fields for c, _ in scope.fields[name]}
    return [at(i) for i in range(len(names))], eta


def turned(f, a, b):
    """What a rotation of a towards b does to vectors and tensors: each index in turn."""
    eta, other = {}, {a: (b, -1), b: (a, 1)}
    for name in (name for name, on in f.on.items() if on is None):
        for (c, _), (place, _) in zip(f.scope.fields[name], slots(f.data["fields"][name]["kind"], f.d)):
            moves = ((k, *other[i]) for k, i in enumerate(place) if i in other)
            eta[c] = total(mul(num(s), f.scope.tensors[name][(*place[:k], j, *place[k + 1:])]) for k, j, s in moves)
    return eta


def currents(f, xi, q):
    """C_i = L xi_i + the flux of the first variation along Q."""
    out = [mul(f.density, x) for x in xi]
    for i, own in enumerate(f.flux(f.density)):
        out[i] = add(out[i], total(mul(e, f.scope.totals(q[c], by)) for (c, by), e in own.items()))
    return out


@says("refuted")
def noether(cx, verdict):
    f, scope, axes = cx.functional, cx.functional.scope, range(len(cx.functional.scope.coordinates))
    xi, eta = generator(f, verdict["subject"], verdict["detail"] + " " + (verdict.get("condition") or ""))
    q = {c: sub(eta.get(c, ZERO), total(mul(x, sym(c, (i,))) for i, x in enumerate(xi))) for c in f.varied}
    moved = [mul(scope.partial(f.density, j), scope.totals(q[j[0]], j[1])) for j in f.jets_of(f.density, set(f.varied))]
    defect = total([*moved, *(scope.total(mul(f.density, x), i) for i, x in enumerate(xi))])
    euler = f.euler(f.density)
    work = total(mul(mul(num(f.times[c]), e), q[c]) for c, e in euler.items())
    shown, own = {}, currents(f, xi, q)
    for text in verdict["formulas"]:
        caption, _, right = text.partition(": ")
        try:
            if caption.startswith("the current along "):
                shown[scope.coordinates.index(caption.split()[-1])] = scope.scalar(right)
            elif right and not cx.vanish(f, [sub(scope.scalar(right.split("solutions: ")[-1]), defect)]):
                return "rejected", "the defect printed is another"
        except NotCheckable:
            continue  # An argument of a function may have a name that is made for reading only.
    fits = lambda rest: cx.vanish(f, [total([*(scope.total(shown.get(i, rest[i]), i) for i in axes), work, neg(defect)])])
    if not fits(own) and not (len(shown) < len(axes) and fits([ZERO] * len(axes))):
        return "rejected", "the divergence of the current is not that of this symmetry"
    return on_solutions(cx, f, verdict, defect)


def on_solutions(cx, f, verdict, defect):
    is_kept = cx.vanish(f, [defect])
    if not is_kept:
        density, held = f.lagrangian()
        stated = [SimpleNamespace(residuals=[e]) for e in f.euler(density[None]).values()]
        is_kept = cx.vanish(f, [defect], held + rules_of(f, [*(e for e in f.imposed if e.on is None), *stated]))
    why = f"its own current and defect, at random points modulo primes: the defect vanishes for solutions: {is_kept}"
    return ("confirmed" if is_kept == (verdict["verdict"] == "proved") else "rejected"), why


CLAIMS = {"functional.noether": noether}
