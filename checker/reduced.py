"""Chaplygin's reduction at a state: theta A_s, the momenta P_s of the reduced kinetic energy and v_s (theory 1 §6.2, (7))."""
from claims.frobenius import euler
from expressions import NotCheckable
from fields import solve


class Reduced:
    """theta A_s, P_s and v_s at a state, for independent coordinates whose complement the constraints determine."""

    def __init__(self, cx, independent):
        self.system, self.s = cx.system, [cx.system.q.index(x) for x in independent]
        self.d = [i for i in range(len(cx.system.q)) if i not in self.s]
        self.forms = [euler(cx.system, f) for f in cx.system.top]

    def at(self, p):
        """Needs accelerations with D f = 0, which linear A does not contain: any do."""
        system, q = self.system, p.p
        v = p.table(system.jacobian)
        e = p.table(self.forms)
        momenta = p.values(system.momenta)
        basis = []
        for s in self.s:
            column = solve([[row[d] for d in self.d] for row in v], [-row[s] for row in v], q)
            if column is None:
                raise NotCheckable("velocities that the constraints do not determine")
            b = [0] * len(system.q)
            b[s] = 1
            for d, x in zip(self.d, column):
                b[d] = x
            basis.append(b)
        # theta^T f_d^{-1}: the row t with t f_d = theta.
        t = solve([[row[d] for row in v] for d in self.d], [momenta[d] for d in self.d], q)
        bent = [sum(c * sum(x * y for x, y in zip(form, b)) for c, form in zip(t, e)) % q for b in basis]
        push = [sum(x * y for x, y in zip(momenta, b)) % q for b in basis]
        return bent, push, [p.curves[system.q[s]][1] for s in self.s]
