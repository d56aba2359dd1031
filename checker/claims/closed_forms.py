"""`functional.solution`: fields in closed form make the first variation vanish, and the functional has the stated value.

The value is an integral over a box of a polynomial in the place: it is taken by a rule of Newton and Cotes, exact to its degree modulo a prime.
"""
import itertools

from expressions import NotCheckable, ZERO, sub
from fields import solve
from functionals import Functional
from jets import Jets

NODES_OF_RULE = 12


def solution(cx, verdict):
    own = cx.data["solutions"][verdict["subject"]]
    data = {**cx.data, "domain": {**cx.data["domain"], "intervals": own["intervals"]}}
    data["boundary"] = dict(faces(cx.data, own["pieces"]))
    names = set(data["fields"]) | set(data.get("data", {}))
    special = {left: right for left, right in own["fields"].items() if "(" in left or left.split("_")[0] not in names}
    data["parameters"] = {**data.get("parameters", {}), **{name: {} for name in own["parameters"]}}
    f = Functional(data, special)
    rules = []
    for left, right in own["fields"].items():
        if left not in special:
            tree = f.scope.tree(left)
            order, places = f.places(tree)
            for t, e in zip(places(), f.scope.components(f.scope.tree(right), order).values()):
                symbol = f.scope.tensors[f.head(tree)][t]
                rules.append(([sub(symbol, e)], [next(iter(f.jets_of(symbol)))], None))
    density, held = f.lagrangian()
    rules += held
    if not cx.vanish(f, f.euler(density[None]).values(), rules):
        return "rejected", "the Euler equations do not vanish on the stated fields"
    flux = f.flux(density[None])
    for name, piece in f.pieces.items():
        values, normal, _, _ = piece.conditions(f.form(piece, flux, density[name]))
        if not cx.vanish(f, [*values.values(), *normal.values()], rules, piece.place()):
            return "rejected", f"the conditions on {name} do not vanish on the stated fields"
    if "value" in own:
        p = Jets(f, cx.rng, rules)
        stated, found = p.value(f.scope.scalar(own["value"])), integral(f, p, own["intervals"])
        if (stated - found) % p.p:
            return "rejected", "the functional has another value"
    return "confirmed", "put into its own first variation, and integrated by a rule that is exact for polynomials modulo a prime"


def faces(data, places):
    """The pieces of the boundary where they lie on the box: one for each face."""
    for name, piece in data["boundary"].items():
        at = places.get(name)
        if not isinstance(at, list):
            yield name, {**piece, **({"at": at} if at else {})}
        elif any(name in e.get("on", "") for e in data.get("equations", {}).values()):
            raise NotCheckable("an equation on a piece that is several faces")
        else:
            yield from ((f"{name}: {face}", {**piece, "at": face}) for face in at)


def integral(f, p, intervals):
    """The functional at the fields of the rules."""
    ends = {f.scope.coordinates.index(x): [p.value(f.scope.scalar(e)) for e in pair] for x, pair in intervals.items()}
    if set(ends) != set(range(f.d)):
        raise NotCheckable("a box without all its ends")
    weights = rule(p)
    def over(e, fixed):
        axes = [i for i in ends if i not in fixed]
        out = 0
        for ks in itertools.product(range(NODES_OF_RULE), repeat=len(axes)):
            at, weight = dict(fixed), 1
            for i, k in zip(axes, ks):
                low, high = ends[i]
                at[i] = (low + (high - low) * k * pow(NODES_OF_RULE - 1, -1, p.p)) % p.p
                weight = weight * weights[k] * (high - low) % p.p
            for key in [k for k in p.known if k[0] in f.scope.jets or isinstance(k[0], tuple)]:
                del p.known[key]
            p.known.update({(f.scope.coordinates[i], "x"): x for i, x in at.items()})
            out += weight * p.value(e)
        return out
    whole = over(f.density, {})
    for piece in f.pieces.values():
        if piece.density != ZERO:
            whole += over(piece.density, {piece.axis: p.value(piece.at)})
    return whole % p.p


def rule(p):
    """Weights over [0, 1] at equal distances, exact for polynomials of a degree below their number."""
    over, n = pow(NODES_OF_RULE - 1, -1, p.p), NODES_OF_RULE
    rows = [[pow(k * over, j, p.p) for k in range(n)] for j in range(n)]
    return solve(rows, [pow(j + 1, -1, p.p) for j in range(n)], p.p)


CLAIMS = {"functional.solution": solution}
