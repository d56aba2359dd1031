"""Stationary action and its multipliers kappa (theory 1 §4): on motions, sum kappa E_i[f] - kappa' f_v = lambda f_v with kappa' the rate.

For every motion: the kappa of the record satisfy (12) and (13). On a subset: the same at states on the set that the condition states, and no
kappa exists off it, by the closure of §4.3 (the rows are differentiated along the motion until their rank stays).
"""
import itertools
import re

from claims.frobenius import euler
from claims.multiplier import Reduced
from claims.multiplier import Reduced
from expressions import NotCheckable, symbols, says
from fields import rank, solve

STEPS = 4


def kappas(cx, verdict):
    """One expression for each constraint; constants `const_NAME` stay free."""
    given = {left: e for left, e in cx.formulas(verdict) if left and left.startswith("kappa_")}
    names = ["kappa_" + c for c in cx.system.constraint_names]
    if len([l for l, _ in cx.formulas(verdict) if l and l.startswith("kappa_")]) != len(given):
        return [None] * len(names)
    return [given.get(n) for n in names]


def conditions(cx, given):
    """(11) along the motion: the coefficients of kappa and kappa' less those of the reaction."""
    system = cx.system
    forms = [euler(system, f) for f in system.top]
    def at(p):
        system.move(p)
        reaction = ["lambda_" + c for c in system.constraint_names]
        series = p.series([e for e in given if e is not None], 2)
        values = iter(series)
        k = [next(values) if e is not None else [0, 0] for e in given]
        e = [[p.value(x) for x in form] for form in forms]
        v = [[p.value(x) for x in row] for row in system.jacobian]
        lam = [p.curves[name][0] if name in p.curves else 0 for name in reaction]
        return [sum(a[0] * x[i] - (a[1] + l) * y[i] for a, x, y, l in zip(k, e, v, lam)) % p.p for i in range(len(system.q))]
    return at, [x for form in forms for x in form]


def exists(cx, p):
    """Whether some kappa satisfies the conditions on the motion through a point: the rows are linear in kappa and kappa', and so are
    their derivatives in the Taylor coefficients of kappa."""
    system = cx.system
    r, n = len(system.top), len(system.q)
    forms = [p.series(euler(system, f), STEPS) for f in system.top]
    slopes = [p.series(row, STEPS) for row in system.jacobian]
    lam = [p.curves["lambda_" + c][:STEPS] for c in system.constraint_names]
    rows, right = [], []
    for i in range(n):
        for k in range(STEPS):
            row = [0] * (r * (STEPS + 1))
            for l in range(r):
                for j in range(k + 1):
                    row[l * (STEPS + 1) + k - j] += forms[l][i][j]
                    row[l * (STEPS + 1) + k - j + 1] -= slopes[l][i][j] * (k - j + 1)
            rows.append([x % p.p for x in row])
            right.append(sum(slopes[l][i][j] * lam[l][k - j] for l in range(r) for j in range(k + 1)) % p.p)
    return solve(rows, right, p.p) is not None


def move_far(cx, p):
    cx.system.move(p, 8)
    rows, right = cx.system.bordered()
    from systems import solve_series
    size = len(rows)
    values = p.series([e for row in rows for e in row] + right, STEPS + 1)
    x = solve_series([values[i * size:(i + 1) * size] for i in range(size)], values[size * size:], STEPS + 1, p.p)
    for l, name in enumerate(cx.system.constraint_names):
        p.curves["lambda_" + name] = x[len(cx.system.q) + l]
    return p


@says("refuted", "conditional")
def stationary(cx, verdict):
    system = cx.system
    if system.order != 1:
        raise NotCheckable("constraints of higher order")
    without = lambda p: [1 if exists(cx, move_far(cx, p)) else 0]
    if verdict["verdict"] == "refuted":
        slip = cx.slip_of_counterexample(verdict)
        return ("rejected", slip) if slip else cx.identity(without)
    if verdict["verdict"] == "conditional":
        return on_a_set(cx, verdict, without)
    given = kappas(cx, verdict)
    at, kinds = conditions(cx, given)
    if any(e is not None for e in given):
        return cx.identity(at, kinds + [e for e in given if e is not None])
    return cx.identity(lambda p: [0 if exists(cx, move_far(cx, p)) else 1], kinds)


def cases(cx, verdict):
    """The alternatives of a condition, each a list of equations; ranges and equations of angles are not read."""
    text = re.split(r"; ", verdict["condition"])[0]
    if "(" in re.sub(r"\b(sin|cos|sqrt|tan)\(", "", text) and "mod" in text or "with" in text:
        raise NotCheckable("a condition with sides or angles")
    return [[cx.system.equation(e) for e in re.split(r", | and ", case)] for case in re.split(r",? or ", text)]


def on_a_set(cx, verdict, without):
    """On the set (all its equations, and what their rates add, hold at the point) kappa exists; off it none does."""
    off, why = cx.vanishes(without)
    if not off:
        return "rejected", "kappa exists at a random state off the set"
    for case in cases(cx, verdict):
        if any(cx.system.order_of(e) > 1 for e in case):
            raise NotCheckable("a condition on accelerations")
        on = [(cx.system.order_of(e), e) for e in case]
        invariant = lambda p: [0 if exists(cx, move_far(cx, p)) else 1] + [c for e in case for c in p.series([e], 3)[0]]
        holds, _ = cx.vanishes(invariant, on=on)
        if not holds:
            return "rejected", "on the set stated a motion has no kappa, or leaves it"
    return "confirmed", f"on and off the set: {why}"


@says("refuted", "conditional")
def inclusion(cx, verdict):
    if verdict["subject"] == "inclusion":
        return stationary(cx, verdict)
    raise NotCheckable("all extremals are not followed")


@says("refuted", "conditional")
def hamilton_jacobi(cx, verdict):
    """The generalized method integrates those motions that make the action stationary (theory 1 §6.1)."""
    if verdict["subject"]:
        raise NotCheckable("a complete integral or a separation")
    return stationary(cx, verdict)


@says("refuted")
def by_suslov(cx, verdict):
    """(15): sum theta A = 0 on motions, for some choice of dependent velocities where proved, for none where refuted."""
    import itertools
    system = cx.system
    if system.order != 1 or not system.top:
        raise NotCheckable("no constraints of first order")
    p = system.point(cx.rng)
    v = [[p.value(e) for e in row] for row in system.jacobian]
    r, outcomes = len(system.top), []
    for d in itertools.combinations(range(len(system.q)), r):
        if rank([[row[i] for i in d] for row in v], p.p) == r:
            reduced = Reduced(cx, [x for i, x in enumerate(system.q) if i not in d])
            outcomes.append(cx.vanishes(lambda p: reduced.at(system.move(p))[0])[0])
    wanted = verdict["verdict"] == "proved"
    if any(outcomes) and not all(outcomes):
        return ("confirmed", "for a choice of dependent velocities") if wanted else ("not checkable here", "it depends on the choice")
    return ("confirmed" if any(outcomes) == wanted else "rejected"), f"for {len(outcomes)} choices of dependent velocities: {any(outcomes)}"


CLAIMS = {"hamilton.stationary": stationary, "formulation.vakonomic-coincides": inclusion,
          "hamilton-jacobi.applicable": hamilton_jacobi, "hamilton.stationary-suslov": by_suslov}
