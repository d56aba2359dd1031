"""Claims `model.*`: ranks, regularity, and what L, the forces and the constraints contain (theory 1 §0, 0 §5).

A rank is that of a matrix at a random point: what is regular there is so almost everywhere, and no point exceeds the rank of a matrix
except with the probability of an identity.
"""
from expressions import NotCheckable, ZERO, add, gradient, mul, neg, num, says, sub, substitute, sym, symbols, total
from fields import null_space, rank


def regular(matrix, size=None):
    """A claim that a matrix, a function of the system, has full rank at almost every admissible state."""
    @says("refuted")
    def check(cx, verdict):
        rows = matrix(cx.system)
        if not rows:
            return cx.identity(lambda p: [])
        full = lambda p: [] if rank([[p.value(e) for e in row] for row in rows], p.p) == len(rows) else [1]
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
        w = [[p.value(e) for e in row] for row in system.mass_matrix]
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


def polynomial(test, points=lambda system: system.jet(1)):
    """A claim that expressions made of the system vanish identically, without regard to the constraints."""
    @says("refuted")
    def check(cx, verdict):
        es = test(cx.system, verdict)
        if verdict["verdict"] == "proved":
            return cx.identity(lambda p: p.series(es, 1) and [x[0] for x in p.series(es, 1)] if es else [], es, free=True)
        return cx.counterexample(verdict, es, admissible=False)
    return check


def top_jet(system):
    return system.jet(system.order)


def linear(system, _):
    """f(v) + f(w) - 2 f((v + w)/2), which is zero for all v, w exactly where f is affine along every line."""
    names = top_jet(system)
    other = {s: sym("w_" + s[0], s[1]) for s in names}
    middle = {s: mul(num("1/2"), add(sym(*s), other[s])) for s in names}
    return [total([f, g, mul(num(-2), h)]) for f, g, h in
            zip(system.top, substitute(system.top, other), substitute(system.top, middle))]


@says("refuted")
def linear_check(cx, verdict):
    names = top_jet(cx.system)
    if verdict["verdict"] == "proved":
        es = [e for row in cx.system.jacobian for e in row]
        bad = [s for e in es for s in symbols([e]) if s in names]
        slopes = [g for e in es for g in gradient(e, names)] if bad else []
        return cx.identity(lambda p: [p.value(e) for e in slopes], slopes, free=True)
    return cx.counterexample(verdict, linear(cx.system, verdict), admissible=False)


def homogeneous(system, verdict):
    """sum v f_v - k f for the degrees stated; where none are, those that a point allows are not asked for."""
    import re
    degrees = dict((name, k) for k, name in re.findall(r"degree (-?\d+(?:/\d+)?) for `([^`]+)`", verdict["detail"]))
    one = re.search(r"Σ v ∂f/∂v − (-?\d+) f of `([^`]+)`", verdict["detail"])
    out = []
    for name, f in zip(system.constraint_names, system.top):
        k = degrees.get(name, one.group(1) if one and one.group(2) == name else "1")
        euler = total(mul(sym(x, 1), s) for x, s in zip(system.q, gradient(f, system.jet(1))))
        if verdict["verdict"] == "proved" or (one and one.group(2) == name):
            out.append(sub(euler, mul(num(k), f)))
    return out


@says("refuted")
def homogeneous_check(cx, verdict):
    es = homogeneous(cx.system, verdict)
    if verdict["verdict"] == "proved":
        return cx.identity(lambda p: [p.value(e) for e in es], es, free=True)
    return cx.counterexample(verdict, es, admissible=False)


def times(system, _):
    moving = [("t", 0)] + [(u, 0) for u in system.controls]
    return [e for f in system.stated for e in gradient(f, moving)]


def even(system, _):
    turned = substitute([system.lagrangian], {(x, 1): neg(sym(x, 1)) for x in system.q})[0]
    return [sub(system.lagrangian, turned)]


def autonomous(system, _):
    moving = [("t", 0)] + [(u, k) for u in system.controls for k in (0, 1)] + [(m, 0) for m in system.masses]
    return gradient(system.lagrangian, moving)


def third(system, _):
    return [e for row in system.mass_matrix for w in row for e in gradient(w, system.jet(1))]


