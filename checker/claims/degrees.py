"""Degrees in the velocities (theory 1 §0): constraints that are linear or homogeneous, a Lagrangian that is quadratic."""
import re

from expressions import add, gradient, mul, neg, num, says, sub, substitute, sym, symbols, total


def top_jet(system):
    return system.jet(system.order)


def linear(system, _):
    """f(v) + f(w) - 2 f((v + w)/2), which is zero for all v, w exactly where f is affine along every line."""
    names = top_jet(system)
    other = {s: sym("w_" + s[0], s[1]) for s in names}
    middle = {s: mul(num("1/2"), add(sym(*s), other[s])) for s in names}
    return [total([f, g, mul(num(-2), h)]) for f, g, h in
            zip(system.top, substitute(system.top, other), substitute(system.top, middle))]


@says("refuted")
def linear_check(cx, verdict):
    names = top_jet(cx.system)
    if verdict["verdict"] == "proved":
        es = [e for row in cx.system.jacobian for e in row]
        bad = [s for e in es for s in symbols([e]) if s in names]
        slopes = [g for e in es for g in gradient(e, names)] if bad else []
        return cx.identity(lambda p: p.values(slopes), slopes, free=True)
    return cx.counterexample(verdict, linear(cx.system, verdict), admissible=False)


def homogeneous(system, verdict):
    """sum v f_v - k f for the degrees stated; where none are, those that a point allows are not asked for."""
    degrees = dict((name, k) for k, name in re.findall(r"degree (-?\d+(?:/\d+)?) for `([^`]+)`", verdict["detail"]))
    one = re.search(r"Σ v ∂f/∂v − (-?\d+) f of `([^`]+)`", verdict["detail"])
    out = []
    for name, f in zip(system.constraint_names, system.top):
        k = degrees.get(name, one.group(1) if one and one.group(2) == name else "1")
        euler = total(mul(sym(x, 1), s) for x, s in zip(system.q, gradient(f, system.jet(1))))
        if verdict["verdict"] == "proved" or (one and one.group(2) == name):
            out.append(sub(euler, mul(num(k), f)))
    return out


@says("refuted")
def homogeneous_check(cx, verdict):
    es = homogeneous(cx.system, verdict)
    if verdict["verdict"] == "proved":
        return cx.identity(lambda p: p.values(es), es, free=True)
    return cx.counterexample(verdict, es, admissible=False)


def third(system, _):
    return [e for row in system.mass_matrix for w in row for e in gradient(w, system.jet(1))]


@says("refuted")
def quadratic_check(cx, verdict):
    es = third(cx.system, verdict)
    if verdict["verdict"] == "proved":
        return cx.identity(lambda p: p.values(es), es, free=True)
    system = cx.system
    other = {s: sym("w_" + s[0], 1) for s in system.jet(1)}
    step = [sub(sym(*s), other[s]) for s in system.jet(1)]
    momenta = substitute(system.momenta, other)
    second = [substitute(row, other) for row in system.mass_matrix]
    rest = [sub(system.lagrangian, substitute([system.lagrangian], other)[0])]
    rest += [neg(mul(p, d)) for p, d in zip(momenta, step)]
    rest += [mul(num("-1/2"), mul(mul(a, b), w)) for a, row in zip(step, second) for b, w in zip(step, row)]
    return cx.counterexample(verdict, [total(rest)], admissible=False)


CLAIMS = {"model.constraints-linear": linear_check, "model.constraints-homogeneous": homogeneous_check,
          "model.lagrangian-quadratic": quadratic_check}
