"""Chaplygin's reducing multiplier (theory 1 §6.2, (26)): N sum theta A_s + sum_u v_u (P_s N_u - P_u N_s) = 0 for all momenta, with the sign
of (25): N S + P_1 N_2 - P_2 N_1 = 0, where S v_2 = sum theta A_1 and P_s are the momenta of the reduced kinetic energy.
"""
import itertools
import re

from claims.frobenius import wander
from reduced import Reduced
from expressions import NotCheckable, gradient, sub, says
from fields import rank, solve


def independent_of(cx, verdict):
    named = re.search(r"equations of motion in (.+?) Hamilton's", verdict["detail"])
    if named:
        return [re.split(r", | and ", named[1])]
    system = cx.system
    p = system.point(cx.rng)
    slopes = [[p.value(e) for e in gradient(f, system.jet(0))] for f in system.top + [system.lagrangian]]
    absent = [i for i in range(len(system.q)) if not any(row[i] for row in slopes)]
    v = p.table(system.jacobian)
    regular = [d for d in itertools.combinations(absent, len(system.top)) if rank([[row[i] for i in d] for row in v], p.p) == len(d)]
    if not regular:
        raise NotCheckable("no dependent coordinates are absent from L and the constraints")
    return [[x for i, x in enumerate(system.q) if i not in d] for d in regular]


@says("refuted")
def multiplier(cx, verdict):
    system = cx.system
    if not system.top:
        return ("confirmed", "there are no constraints, and N = 1") if verdict["verdict"] == "proved" else ("rejected", "no constraints")
    choices = independent_of(cx, verdict)
    if verdict["verdict"] == "refuted":
        outcomes = [none(cx, verdict, Reduced(cx, names), names) for names in choices]
        return next((o for o in outcomes if o[0] == "confirmed"), outcomes[0])
    names = choices[0]
    reduced = Reduced(cx, names)
    if len(names) != 2:
        raise NotCheckable("not two independent velocities")
    n = cx.formulas({"formulas": verdict["formulas"][2:3]})[0][1]
    slopes = gradient(n, [(x, 0) for x in names])
    def at(p):
        wander(cx, p)
        (a, b), (p1, p2), (v1, v2) = reduced.at(p)
        n_, n1, n2 = p.value(n, *slopes)
        gap = (p1 * n2 - p2 * n1) % p.p
        return [(n_ * a + v2 * gap) % p.p, (n_ * b - v1 * gap) % p.p]
    return cx.identity(at, [n])


def none(cx, verdict, reduced, names):
    """No slopes of ln N serve all momenta at a random position; or those that do have other mixed derivatives."""
    if len(names) == 2:
        first, second = (e for _, e in cx.formulas({"formulas": verdict["formulas"][:2]}))
        def serve(p):
            wander(cx, p)
            (a, b), (p1, p2), (v1, v2) = reduced.at(p)
            n1, n2 = p.value(first, second)
            return [(a + v2 * (p1 * n2 - p2 * n1)) % p.p, (b - v1 * (p1 * n2 - p2 * n1)) % p.p]
        if not cx.vanishes(serve, [first, second])[0]:
            return "rejected", "the slopes stated do not serve the equations"
        mixed = sub(gradient(first, [(names[1], 0)])[0], gradient(second, [(names[0], 0)])[0])
        return cx.counterexample(verdict, [mixed], admissible=False)
    k = len(names)
    def solvable(p):
        rows, right = [], []
        for _ in range(k + 1):
            for x in cx.system.q:
                p.curves[x][1] = p.any()
            cx.system.meet(p, cx.system.top, 1)
            wander(cx, p)
            bent, push, v = reduced.at(p)
            for s in range(k):
                row = [push[s] * v[u] % p.p for u in range(k)]
                row[s] = (row[s] - sum(x * y for x, y in zip(push, v))) % p.p
                rows.append(row)
                right.append(-bent[s] % p.p)
        return [1 if solve(rows, right, p.p) is not None else 0]
    return cx.identity(solvable)


CLAIMS = {"chaplygin.multiplier": multiplier}