@says("refuted")
def quadratic_check(cx, verdict):
    es = third(cx.system, verdict)
    if verdict["verdict"] == "proved":
        return cx.identity(lambda p: [p.value(e) for e in es], es, free=True)
    system = cx.system
    other = {s: sym("w_" + s[0], 1) for s in system.jet(1)}
    step = [sub(sym(*s), other[s]) for s in system.jet(1)]
    momenta = substitute(system.momenta, other)
    second = [substitute(row, other) for row in system.mass_matrix]
    rest = [sub(system.lagrangian, substitute([system.lagrangian], other)[0])]
    rest += [neg(mul(p, d)) for p, d in zip(momenta, step)]
    rest += [mul(num("-1/2"), mul(mul(a, b), w)) for a, row in zip(step, second) for b, w in zip(step, row)]
    return cx.counterexample(verdict, [total(rest)], admissible=False)


@says("refuted")
def chaplygin(cx, verdict):
    """Coordinates that neither L nor a constraint contains, as many as constraints and with velocities that these determine."""
    system = cx.system
    if verdict["verdict"] != "proved":
        return cx.counterexample(verdict, [e for f in system.top + [system.lagrangian] for e in gradient(f, system.jet(0))])
    slopes = {x: [gradient(f, [(x, 0)])[0] for f in system.top + [system.lagrangian]] for x in system.q}
    def at(p):
        absent = [i for i, x in enumerate(system.q) if all(p.value(e) == 0 for e in slopes[x])]
        rows = [[p.value(e) for e in row] for row in system.jacobian]
        r = rank(rows, p.p)
        return [] if rank([[row[i] for i in absent] for row in rows], p.p) == r else [1]
    return cx.identity(at)


@says("refuted")
def first_order(cx, verdict):
    holds = cx.system.order == 1
    return ("confirmed" if holds == (verdict["verdict"] == "proved") else "rejected"), f"the highest order is {cx.system.order}"


@says("refuted")
def independent(cx, verdict):
    system = cx.system
    deficit = lambda p: len(system.top) - rank([[p.value(e) for e in row] for row in system.jacobian], p.p)
    if verdict["verdict"] == "proved":
        return cx.identity(lambda p: [deficit(p)])
    stated = verdict["counterexample"]["residual"][0]
    return cx.identity(lambda p: [deficit(p) - int(stated)])


def frame(cx, verdict):
    """The quasi-velocities, completed by the constraints or by velocities, have a regular matrix; without any the frame is natural."""
    system = cx.system
    quasi = [e for _, e in system.quasi]
    rows = [gradient(e, system.jet(1)) for e in quasi]
    both = lambda p: [[p.value(e) for e in row] for row in rows]
    if len(rows) > len(system.q):
        raise NotCheckable("more quasi-velocities than coordinates")
    return cx.identity(lambda p: [len(rows) - rank(both(p), p.p)] if rows else [])


def rank_is_full(cx):
    p = cx.system.point(cx.rng)
    return rank([[p.value(e) for e in row] for row in cx.system.jacobian], p.p) == len(cx.system.top)


def reduced(cx, verdict):
    """With redundant constraints: W is regular on the admissible directions."""
    system = cx.system
    def at(p):
        basis = system.admissible_basis(p)
        w = [[p.value(e) for e in row] for row in system.mass_matrix]
        form = [[sum(x * y * z for x, row in zip(a, w) for y, z in zip(row, b)) % p.p for b in basis] for a in basis]
        return [] if rank(form, p.p) == len(basis) else [1]
    return cx.identity(at)


def unique(cx, verdict):
    return regular(bordered)(cx, verdict) if rank_is_full(cx) else reduced(cx, verdict)


CLAIMS = {
    "model.hessian-regular": regular(lambda system: system.mass_matrix), "model.constraints-independent": independent,
    "model.accelerations-unique": unique,
    "model.restricted-hessian-regular": restricted_regular, "model.constrained-extremum-regular": regular(extremum),
    "model.constraints-linear": linear_check, "model.constraints-homogeneous": homogeneous_check,
    "model.constraints-scleronomic": polynomial(times), "model.lagrangian-even": polynomial(even),
    "model.lagrangian-autonomous": polynomial(autonomous), "model.lagrangian-quadratic": quadratic_check,
    "model.forces-absent": polynomial(lambda system, _: system.force), "model.chaplygin": chaplygin,
    "model.constraints-first-order": first_order, "model.frame-regular": frame,
}
