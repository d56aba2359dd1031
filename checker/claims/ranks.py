"""Ranks and regularity of a model (theory 0 §5, 1 §0).

A rank is that of a matrix at a random point: what is regular there is so almost everywhere, and no point exceeds the rank of a matrix
except with the probability of an identity.
"""
from expressions import NotCheckable, add, gradient, mul, says, sym, total
from fields import rank


def regular(matrix, size=None):
    """A claim that a matrix, a function of the system, has full rank at almost every admissible state."""
    @says("refuted")
    def check(cx, verdict):
        rows = matrix(cx.system)
        if not rows:
            return cx.identity(lambda p: [])
        full = lambda p: [] if rank(p.table(rows), p.p) == len(rows) else [1]
        if verdict["verdict"] == "proved":
            return cx.identity(full)
        return cx.identity(lambda p: [0 if full(p) else 1])
    return check


def bordered(system):
    return system.bordered()[0]


def restricted(system):
    """B^T W B for linear constraints, where the Hessian of the restricted Lagrangian equals it (theory 1 (45))."""
    if any(system.order_of(e) for row in system.jacobian for e in row):
        raise NotCheckable("constraints nonlinear in the velocities")
    return system


@says("refuted")
def restricted_regular(cx, verdict):
    system = restricted(cx.system)
    def singular(p):
        basis = system.admissible_basis(p)
        w = p.table(system.mass_matrix)
        n = len(w)
        form = [[sum(a[i] * w[i][j] * b[j] for i in range(n) for j in range(n)) % p.p for b in basis] for a in basis]
        return [0] if rank(form, p.p) == len(basis) else [1]
    if verdict["verdict"] == "proved":
        return cx.identity(singular)
    return cx.identity(lambda p: [1 - singular(p)[0]])


def extremum(system):
    kappas = [sym("kappa_" + l) for l in system.constraint_names]
    functions = [total(mul(k, f) for k, f in zip(kappas, system.top))]
    second = [gradient(s, system.jet(1)) for s in gradient(functions[0], system.jet(1))]
    rows, _ = system.bordered()
    n = len(system.q)
    return [[add(e, second[i][j]) if i < n and j < n else e for j, e in enumerate(row)] for i, row in enumerate(rows)]


@says("refuted")
def independent(cx, verdict):
    system = cx.system
    deficit = lambda p: len(system.all_gradients) - rank(p.table(system.all_gradients), p.p)
    if verdict["verdict"] == "proved":
        return cx.identity(lambda p: [deficit(p)])
    stated = verdict["counterexample"]["residual"][0]
    return cx.identity(lambda p: [deficit(p) - int(stated)])


def frame(cx, verdict):
    """The quasi-velocities, completed by the constraints or by velocities, have a regular matrix; without any the frame is natural."""
    system = cx.system
    quasi = [e for _, e in system.quasi]
    rows = [gradient(e, system.jet(1)) for e in quasi]
    both = lambda p: p.table(rows)
    if len(rows) > len(system.q):
        raise NotCheckable("more quasi-velocities than coordinates")
    return cx.identity(lambda p: [len(rows) - rank(both(p), p.p)] if rows else [])


CLAIMS = {
    "model.hessian-regular": regular(lambda system: system.mass_matrix), "model.constraints-independent": independent,
    "model.accelerations-unique": regular(bordered), "model.restricted-hessian-regular": restricted_regular,
    "model.constrained-extremum-regular": regular(extremum), "model.frame-regular": frame,
}
