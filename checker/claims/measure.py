"""Densities of invariant measures (theory 3 §10): N dq d(eta) is invariant where D ln N + div X = 0 on the admissible states.

The divergence is taken in the coordinates q, the velocities eta that the record names, and masses with a law of their own: for each of
them the state is moved to first order with the others held, the velocities so that the constraints hold.
"""
import re

from expressions import NotCheckable, gradient, sym
from fields import solve
from systems import solve_series


def directions(cx, p, speeds):
    """For each coordinate, speed and mass: the first-order change (dq, dv, dM) of the state with the others held."""
    system, n = cx.system, len(cx.system.q)
    rows = [*system.top, *speeds]
    by_v = [[p.value(e) for e in gradient(f, system.jet(1))] for f in rows]
    by_q = [[p.value(e) for e in gradient(f, system.jet(0))] for f in rows]
    by_m = [[p.value(e) for e in gradient(f, [(m, 0) for m in system.masses])] for f in rows]
    unit = lambda size, i: [int(i == j) for j in range(size)]
    fit = lambda right: solve(by_v, right, p.p)
    for i in range(n):
        yield unit(n, i), fit([-row[i] for row in by_q]), [0] * len(system.masses)
    for s in range(len(speeds)):
        yield [0] * n, fit([0] * len(system.top) + unit(len(speeds), s)), [0] * len(system.masses)
    for m in range(len(system.masses)):
        yield [0] * n, fit([-row[m] for row in by_m]), unit(len(system.masses), m)


def divergence(cx, p, speeds):
    system, n, k = cx.system, len(cx.system.q), len(speeds)
    rates = [sym(x, 1) for x in system.q] + [system.rate(e) for e in speeds] + [system.mass_rates[m] for m in system.masses]
    rows, right = system.bordered()
    size = len(rows)
    fixed = {("t", 0): [p.curves["t"][0]]}
    fixed |= {(u, j): [p.coefficients(u, j, 1)[0]] for u in system.controls for j in range(3)}
    state = [(x, j) for j in (0, 1) for x in system.q] + [(m, 0) for m in system.masses]
    here = {s: p.coefficients(*s, 1)[0] for s in state}
    out = 0
    for j, (dq, dv, dm) in enumerate(directions(cx, p, speeds)):
        if dv is None:
            raise NotCheckable("the speeds named do not determine the velocities")
        p.jets = fixed | {s: [here[s], d] for s, d in zip(state, dq + dv + dm)}
        values = p.series([e for row in rows for e in row] + right, 2)
        x = solve_series([values[i * size:(i + 1) * size] for i in range(size)], values[size * size:], 2, p.p)
        p.jets |= {(name, 2): a for name, a in zip(system.q, x)}
        out += p.series([rates[j]], 2)[0][1]
    p.jets = {}
    return out % p.p


def invariant(cx, verdict):
    named = re.search(r"with η = \(([^)]*)\)", verdict["detail"])
    if verdict["verdict"] != "proved" or not named or "is invariant for" not in verdict["detail"]:
        raise NotCheckable("no density is stated")
    density = cx.formulas({"formulas": verdict["formulas"][:1]})[0][1]
    speeds = [cx.read(n.strip()) for n in named[1].split(",") if n.strip()]

    def at(p):
        turned = divergence(cx, p, speeds)
        cx.system.move(p)
        n, rate = p.series([density], 2)[0]
        return [rate + n * turned]

    return cx.identity(lambda p: [x % p.p for x in at(p)], [density])


CLAIMS = {"measure.invariant": invariant}
