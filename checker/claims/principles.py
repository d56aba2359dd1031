"""Variational principles: their integrands along arbitrary curves and along motions (theory 1 §§2-7).

A variation is a random Taylor series for each coordinate; virtual ones satisfy sum f_v dq = 0 along the curve, order by order. What is
varied is linear, so that L varies by the sum of slopes times variations.
"""
from fractions import Fraction

from claims.frobenius import wander
from variations import N, Variation
from expressions import gradient, mul, sub, sym, total

def motion(cx):
    return lambda p: cx.system.move(p)


def curve(cx):
    """An admissible curve that is no motion, where the constraints are of first order."""
    def start(p):
        for x in cx.system.q:
            p.curves[x] = p.curves[x][:2]
        for m in cx.system.masses:
            p.curves[m] = p.curves[m][:1] + [p.any() for _ in range(N + 2)]
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


HOELDER, SUSLOV = central(lambda w: w.d_dq), central(lambda w: w.suslov())
CLAIMS = {"hamilton.central-identity": central(lambda w: w.random()), "hamilton.hoelder": HOELDER, "hamilton.voronets": SUSLOV,
          "hamilton.suslov": SUSLOV, "hamilton.helmholtz-poincare": central(lambda w: w.random()),
          "hamilton.forms-equivalent": equivalent_forms, "action.identity": asynchronous,
          "action.lagrange": lagrange, "universal-relation#zero": central(lambda w: [[0] * w.n] * w.size), "universal-relation#hoelder": HOELDER,
          "universal-relation#suslov": SUSLOV, "universal-relation#vujanovic": central(lambda w: w.random())}
