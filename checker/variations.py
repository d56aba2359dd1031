"""Variations along a curve: random Taylor series, virtual ones fitted to sum f_v dq = 0 order by order (theory 1 §2)."""
from expressions import NotCheckable, gradient, mul, sub, sym, total
from fields import eliminate, solve

N = 3  # coefficients that are compared


class Variation:
    """A curve at a point with the slopes of L and of the constraints, and a virtual displacement along it."""

    def __init__(self, cx, p, curve, virtual=True):
        system, self.p, self.n = cx.system, p, N + 1
        if system.order != 1:
            raise NotCheckable("constraints of higher order")
        curve(p)
        names = [*system.jet(0), *system.jet(1)]
        self.size = len(system.q)
        series = lambda es: p.series(es, self.n)
        self.l_q, self.l_v = series(gradient(system.lagrangian, system.jet(0))), series(system.momenta)
        self.force, self.v = series(system.force), series([sym(x, 1) for x in system.q])
        self.l, self.l_t = series([system.lagrangian])[0], self.clock(cx)
        self.f_q = [series(gradient(f, system.jet(0))) for f in system.top]
        self.f_v = [series(row) for row in system.jacobian]
        self.columns = eliminate([[e[0] for e in row] + [0] for row in self.f_v], p.p)[1] if self.f_v else []
        self.dq = self.random()
        if virtual and self.f_v:
            self.dq = self.fitted(self.f_v, self.dq, [[0] * self.n for _ in self.f_v])
        self.d_dq = [p.rate(x) for x in self.dq]

    def clock(self, cx):
        moving = sub(cx.system.rate(cx.system.lagrangian), total(
            mul(s, sym(x, k + 1)) for k in (0, 1) for x, s in zip(cx.system.q, gradient(cx.system.lagrangian, cx.system.jet(k)))))
        return self.p.series([moving], self.n)[0]

    def random(self):
        return [[self.p.any() for _ in range(self.n)] for _ in range(self.size)]

    def dot(self, a, b):
        out = [0] * self.n
        for x, y in zip(a, b):
            out = [(u + w) % self.p.p for u, w in zip(out, self.p.times(x, y))]
        return out

    def plus(self, *series):
        return [sum(c) % self.p.p for c in zip(*series)]

    def less(self, a, b):
        return [(x - y) % self.p.p for x, y in zip(a, b)]

    def fitted(self, rows, x, right):
        """Changes the components with pivots so that rows x = right, order by order."""
        x, p = [list(s) for s in x], self.p.p
        for k in range(self.n):
            for c in self.columns:
                x[c][k] = 0
            gap = [(r[k] - sum(row[i][j] * x[i][k - j] for i in range(self.size) for j in range(k + 1))) % p for row, r in zip(rows, right)]
            step = solve([[row[c][0] for c in self.columns] for row in rows], gap, p)
            if step is None:
                raise NotCheckable("variations of constraints that follow from each other")
            for c, s in zip(self.columns, step):
                x[c][k] = s
        return x

    def of_constraints(self, dv):
        return [self.plus(self.dot(a, self.dq), self.dot(b, dv)) for a, b in zip(self.f_q, self.f_v)]

    def suslov(self):
        """delta v with delta f = 0: D(dq) for the independent velocities."""
        right = [[-x % self.p.p for x in self.dot(row, self.dq)] for row in self.f_q]
        return self.fitted(self.f_v, self.d_dq, right) if self.f_v else self.d_dq

    def of_lagrangian(self, dv):
        return self.plus(self.dot(self.l_q, self.dq), self.dot(self.l_v, dv))

    def rate(self, x):
        return self.p.rate(x)

    def cut(self, *series):
        return [x for s in series for x in s[:N - 1]]
