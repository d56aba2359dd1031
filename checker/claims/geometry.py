"""Cartan forms, frames, what distributions generate, and the embedding (theory 3 §§1, 2, 5)."""
import re

from expressions import NotCheckable, gradient, mul, neg, sub, sym, symbols, total
from fields import eliminate, rank


def cartan(cx, verdict):
    """Theta(F) = F dt + F_v (dq - v dt): what is not zero of its coefficients of dt and dq stands in the record."""
    system, name = cx.system, verdict["subject"]
    f = system.lagrangian if name == "L" else system.all_tops[system.all_names.index(name)]
    slopes = gradient(f, system.jet(1))
    own = [sub(f, total(mul(sym(x, 1), s) for x, s in zip(system.q, slopes)))] + slopes
    given = [e for _, e in cx.formulas(verdict)]
    def at(p):
        values = [x for x in (p.value(e) for e in own) if x]
        said = [x for x in (p.value(e) for e in given) if x]
        # The coefficient of dt may be left out of the record as too long.
        values = values[1:] if len(said) == len(values) - 1 and p.value(own[0]) else values
        return [1] if len(values) != len(said) else [(y - x) % p.p for y, x in zip(said, values)]
    return cx.identity(at, given, free=True)


def embedded(cx, verdict):
    """Lemma 2 of theory 3 §5: the rank is 2 k exactly where W is regular on the virtual displacements; 2 k and 2 k + 1 are said."""
    system = cx.system
    said = re.search(r"rank of Ω̄ is (\d+) of (\d+)", verdict["detail"])
    if not said or system.order != 1:
        raise NotCheckable("no rank is stated")
    def at(p):
        basis = system.admissible_basis(p)
        w = p.table(system.mass_matrix)
        form = [[sum(x * y * z for x, row in zip(a, w) for y, z in zip(row, b)) % p.p for b in basis] for a in basis]
        k = len(basis)
        return [k - rank(form, p.p), 2 * k - int(said[1]), 2 * k + 1 - int(said[2])]
    return cx.identity(at)


def growth(cx, verdict):
    """Ranks of the admissible directions with their brackets, step by step, for constraints linear in the velocities."""
    system = cx.system
    said = re.search(r"growth vector is \(([\d, ]+)\)", verdict["detail"])
    es = [e for row in system.jacobian for e in row]
    if said and "as the model states" in verdict["detail"]:
        raise NotCheckable("a growth vector that depends on the parameters")
    if not said or any(system.order_of(e) for e in es) or system.controls or ("t", 0) in symbols(es):
        raise NotCheckable("constraints that are not linear and scleronomic, or no growth vector is stated")
    wanted = [int(x) for x in said[1].split(",")]
    p0 = system.point(cx.rng)
    pivots = eliminate([p0.values(row) + [0] for row in system.jacobian], p0.p)[1]
    n = len(system.q)
    if len(pivots) != len(system.top) or len(pivots) > 3:
        raise NotCheckable("constraints that follow from each other, or more than three")
    basis = cramer(system.jacobian, pivots, n)
    steps = [basis]
    ranks = []
    names = system.jet(0)
    while len(ranks) < len(wanted):
        es = [e for step in steps for x in step for e in x]
        def at(p, flat=es):
            values = p.values(flat)
            return rank([values[i:i + n] for i in range(0, len(values), n)], p.p)
        ranks.append(at(system.point(cx.rng)))
        if len(ranks) < len(wanted):
            new = []
            for x in basis:
                for y in steps[-1]:
                    new.append([total(sub(mul(a, dy), mul(b, dx)) for a, b, dy, dx in
                                      zip(x, y, gradient(y[i], names), gradient(x[i], names))) for i in range(n)])
            steps.append(new)
            if sum(len(s) for s in steps) > 60:
                raise NotCheckable("too many brackets")
    return ("confirmed" if ranks == wanted else "rejected"), f"the ranks are {ranks} at random points"


def cramer(rows, pivots, n):
    """A basis of the solutions of rows x = 0, multiplied by the determinant of the pivot columns."""
    def det(m):
        return m[0][0] if len(m) == 1 else total(
            mul(neg(m[0][j]) if j % 2 else m[0][j], det([r[:j] + r[j + 1:] for r in m[1:]])) for j in range(len(m)))
    square = [[row[c] for c in pivots] for row in rows]
    d = det(square) if rows else sym(" one")
    basis = []
    for j in (j for j in range(n) if j not in pivots):
        x = [sub(d, d)] * n
        x[j] = d
        for k, c in enumerate(pivots):
            replaced = [[neg(row[j]) if i == k else e for i, e in enumerate(r)] for r, row in zip(square, rows)]
            x[c] = det(replaced)
        basis.append(x)
    return basis


CLAIMS = {"cartan.form": cartan, "noether.embedded": embedded, "distribution.growth": growth}
