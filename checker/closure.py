"""Multipliers kappa of the constrained extremum along a motion: those stated, and whether any exist (theory 1 §§4.2, 4.3)."""
from claims.frobenius import euler
from fields import solve
from systems import solve_series


def kappas(cx, verdict):
    """One expression for each constraint; constants `const_NAME` stay free."""
    given = {left: e for left, e in cx.formulas(verdict) if left and left.startswith("kappa_")}
    names = ["kappa_" + c for c in cx.system.constraint_names]
    if len([l for l, _ in cx.formulas(verdict) if l and l.startswith("kappa_")]) != len(given):
        return [None] * len(names)
    return [given.get(n) for n in names]


def conditions(cx, given):
    """(11) along the motion: the coefficients of kappa and kappa' less those of the reaction."""
    system = cx.system
    forms = [euler(system, f) for f in system.top]
    def at(p):
        system.move(p)
        reaction = ["lambda_" + c for c in system.constraint_names]
        series = p.series([e for e in given if e is not None], 2)
        values = iter(series)
        k = [next(values) if e is not None else [0, 0] for e in given]
        e = p.table(forms)
        v = p.table(system.jacobian)
        lam = [p.curves[name][0] if name in p.curves else 0 for name in reaction]
        return [sum(a[0] * x[i] - (a[1] + l) * y[i] for a, x, y, l in zip(k, e, v, lam)) % p.p for i in range(len(system.q))]
    return at, [x for form in forms for x in form]


def exists(cx, p):
    """Whether some kappa satisfies the conditions on the motion through a point: the rows are linear in kappa and kappa', and so are
    their derivatives in the Taylor coefficients of kappa."""
    system = cx.system
    r, n = len(system.top), len(system.q)
    steps = r + 3
    forms = [p.series(euler(system, f), steps) for f in system.top]
    slopes = [p.series(row, steps) for row in system.jacobian]
    lam = [p.curves["lambda_" + c][:steps] for c in system.constraint_names]
    rows, right = [], []
    for i in range(n):
        for k in range(steps):
            row = [0] * (r * (steps + 1))
            for l in range(r):
                for j in range(k + 1):
                    row[l * (steps + 1) + k - j] += forms[l][i][j]
                    row[l * (steps + 1) + k - j + 1] -= slopes[l][i][j] * (k - j + 1)
            rows.append([x % p.p for x in row])
            right.append(sum(slopes[l][i][j] * lam[l][k - j] for l in range(r) for j in range(k + 1)) % p.p)
    return solve(rows, right, p.p) is not None


def move_far(cx, p):
    """The motion with as many coefficients as the closure needs: a rank that grows does so within r steps."""
    steps = len(cx.system.top) + 3
    cx.system.move(p, steps + 4)
    rows, right = cx.system.bordered()
    size = len(rows)
    values = p.series([e for row in rows for e in row] + right, steps + 1)
    x = solve_series([values[i * size:(i + 1) * size] for i in range(size)], values[size * size:], steps + 1, p.p)
    for l, name in enumerate(cx.system.constraint_names):
        p.curves["lambda_" + name] = x[len(cx.system.q) + l]
    return p
