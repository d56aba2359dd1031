"""Chaplygin's reducing multiplier (theory 1 §6.2, (26)): N sum theta A_s + sum_u v_u (P_s N_u - P_u N_s) = 0 for all momenta, with the sign
of (25): N S + P_1 N_2 - P_2 N_1 = 0, where S v_2 = sum theta A_1 and P_s are the momenta of the reduced kinetic energy.
"""
import itertools
import re

from claims.frobenius import euler
from expressions import NotCheckable, gradient, mul, sub, says
from fields import eliminate, null_space, rank, solve


class Reduced:
    """theta A_s, P_s and v_s at a state, for independent coordinates whose complement the constraints determine."""

    def __init__(self, cx, independent):
        self.system, self.s = cx.system, [cx.system.q.index(x) for x in independent]
        self.d = [i for i in range(len(cx.system.q)) if i not in self.s]
        self.forms = [euler(cx.system, f) for f in cx.system.top]

    def at(self, p):
        """Needs accelerations with D f = 0, which linear A does not contain: any do."""
        system, q = self.system, p.p
        v = [[p.value(e) for e in row] for row in system.jacobian]
        e = [[p.value(x) for x in form] for form in self.forms]
        momenta = [p.value(x) for x in system.momenta]
        basis = []
        for s in self.s:
            column = solve([[row[d] for d in self.d] for row in v], [-row[s] for row in v], q)
            if column is None:
                raise NotCheckable("velocities that the constraints do not determine")
            b = [0] * len(system.q)
            b[s] = 1
            for d, x in zip(self.d, column):
                b[d] = x
            basis.append(b)
        # theta^T f_d^{-1}: the row t with t f_d = theta.
        t = solve([[row[d] for row in v] for d in self.d], [momenta[d] for d in self.d], q)
        bent = [sum(c * sum(x * y for x, y in zip(form, b)) for c, form in zip(t, e)) % q for b in basis]
        push = [sum(x * y for x, y in zip(momenta, b)) % q for b in basis]
        return bent, push, [p.curves[system.q[s]][1] for s in self.s]


def independent_of(cx, verdict):
    named = re.search(r"equations of motion in (.+?) Hamilton's", verdict["detail"])
    if named:
        return [re.split(r", | and ", named[1])]
    system = cx.system
    p = system.point(cx.rng)
    slopes = [[p.value(e) for e in gradient(f, system.jet(0))] for f in system.top + [system.lagrangian]]
    absent = [i for i in range(len(system.q)) if not any(row[i] for row in slopes)]
    v = [[p.value(e) for e in row] for row in system.jacobian]
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
        from claims.frobenius import wander
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
            from claims.frobenius import wander
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
            from claims.frobenius import wander
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
