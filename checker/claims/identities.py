"""`formulation.identity`: what holds of equations before any equation of motion is used (theory 1 §6.3, §6.4, §9.5; 2 §4).

Every symbol of the jet is an independent random number here, also where the motion would tie it.
"""
from claims.forms import Form, equation, equivalent
from expressions import ONE, ZERO, NotCheckable, add, derive, gradient, mul, neg, num, sub, substitute, sym, symbols, total


def wild(p, es):
    """Random numbers for all derivatives in expressions, each by itself."""
    for s in symbols(es):
        if s[1] > 0 or s[0] not in p.curves and s[0] not in p.constants:
            p.jets[s] = [p.any()]
    return [p.value(e) for e in es]


def form_of(cx, name):
    entry = cx.equations.get(name)
    if entry is None or entry["omitted"]:
        raise NotCheckable(f"the equations of `{name}` are not in the record")
    return Form(cx.system, entry), entry


def without_parts(*forms):
    if any(form.parts for form in forms):
        raise NotCheckable("equations with parts that linear systems determine")


def volterra(cx, verdict):
    """Volterra's left sides minus forces are Maggi's, equation by equation."""
    name = verdict["subject"]
    own, entry = form_of(cx, name)
    maggi, other = form_of(cx, "maggi")
    without_parts(own, maggi)
    if cx.system.order != 1 or [s for s in entry["state"]] != [s for s in other["state"]]:
        raise NotCheckable("constraints of higher order, or equations in different variables")
    k = min(len(entry["state"]), len(own.stated))
    difference = [sub(a, b) for a, b in zip(own.stated[:k], maggi.stated[:k])]
    return cx.identity(lambda p: wild(p, difference), difference, free=True)


def on_characteristics(cx, verdict):
    """The lemmas between the forms for m = 1, with v = phi(q, P, t) as Maggi's equations in the record have it; L stands for T."""
    system = cx.system
    if system.order != 1:
        raise NotCheckable("constraints of higher order")
    form, entry = form_of(cx, "maggi")
    without_parts(form)
    parameters, phi = list(form.state), form.velocities
    put = {(x, 1): e for x, e in zip(system.q, phi)}
    def rate(e):
        def of(name, order):
            if (name, order) in form.state:
                return sym(name, order + 1)
            if order == 0 and name in system.q:
                return phi[system.q.index(name)]
            if name in system.mass_rates and order == 0:
                return substitute([system.mass_rates[name]], put)[0]
            return ONE if name == "t" else sym(name, order + 1) if name in system.controls else ZERO
        return derive([e], of)[0]
    restricted = substitute([system.lagrangian], put)[0]
    p = substitute(system.momenta, put)
    slope = substitute(gradient(system.lagrangian, system.jet(0)), put)
    b = [gradient(e, parameters) for e in phi]
    pi = lambda e, s: total(mul(row[s], d) for row, d in zip(b, gradient(e, system.jet(0))))
    out = []
    for s, own in enumerate(parameters):
        column = [row[s] for row in b]
        dot = lambda u: total(mul(x, y) for x, y in zip(u, column))
        left = dot([sub(rate(x), y) for x, y in zip(p, slope)])
        push = gradient(restricted, [own])[0]
        turned = total(mul(x, rate(c)) for x, c in zip(p, column))
        out.append(sub(push, dot(p)))
        out.append(sub(left, sub(sub(rate(push), turned), dot(slope))))
        out.append(sub(pi(restricted, s), add(total(mul(x, pi(e, s)) for x, e in zip(p, phi)), dot(slope))))
    return cx.identity(lambda point: wild(point, out), out, free=True)


def nielsen(cx, verdict):
    """(52) for m = 1 and 2."""
    system, l = cx.system, cx.system.lagrangian
    first, second = system.rate(l), system.rate(system.rate(l))
    slope = gradient(l, system.jet(0))
    left = [sub(system.rate(p), q) for p, q in zip(system.momenta, slope)]
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
        rates = [p.value(e) for e in flows]
        p.jets |= {s: [x, rates[below[s]]] for s, x in start.items()}
        form.solve_parts(p, 2)
        return [p.series([k], 2)[0][1]]

    return cx.identity(at, [k], free=True)


def vector_field(cx, verdict):
    """X | Omega = 0: its components along dq are the equations, that along dt is -v times these, those along dv vanish."""
    return equivalent(cx, {**verdict, "subject": "lagrange-vector-field"})


CLAIMS = {f"formulation.identity#volterra-{o}{c}": volterra for o in ("first", "second") for c in ("", "-cartesian")}
CLAIMS |= {f"formulation.identity#volterra-{o}{c}-special": on_characteristics for o in ("first", "second") for c in ("", "-cartesian")}
CLAIMS |= {"formulation.identity#nielsen": nielsen, "formulation.identity#parametric": parametric,
           "formulation.identity#parametric-canonical": parametric_canonical,
           "formulation.identity#lagrange-vector-field": vector_field}
