"""Integrability (theory 3 §3), and what varied curves do to the constraints (theory 1 §2).

Constraints are integrable exactly where sum_i E_i[f] dq^i = 0 for all virtual dq, at all admissible states and for all
accelerations with D f = 0 (A of theory 1 (7) vanishes; theory 3 (11a)).
"""
from expressions import NotCheckable, gradient, sub, symbols, says
from fields import solve


def euler(system, f):
    """E_i[f] = f_q - D f_v."""
    return [sub(s, system.rate(g)) for s, g in zip(gradient(f, system.jet(0)), gradient(f, system.jet(1)))]


def wander(cx, p, length=3):
    """Continues the state as an admissible curve that is no motion: accelerations are random beside D f = 0."""
    system = cx.system
    for x in system.q:
        p.curves[x] = p.curves[x][:2] + [0] * length
    for k in range(length):
        for x in system.q:
            p.curves[x][k + 2] = p.any()
        values = p.series(system.top, k + 2)
        rows = p.table(system.jacobian)
        scale = pow((k + 1) * (k + 2), 1, p.p)
        step = solve(rows, [-(k + 1) * v[k + 1] for v in values], p.p) if rows else [0] * len(system.q)
        if step is None:
            raise NotCheckable("a curve that keeps the constraints was not found")
        for x, s in zip(system.q, step):
            p.curves[x][k + 2] = (p.curves[x][k + 2] + s * pow(scale, -1, p.p)) % p.p
    return p


def curvatures(cx, on_motions=False):
    """sum_i E_i[f] dq^i for a basis of virtual displacements."""
    system = cx.system
    forms = [euler(system, f) for f in system.top]
    def at(p):
        system.move(p) if on_motions else wander(cx, p)
        basis = system.admissible_basis(p)
        return [sum(p.value(e) * d for e, d in zip(form, b)) % p.p for form in forms for b in basis]
    return at, [e for form in forms for e in form]


def first_order(cx):
    if cx.system.order != 1:
        raise NotCheckable("constraints of higher order")


@says("refuted")
def weak(cx, verdict):
    first_order(cx)
    at, kinds = curvatures(cx)
    holds, why = cx.vanishes(at, kinds)
    if verdict["verdict"] == "proved":
        return ("confirmed" if holds else "rejected"), why
    if holds:
        return "rejected", "Frobenius' condition holds at random points"
    return nonzero_form(cx, verdict, why)


def nonzero_form(cx, verdict, why):
    """The counterexample is an admissible state with a residual apart from zero; that no identity holds is known modulo a prime."""
    slip = cx.slip_of_counterexample(verdict, admissible=verdict["subject"] != "strong")
    return ("rejected", slip) if slip else ("confirmed", f"the form is {why}, and the point stated is admissible")


@says("refuted")
def strong(cx, verdict):
    """d Theta(f) ^ Theta(f^1) ^ ... = 0 identically; it fails for every f nonlinear in the velocities, and for affine ones both agree."""
    first_order(cx)
    system = cx.system
    affine = not any(s in system.jet(1) for row in system.jacobian for e in row for s in symbols([e]))
    if not affine:
        if verdict["verdict"] == "proved":
            return "rejected", "a constraint is nonlinear in the velocities"
        return nonzero_form(cx, verdict, "not zero, as a constraint is nonlinear in the velocities")
    return weak(cx, verdict)


def kerner(cx, verdict):
    """The extremals are the motions exactly where affine constraints are integrable."""
    first_order(cx)
    at, kinds = curvatures(cx)
    holds, why = cx.vanishes(at, kinds)
    claimed = "not completely integrable" not in verdict["detail"] and "not integrable" not in verdict["detail"] \
        and "nonholonomic" not in verdict["detail"]
    return ("confirmed" if holds == claimed else "rejected"), f"integrable: {holds} ({why})"


CLAIMS = {"model.constraints-integrable#weak": weak, "model.constraints-integrable#strong": strong, "hamilton.kerner": kerner}
