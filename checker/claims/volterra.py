"""`formulation.identity#volterra-...`: Volterra's left sides are Maggi's before any equation of motion is used (theory 2 §4)."""
from claims.identities import form_of, wild, without_parts
from expressions import ONE, ZERO, NotCheckable, add, derive, gradient, mul, sub, substitute, sym, total


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


PAIRS = [(o, c) for o in ("first", "second") for c in ("", "-cartesian")]
CLAIMS = {f"formulation.identity#volterra-{o}{c}": volterra for o, c in PAIRS}
CLAIMS |= {f"formulation.identity#volterra-{o}{c}-special": on_characteristics for o, c in PAIRS}
