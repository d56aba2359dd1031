"""Stationary action and its multipliers kappa (theory 1 §4): on motions, sum kappa E_i[f] - kappa' f_v = lambda f_v with kappa' the rate.

For every motion: the kappa of the record satisfy (12) and (13). On a subset: the same at states on the set that the condition states, and no
kappa exists off it, by the closure of §4.3 (the rows are differentiated along the motion until their rank stays).
"""
import re

from closure import conditions, exists, kappas, move_far
from expressions import NotCheckable, says



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


inclusion = stationary


@says("refuted", "conditional")
def hamilton_jacobi(cx, verdict):
    """The generalized method integrates those motions that make the action stationary (theory 1 §6.1)."""
    if verdict["subject"]:
        raise NotCheckable("a complete integral or a separation")
    return stationary(cx, verdict)


CLAIMS = {"hamilton.stationary": stationary, "hamilton-jacobi.applicable": hamilton_jacobi}
