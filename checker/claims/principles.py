"""Variational principles: their integrands along arbitrary curves and along motions (theory 1 §§2-7).

A variation is a random Taylor series for each coordinate; virtual ones satisfy sum f_v dq = 0 along the curve, order by order. What is
varied is linear, so that L varies by the sum of slopes times variations.
"""
import itertools
import re
from fractions import Fraction

from claims.frobenius import wander
from expressions import NotCheckable, gradient, mul, sub, substitute, sym, total
from fields import eliminate, rank, solve

N = 3  # coefficients that are compared


class Variation:
    """A curve at a point with the slopes of L and of the constraints, and a virtual displacement along it."""

    def __init__(self, cx, p, curve, virtual=True):
        system, self.p, self.n = cx.system, p, N + 1
        if system.order != 1:
            raise NotCheckable("constraints of higher order")
        curve(p)
        names = [*system.jet(0), *system.jet(1)]
        self.size = len(system.q)
        series = lambda es: p.series(es, self.n)
        self.l_q, self.l_v = series(gradient(system.lagrangian, system.jet(0))), series(system.momenta)
        self.force, self.v = series(system.force), series([sym(x, 1) for x in system.q])
        self.l, self.l_t = series([system.lagrangian])[0], self.clock(cx)
        self.f_q = [series(gradient(f, system.jet(0))) for f in system.top]
        self.f_v = [series(row) for row in system.jacobian]
        self.columns = eliminate([[e[0] for e in row] + [0] for row in self.f_v], p.p)[1] if self.f_v else []
        self.dq = self.random()
        if virtual and self.f_v:
            self.dq = self.fitted(self.f_v, self.dq, [[0] * self.n for _ in self.f_v])
        self.d_dq = [p.rate(x) for x in self.dq]

    def clock(self, cx):
        moving = sub(cx.system.rate(cx.system.lagrangian), total(
            mul(s, sym(x, k + 1)) for k in (0, 1) for x, s in zip(cx.system.q, gradient(cx.system.lagrangian, cx.system.jet(k)))))
        return self.p.series([moving], self.n)[0]

    def random(self):
        return [[self.p.any() for _ in range(self.n)] for _ in range(self.size)]

    def dot(self, a, b):
        out = [0] * self.n
        for x, y in zip(a, b):
            out = [(u + w) % self.p.p for u, w in zip(out, self.p.times(x, y))]
        return out

    def plus(self, *series):
        return [sum(c) % self.p.p for c in zip(*series)]

    def less(self, a, b):
        return [(x - y) % self.p.p for x, y in zip(a, b)]

    def fitted(self, rows, x, right):
        """Changes the components with pivots so that rows x = right, order by order."""
        x, p = [list(s) for s in x], self.p.p
        for k in range(self.n):
            for c in self.columns:
                x[c][k] = 0
            gap = [(r[k] - sum(row[i][j] * x[i][k - j] for i in range(self.size) for j in range(k + 1))) % p for row, r in zip(rows, right)]
            step = solve([[row[c][0] for c in self.columns] for row in rows], gap, p)
            if step is None:
                raise NotCheckable("variations of constraints that follow from each other")
            for c, s in zip(self.columns, step):
                x[c][k] = s
        return x

    def of_constraints(self, dv):
        return [self.plus(self.dot(a, self.dq), self.dot(b, dv)) for a, b in zip(self.f_q, self.f_v)]

    def suslov(self):
        """delta v with delta f = 0: D(dq) for the independent velocities."""
        right = [[-x % self.p.p for x in self.dot(row, self.dq)] for row in self.f_q]
        return self.fitted(self.f_v, self.d_dq, right) if self.f_v else self.d_dq

    def of_lagrangian(self, dv):
        return self.plus(self.dot(self.l_q, self.dq), self.dot(self.l_v, dv))

    def rate(self, x):
        return self.p.rate(x)

    def cut(self, *series):
        return [x for s in series for x in s[:N - 1]]


def motion(cx):
    return lambda p: cx.system.move(p)


def curve(cx):
    """An admissible curve that is no motion, where the constraints are of first order."""
    def start(p):
        for x in cx.system.q:
            p.curves[x] = p.curves[x][:2]
        return wander(cx, p, N + 2)
    return start


