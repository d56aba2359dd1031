"""`model.metric-positive`, `formulation.gauss-least`: the quadratic part of L is a sum of squares with positive coefficients, as it is
written, and W is regular (on the virtual displacements): a form that is nowhere negative and regular is positive.

Parameters count as positive where their values, or the assumptions, say so.
"""
from expressions import NODES, NotCheckable, gradient, mul, sub, sym, symbols, total
from fields import is_manifestly_positive, rank


def terms(e):
    """The terms of a sum, products by numbers gone through."""
    key = NODES[e]
    if key[0] == "+":
        return [t for c in key[1:] for t in terms(c)]
    if key[0] == "*":
        for own, other in (key[1:], key[:0:-1]):
            if NODES[own][0] == "number" and NODES[other][0] == "+":
                return [mul(own, t) for t in terms(other)]
    return [e]


def is_sum_of_squares(cx):
    """Whether the terms of L that are quadratic in the velocities are positive, and no others contain velocities but linearly."""
    system = cx.system
    doubtful = {n for n, v in system.stated_values.items() if NODES[v][0] == "number" and NODES[v][1] <= 0} | set(system.definitions)
    doubtful |= {x for x in system.parameters if x not in system.stated_values and f"0 < {x}" not in system.assumptions}
    moving = [t for t in terms(system.lagrangian) if symbols([t]) & set(system.jet(1))]
    second = []
    for t in moving:
        turned = total(mul(sym(x, 1), s) for x, s in zip(system.q, gradient(t, system.jet(1))))
        of_degree = lambda k: cx.vanishes(lambda p: [p.value(sub(turned, total([t] * k)))], free=True)[0]
        if of_degree(2):
            second.append(t)
        elif not of_degree(1):
            return False
    coefficients = {n for t in second for n, k in symbols([t]) if k == 0}
    return bool(second) and all(is_manifestly_positive(t) for t in second) and not coefficients & doubtful


def positive(cx, verdict):
    if not is_sum_of_squares(cx):
        raise NotCheckable("the kinetic energy is not written as a sum of squares with positive coefficients")
    w = cx.system.mass_matrix
    return cx.identity(lambda p: [len(w) - rank(p.table(w), p.p)])


CLAIMS = {"model.metric-positive": positive, "formulation.gauss-least": positive}
