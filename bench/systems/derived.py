"""Equations of motion as a tool gets them with no insight: terms by differentiation, the linear solve written out.

    M a = b + J' lambda,  J a = g

`solve` is LDL' without pivoting, as expressions; it needs only + - * /, so that it serves tools that have no matrices.
"""


def zero(x):
    return isinstance(x, (int, float)) and x == 0


def mul(a, b):
    return 0 if zero(a) or zero(b) else a * b


def sub(a, b):
    return a if zero(b) else (-b if zero(a) else a - b)


def add(a, b):
    return a if zero(b) else (b if zero(a) else a + b)


def dot(a, b):
    total = 0
    for x, y in zip(a, b):
        total = add(total, mul(x, y))
    return total


def eliminate(A, columns):
    """Solves A X = columns by Gauss without pivoting; lists of rows. Zeros are left out."""
    n = len(A)
    A = [list(r) for r in A]
    X = [list(r) for r in columns]
    for k in range(n):
        inverse = 1 / A[k][k]
        for i in range(k + 1, n):
            if zero(A[i][k]):
                continue
            f = A[i][k] * inverse
            for j in range(k + 1, n):
                A[i][j] = sub(A[i][j], mul(f, A[k][j]))
            X[i] = [sub(x, mul(f, y)) for x, y in zip(X[i], X[k])]
    for k in reversed(range(n)):
        inverse = 1 / A[k][k]
        for j in range(k + 1, n):
            X[k] = [sub(x, mul(A[k][j], y)) for x, y in zip(X[k], X[j])]
        X[k] = [mul(x, inverse) for x in X[k]]
    return X


def symmetric(A, b):
    """Solves A x = b by LDL' without pivoting."""
    n = len(A)
    L = [[0] * n for _ in range(n)]
    D, x = [0] * n, list(b)
    for j in range(n):
        y = [mul(L[j][k], D[k]) for k in range(j)]
        D[j] = sub(A[j][j], dot(L[j][:j], y))
        inverse = 1 / D[j]
        for i in range(j + 1, n):
            L[i][j] = mul(sub(A[i][j], dot(L[i][:j], y)), inverse)
    for i in range(n):
        x[i] = sub(x[i], dot(L[i][:i], x[:i]))
    x = [mul(x[i], 1 / D[i]) for i in range(n)]
    for i in reversed(range(n)):
        for j in range(i + 1, n):
            x[i] = sub(x[i], mul(L[j][i], x[j]))
    return x


def reduced(system, M, b, J, g):
    """(velocities of the dependent in those of the independent: rows, S, c) and the accelerations S^-1 c of the independent."""
    ind, dep = system.independent, system.dependent
    k = len(ind)
    Jd = [[row[d] for d in dep] for row in J]
    right = [[-row[i] for i in ind] + [r] for row, r in zip(J, g)]
    X = eliminate(Jd, right)
    n = system.size
    B = [[0] * k for _ in range(n)]
    fixed = [0] * n
    for place, i in enumerate(ind):
        B[i][place] = 1
    for place, d in enumerate(dep):
        B[d] = X[place][:k]
        fixed[d] = X[place][k]
    rest = [sub(b[i], dot(M[i], fixed)) for i in range(n)]
    MB = [[dot(M[i], [B[j][c] for j in range(n)]) for c in range(k)] for i in range(n)]
    S = [[dot([B[i][a] for i in range(n)], [MB[i][c] for i in range(n)]) for c in range(k)] for a in range(k)]
    c = [dot([B[i][a] for i in range(n)], rest) for a in range(k)]
    acc = symmetric(S, c)
    full = [add(dot(B[i], acc), fixed[i]) for i in range(n)]
    return B, acc, full


def bordered(system, M, b, J, g):
    """Accelerations by LDL' of the matrix bordered by the constraints."""
    n, r = system.size, len(J)
    K = [list(M[i]) + [J[l][i] for l in range(r)] for i in range(n)]
    K += [[J[l][i] for i in range(n)] + [0] * r for l in range(r)]
    return symmetric(K, list(b) + list(g))[:n]