def central(rule):
    """Along motions and for virtual dq: dL + Q dq + p (D dq - dv) = D(p dq), with dv by a rule."""
    def check(cx, verdict):
        def at(p):
            w = Variation(cx, p, motion(cx))
            dv = rule(w)
            gap = w.dot(w.l_v, [w.less(a, b) for a, b in zip(w.d_dq, dv)])
            return w.cut(w.less(w.plus(w.of_lagrangian(dv), w.dot(w.force, w.dq), gap), w.rate(w.dot(w.l_v, w.dq))))
        return cx.identity(at, [cx.system.lagrangian])
    return check


def equivalent_forms(cx, verdict):
    """For admissible curves the integrands of Hoelder, Voronets and Suslov are equal; theta (dv - dphi) closes the gap."""
    def at(p):
        w = Variation(cx, p, curve(cx))
        suslov = w.suslov()
        hoelder = w.of_lagrangian(w.d_dq)
        gap = w.dot(w.l_v, [w.less(a, b) for a, b in zip(w.d_dq, suslov)])
        f = w.of_constraints(suslov)
        return w.cut(w.less(hoelder, w.plus(w.of_lagrangian(suslov), gap)), *f)
    return cx.identity(at, [cx.system.lagrangian])


def suslov_rule(cx, verdict):
    """delta f = 0 by Suslov's rule, and the dv that the record states are those."""
    stated = cx.formulas(verdict)
    def at(p):
        w = Variation(cx, p, curve(cx))
        dv = w.suslov()
        out = w.cut(*w.of_constraints(dv))
        for x, series in zip(cx.system.q, w.dq):
            p.curves["delta_" + x] = series
        given = [p.value(e) for _, e in stated]
        # Which velocities are dependent is the choice of the record: every choice gives another rule, and is fitted to it.
        if given and len(given) == len(w.columns):
            fits = []
            for columns in itertools.combinations(range(w.size), len(given)):
                w.columns = list(columns)
                if len(eliminate([[row[c][0] for c in columns] + [0] for row in w.f_v], p.p)[1]) == len(columns):
                    own = w.suslov()
                    fits.append(sorted(own[c][0] for c in columns) == sorted(given))
            out.append(0 if any(fits) else 1)
        return out
    return cx.identity(at, [e for _, e in stated])


def asynchronous(cx, verdict):
    """(18): dL + D(L Dt) + Q dq = D(-H Dt + p Dq), Dq = dq + v Dt."""
    def at(p):
        w = Variation(cx, p, motion(cx))
        dt = [p.any() for _ in range(w.n)]
        total_dq = [w.plus(a, p.times(v, dt)) for a, v in zip(w.dq, w.v)]
        energy = w.less(w.dot(w.l_v, w.v), w.l)
        right = w.rate(w.less(w.dot(w.l_v, total_dq), p.times(energy, dt)))
        return w.cut(w.less(w.plus(w.of_lagrangian(w.d_dq), w.rate(p.times(w.l, dt)), w.dot(w.force, w.dq)), right))
    return cx.identity(at, [cx.system.lagrangian])


def second_kind(cx, verdict):
    """The pointwise identity behind (34) = dZ + Q dq - D(L_v dq) for curves q(t) and v(t) of their own; and W regular, so that Dq = v."""
    system = cx.system
    other = {(x, 1): ("u_" + x) for x in system.q}
    put = {s: sym(n) for s, n in other.items()}
    l_q, l_v, force = (substitute(es, put) for es in (gradient(system.lagrangian, system.jet(0)), system.momenta, system.force))
    names = [*system.jet(0), *((n, 0) for n in other.values())]
    second = [gradient(e, names) for e in l_v]
    w_matrix = [row[len(system.q):] for row in second]
    def at(p):
        for x in system.q:
            p.curves[x] = [*p.curves[x][:1], *(p.any() for _ in range(4))]
            p.curves["u_" + x] = [p.curves[x][1], *(p.any() for _ in range(4))]
        for m in system.masses:
            p.curves[m] = [*p.curves[m][:1], *(p.any() for _ in range(4))]
        n, size = 3, len(system.q)
        draw = lambda: [[p.any() for _ in range(n)] for _ in range(size)]
        dq, dv = draw(), draw()
        add_ = lambda *s: [sum(c) % p.p for c in zip(*s)]
        dot = lambda a, b: add_([0] * n, *(p.times(x, y) for x, y in zip(a, b)))
        minus = lambda a: [-x % p.p for x in a]
        a, b, q = p.series(l_q, n), p.series(l_v, n), p.series(force, n)
        gap = [add_(p.coefficients(x, 1, n), minus(p.coefficients("u_" + x, 0, n))) for x in system.q]
        d_lv = [add_(*(p.times(s, y) for s, y in zip(p.series(row, n), dq + dv))) for row in second]
        left = add_(dot([add_(x, y, minus(p.rate(z))) for x, y, z in zip(a, q, b)], dq), dot(gap, d_lv))
        d_z = add_(dot(a, dq), dot(b, dv), dot([add_(p.rate(x), minus(y)) for x, y in zip(dq, dv)], b), dot(gap, d_lv))
        right = add_(d_z, dot(q, dq), minus(p.rate(dot(b, dq))))
        regular = rank([[p.value(e) for e in row] for row in w_matrix], p.p) == size
        return add_(left, minus(right))[:n - 1] + [0 if regular else 1]
    return cx.identity(at, [system.lagrangian], free=True)


