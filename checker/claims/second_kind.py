"""Principles of the second kind (theory 1 §7): q(t) and v(t) are curves of their own, varied independently."""
from expressions import gradient, substitute, sym
from fields import rank


def second_kind(cx, verdict):
    """The pointwise identity behind (34) = dZ + Q dq - D(L_v dq) for curves q(t) and v(t) of their own; and W regular, so that Dq = v."""
    system = cx.system
    other = {(x, 1): ("u_" + x) for x in system.q}
    put = {s: sym(n) for s, n in other.items()}
    l_q, l_v, force = (substitute(es, put) for es in (gradient(system.lagrangian, system.jet(0)), system.momenta, system.force))
    names = [*system.jet(0), *((n, 0) for n in other.values())]
    second = [gradient(e, names) for e in l_v]
    w_matrix = [row[len(system.q):] for row in second]
    def at(p):
        for x in system.q:
            p.curves[x] = [*p.curves[x][:1], *(p.any() for _ in range(4))]
            p.curves["u_" + x] = [p.curves[x][1], *(p.any() for _ in range(4))]
        for m in system.masses:
            p.curves[m] = [*p.curves[m][:1], *(p.any() for _ in range(4))]
        n, size = 3, len(system.q)
        draw = lambda: [[p.any() for _ in range(n)] for _ in range(size)]
        dq, dv = draw(), draw()
        add_ = lambda *s: [sum(c) % p.p for c in zip(*s)]
        dot = lambda a, b: add_([0] * n, *(p.times(x, y) for x, y in zip(a, b)))
        minus = lambda a: [-x % p.p for x in a]
        a, b, q = p.series(l_q, n), p.series(l_v, n), p.series(force, n)
        gap = [add_(p.coefficients(x, 1, n), minus(p.coefficients("u_" + x, 0, n))) for x in system.q]
        d_lv = [add_(*(p.times(s, y) for s, y in zip(p.series(row, n), dq + dv))) for row in second]
        left = add_(dot([add_(x, y, minus(p.rate(z))) for x, y, z in zip(a, q, b)], dq), dot(gap, d_lv))
        d_z = add_(dot(a, dq), dot(b, dv), dot([add_(p.rate(x), minus(y)) for x, y in zip(dq, dv)], b), dot(gap, d_lv))
        right = add_(d_z, dot(q, dq), minus(p.rate(dot(b, dq))))
        regular = rank(p.table(w_matrix), p.p) == size
        return add_(left, minus(right))[:n - 1] + [0 if regular else 1]
    return cx.identity(at, [system.lagrangian], free=True)


CLAIMS = {"second-kind.identity": second_kind, "second-kind.differential": second_kind, "second-kind.integral": second_kind,
          "second-kind.canonical": second_kind, "formulation.identity#state-space": second_kind}
