"""`variation.hoelder`: delta f by Hoelder's rule, zero for all admissible curves, on motions, or for some displacements (theory 1 §2)."""
from claims.frobenius import curvatures, euler, first_order, nonzero_form, wander
from expressions import gradient, says
from fields import rank


@says("refuted", "conditional")
def hoelder(cx, verdict):
    """delta f by Hoelder's rule: zero for all admissible curves, on motions, or for some displacements only."""
    first_order(cx)
    at, kinds = curvatures(cx)
    everywhere, why = cx.vanishes(at, kinds)
    if verdict["verdict"] == "proved":
        return ("confirmed" if everywhere else "rejected"), why
    if everywhere:
        return "rejected", "it vanishes for all admissible curves"
    along, kinds = curvatures(cx, on_motions=True)
    motions = cx.vanishes(along, kinds)[0]
    if verdict["verdict"] == "conditional" and verdict["condition"] == "on the motions":
        return ("confirmed" if motions else "rejected"), f"on motions: {motions}"
    if verdict["verdict"] == "refuted":
        return ("rejected", "it vanishes on motions") if motions else nonzero_form(cx, verdict, why)
    return displacements(cx, verdict)


def displacements(cx, verdict):
    """The condition on virtual displacements: exactly those for which all sums vanish."""
    system = cx.system
    parts = [system.equation(c.split(" (")[0]) if " (with" in c else system.equation(c) for c in verdict["condition"].split(" and ")]
    deltas = [("delta_" + x, 0) for x in system.q]
    rows = [gradient(e, deltas) for e in parts]
    forms = [euler(system, f) for f in system.top]
    def at(p):
        wander(cx, p)
        jacobian = p.table(system.jacobian)
        own = jacobian + p.table(forms)
        said = jacobian + p.table(rows)
        return [rank(own, p.p) - rank(said, p.p), rank(own, p.p) - rank(own + said, p.p)]
    return cx.identity(at)


CLAIMS = {"variation.hoelder": hoelder}