def lagrange(cx, verdict):
    """(19): D(p v) + (p v) D(Dt)' = D(p Dq)' for virtual Dq where the energy is not varied."""
    system = cx.system
    h = sub(total(mul(p, sym(x, 1)) for p, x in zip(system.momenta, system.q)), system.lagrangian)
    action = total(mul(p, sym(x, 1)) for p, x in zip(system.momenta, system.q))
    slopes = [gradient(e, system.jet(k)) for e in (h, action) for k in (0, 1)]
    def at(p):
        w = Variation(cx, p, motion(cx))
        h_q, h_v, a_q, a_v = (p.series(es, w.n) for es in slopes)
        lower = w.dot(h_v, w.v)
        dt = p.times(w.plus(w.dot(h_q, w.dq), w.dot(h_v, w.d_dq)), p.raised(lower, Fraction(-1)))
        dv = [w.less(a, p.times(v, dt)) for a, v in zip(w.d_dq, w.v)]
        varied = w.plus(w.dot(a_q, w.dq), w.dot(a_v, dv), p.times(w.dot(w.l_v, w.v), dt))
        return w.cut(w.less(varied, w.rate(w.dot(w.l_v, w.dq))))
    return cx.identity(at, [system.lagrangian])


def count(*said):
    """Dimensions that a sentence names: n - r of the set reached, 2 n - r constants of motion, 2 n of the extremum."""
    def check(cx, verdict):
        p, n = cx.system.point(cx.rng), len(cx.system.q)
        r = rank([[p.value(e) for e in row] for row in cx.system.jacobian], p.p)
        for pattern, number in said:
            found = re.search(pattern, verdict["detail"])
            if found and int(found[1]) != number(n, r):
                return "rejected", f"{number(n, r)}, not {found[1]}"
            if not found and pattern == said[0][0]:
                return "not checkable here", "no number is said"
        return "confirmed", f"n = {n}, r = {r} at a random point"
    return check


HOELDER, SUSLOV = central(lambda w: w.d_dq), central(lambda w: w.suslov())
CLAIMS = {"hamilton.central-identity": central(lambda w: w.random()), "hamilton.hoelder": HOELDER, "hamilton.voronets": SUSLOV,
          "hamilton.suslov": SUSLOV, "hamilton.helmholtz-poincare": central(lambda w: w.random()),
          "hamilton.forms-equivalent": equivalent_forms, "variation.suslov": suslov_rule, "action.identity": asynchronous,
          "action.lagrange": lagrange, "second-kind.identity": second_kind, "second-kind.differential": second_kind,
          "second-kind.integral": second_kind, "second-kind.canonical": second_kind, "formulation.identity#state-space": second_kind,
          "universal-relation#zero": central(lambda w: [[0] * w.n] * w.size), "universal-relation#hoelder": HOELDER,
          "universal-relation#suslov": SUSLOV, "universal-relation#vujanovic": central(lambda w: w.random()),
          "hamilton.endpoints": count((r"a set of (\d+) dimension", lambda n, r: n - r)),
          "hamilton.constants": count((r"motion has (\d+) constant", lambda n, r: 2 * n - r), (r"extremum has (\d+)", lambda n, r: 2 * n))}
