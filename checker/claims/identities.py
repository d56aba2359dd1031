"""`formulation.identity`: what holds of equations before any equation of motion is used (theory 1 §6.3, §6.4, §9.5; 2 §4).

Every symbol of the jet is an independent random number here, also where the motion would tie it.
"""
from claims.forms import equivalent
from equations import Form
from expressions import ONE, ZERO, NotCheckable, derive, gradient, mul, neg, num, sub, substitute, sym, symbols, total


def wild(p, es):
    """Random numbers for all derivatives in expressions, each by itself."""
    for s in symbols(es):
        if s[1] > 0 or s[0] not in p.curves and s[0] not in p.constants:
            p.jets[s] = [p.any()]
    return p.values(es)


def form_of(cx, name):
    entry = cx.equations.get(name)
    if entry is None or entry["omitted"]:
        raise NotCheckable(f"the equations of `{name}` are not in the record")
    return Form(cx.system, entry), entry


def without_parts(*forms):
    if any(form.parts for form in forms):
        raise NotCheckable("equations with parts that linear systems determine")


def nielsen(cx, verdict):
    """(52) for m = 1 and 2; a mass with a law of its own is a function of the time here, whose rate is not varied."""
    system, l = cx.system, cx.system.lagrangian
    moves = {*system.q, *system.controls, *system.masses}
    rate = lambda e: derive([e], lambda x, k: ONE if x == "t" else sym(x, k + 1) if x in moves else ZERO)[0]
    first, second = rate(l), rate(rate(l))
    slope = gradient(l, system.jet(0))
    left = [sub(rate(p), q) for p, q in zip(system.momenta, slope)]
    out = [sub(sub(d, mul(num(2), q)), e) for d, q, e in zip(gradient(first, system.jet(1)), slope, left)]
    out += [sub(sub(d, mul(num(3), q)), mul(num(2), e)) for d, q, e in zip(gradient(second, system.jet(2)), slope, left)]
    return cx.identity(lambda p: wild(p, out), out, free=True)


def parametric(cx, verdict):
    """sum x'_a (left - right)_a = 0 for the n + 1 equations."""
    form, _ = form_of(cx, "parametric")
    without_parts(form)
    names = ["w_" + x for x in cx.system.q] + ["w_t"]
    e = total(mul(sym(n), r) for n, r in zip(names, form.stated))
    return cx.identity(lambda p: wild(p, [e]), [e], free=True)


def parametric_canonical(cx, verdict):
    """K keeps its value along the canonical equations, for all multipliers and off the constraints."""
    form, _ = form_of(cx, "parametric-canonical")
    if cx.system.controls or cx.system.masses:
        raise NotCheckable("controls or masses in K")
    n = len(cx.system.q)
    names = [(x, 1) for x in cx.system.q] + [("p_" + x, 1) for x in cx.system.q] + [("p_t", 1)]
    flow = {s: neg(substitute([r], {s: ZERO})[0]) for s, r in zip(names, form.stated)}
    if any(gradient(r, [s])[0] != ONE for s, r in zip(names, form.stated)):
        raise NotCheckable("equations that are not solved for the rates")
    k, flows = form.stated[2 * n + 1], list(flow.values())

    def at(p):
        """K along the flow from a random point of the extended phase space, parts by their linear systems."""
        below = {(a, 0): i for i, (a, _) in enumerate(names)}
        for s in symbols(form.residuals + flows + [k]) - {("t", 0)}:
            if s not in below and s[1] == 0 and s[0] in p.curves or s[1] > 0:
                p.jets[s] = [p.any()]
        start = {s: p.any() for s in below}
        p.jets |= {s: [x] for s, x in start.items()}
        form.solve_parts(p, 1)
        rates = p.values(flows)
        p.jets |= {s: [x, rates[below[s]]] for s, x in start.items()}
        form.solve_parts(p, 2)
        return [p.series([k], 2)[0][1]]

    return cx.identity(at, [k], free=True)


def vector_field(cx, verdict):
    """X | Omega = 0: its components along dq are the equations, that along dt is -v times these, those along dv vanish."""
    return equivalent(cx, {**verdict, "subject": "lagrange-vector-field"})


CLAIMS = {"formulation.identity#nielsen": nielsen, "formulation.identity#parametric": parametric,
          "formulation.identity#parametric-canonical": parametric_canonical,
          "formulation.identity#lagrange-vector-field": vector_field}
