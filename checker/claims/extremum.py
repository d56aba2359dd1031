"""`formulation.vakonomic-coincides#system`: the constrained extremum (theory 1 (11)) with random kappa has the accelerations of the motion, or not.

(W + sum kappa f_vv) a + f_v^T kappa' = b + sum kappa (f_q - D_0 f_v),  f_v a = g, where D_0 is the rate without accelerations.
"""
from claims.stationary import inclusion
from expressions import NotCheckable, add, gradient, mul, neg, says, sym, total
from fields import solve


@says("refuted", "conditional")
def coincides(cx, verdict):
    if verdict["subject"] == "inclusion":
        return inclusion(cx, verdict)
    system = cx.system
    if system.order != 1 or verdict["verdict"] == "conditional":
        raise NotCheckable("constraints of higher order, or a condition")
    slip = cx.slip_of_counterexample(verdict) if verdict["verdict"] == "refuted" else None
    if slip:
        return "rejected", slip
    kappa = [sym("kappa_" + c) for c in system.constraint_names]
    bent = total(mul(k, f) for k, f in zip(kappa, system.top))
    slopes = gradient(bent, system.jet(1))
    turned = [add(w, s) for row, g in zip(system.mass_matrix, slopes) for w, s in zip(row, gradient(g, system.jet(1)))]
    push = [total([b, q, neg(system.rate(s, 1))]) for b, q, s in zip(system.right, gradient(bent, system.jet(0)), slopes)]
    n, jacobian = len(system.q), system.jacobian

    def at(p):
        w, f_v = p.values(turned), p.table(jacobian)
        rows = [w[i * n:(i + 1) * n] + [row[i] for row in f_v] for i in range(n)] + [row + [0] * len(f_v) for row in f_v]
        a = solve(rows, [p.value(e) for e in push + system.rest], p.p)
        system.move(p)
        return [1] if a is None else [(x - p.coefficients(q, 2, 1)[0]) % p.p for x, q in zip(a, system.q)]

    holds, why = cx.vanishes(at, [bent])
    return ("confirmed" if holds == (verdict["verdict"] == "proved") else "rejected"), f"for random kappa the accelerations agree: {holds}; {why}"


CLAIMS = {"formulation.vakonomic-coincides": coincides}
