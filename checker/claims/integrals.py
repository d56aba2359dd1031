"""First integrals: G keeps its value on every motion, X G = 0 (theory 3 §6, Theorem A), and energy (theory 1 §5.1).

The rate of G is the second coefficient of its Taylor series along the checker's own motion. That a symmetry belongs to G, and that its
equations of Killing's type and structure equations hold, is the inverse theorem of theory 3 §6: they hold exactly where X G = 0.
"""
import re

from expressions import NotCheckable, Parser, gradient, says


def rate_of(cx, g):
    def at(p):
        return p.series([g], 3)[0][1:] if cx.system.move(p) else []
    return at


def integral(cx, verdict):
    g = cx.formulas(verdict)[0][1]
    holds, why = cx.vanishes(rate_of(cx, g), [g])
    if not holds:
        return "rejected", f"the rate of {verdict['formulas'][0]} is {why}"
    moves, _ = cx.at_point(lambda p: [0 if any(p.value(e) for e in slopes(cx, g)) else 1])
    return ("confirmed", why) if moves else ("rejected", "it is a constant")


def slopes(cx, g):
    names = [("t", 0)] + cx.system.jet(0) + cx.system.jet(1) + [(m, 0) for m in cx.system.masses]
    return gradient(g, names)


def of_integral(cx, verdict):
    """Claims on the symmetry of integral j."""
    own = cx.verdicts.get(f"noether.integral#{verdict['subject']}")
    if own is None or verdict["verdict"] != "proved":
        raise NotCheckable("the integral is not in the record")
    outcome, why = integral(cx, own)
    return outcome, f"by the inverse theorem, since X G = 0: {why}"


@says("refuted", "conditional")
def stated(cx, verdict):
    """`noether.inverse#NAME` of an integral of the model."""
    g = cx.system.integrals.get(verdict["subject"])
    if g is None:
        raise NotCheckable("the integral is stated on a part of the states only")
    if verdict["verdict"] == "proved":
        return cx.identity(rate_of(cx, g), [g])
    if verdict["verdict"] == "refuted":
        return cx.counterexample(verdict, [cx.system.rate(g)], along=2)
    return conditional(cx, verdict, g)


def conditional(cx, verdict, g):
    """It keeps its value where the condition ties parameters, and not elsewhere."""
    ties = re.fullmatch(r"(\w+) = (.+)", verdict["condition"])
    if not ties or ties[1] not in cx.system.parameters or " and " in ties[2] or "," in ties[2]:
        raise NotCheckable("a condition that is no value of a parameter")
    system = cx.system
    value = Parser(ties[2], system.names).read()
    name = ties[1]
    def at(tied):
        def residuals(p):
            if tied:
                p.constants[name] = p.value(value)
            return rate_of(cx, g)(p)
        return residuals
    if name in system.definitions:
        return cx.identity(rate_of(cx, g), [g])
    on, why = cx.vanishes(at(True), [g])
    off, _ = cx.at_point(at(False))
    return ("confirmed", why + ", and not for other values") if on and not off else ("rejected", "the condition is not where it holds")


def family(cx, verdict):
    """Each function listed is an integral, and they are independent; that the family holds no others is not examined."""
    listed = [g for _, g in cx.formulas(verdict)]
    for g in listed:
        if not cx.vanishes(rate_of(cx, g), [g])[0]:
            return "rejected", "a function listed does not keep its value"
    raise NotCheckable("its functions are integrals; that the families hold no others is not examined")


CLAIMS = {"noether.integral": integral, "noether.killing": of_integral, "noether.structure": of_integral,
          "noether.contraction": of_integral, "noether.inverse": stated, "noether.family": family}
