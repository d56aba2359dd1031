"""Series over random prime fields, and linear equations there."""
from fractions import Fraction
from math import lcm

from expressions import NODES, PI, BadPoint, NotCheckable, reach


def is_prime(n):
    if n < 2 or any(n % q == 0 for q in (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)):
        return n in (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37)
    odd, twos = n - 1, 0
    while odd % 2 == 0:
        odd, twos = odd // 2, twos + 1
    for base in (2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37):  # decides below 3e24
        x = pow(base, odd, n)
        if x not in (1, n - 1) and not any((x := x * x % n) == n - 1 for _ in range(twos - 1)):
            return False
    return True


def draw_prime(rng):
    while True:
        q = rng.randrange(2**59, 2**60) // 12 * 12 + 11
        if pow(2, q - 1, q) == 1 and is_prime(2 * q + 1) and is_prime(q):
            return 2 * q + 1


def monomials(e):
    """An expression as a sum of rational multiples of products of powers of what is no sum, product or whole power."""
    out = {}
    for c in reach([e]):
        key = NODES[c]
        if key[0] == "number":
            out[c] = {(): key[1]} if key[1] else {}
        elif key[0] == "+":
            parts = dict(out[key[1]])
            for m, x in out[key[2]].items():
                parts[m] = parts.get(m, 0) + x
            out[c] = {m: x for m, x in parts.items() if x}
        elif key[0] == "*":
            parts = {}
            for m, x in out[key[1]].items():
                for k, y in out[key[2]].items():
                    powers = dict(m)
                    for atom, n in k:
                        powers[atom] = powers.get(atom, 0) + n
                    both = tuple(sorted((a, n) for a, n in powers.items() if n))
                    parts[both] = parts.get(both, 0) + x * y
            out[c] = {m: x for m, x in parts.items() if x}
        elif key[0] == "^" and len(out[key[1]]) == 1 and key[2].denominator == 1:
            (m, x), = out[key[1]].items()
            out[c] = {tuple((a, n * int(key[2])) for a, n in m): x ** int(key[2])}
        else:
            out[c] = {((c, 1),): Fraction(1)}
    return out[e]


# What is known to be positive: nodes with the answer, and symbols (name, order) and nodes by assumption.
POSITIVE, KNOWN_POSITIVE = {}, set()


def is_manifestly_positive(e):
    """Whether an expression is positive for positive parameters, or assumed to be: a sum of squares and of such."""
    if e not in POSITIVE:
        for c in reach([e]):
            if c in POSITIVE:
                continue
            op, *args = NODES[c]
            own = {
                "number": lambda: args[0] > 0, "pi": lambda: True, "exp": lambda: True, "abs": lambda: True,
                "symbol": lambda: tuple(args) in KNOWN_POSITIVE,
                "+": lambda: POSITIVE[args[0]] and POSITIVE[args[1]],
                "*": lambda: args[0] == args[1] or POSITIVE[args[0]] and POSITIVE[args[1]],
                "^": lambda: args[1].denominator % 2 == 0 or args[1].numerator % 2 == 0 or POSITIVE[args[0]],
            }.get(op, lambda: False)
            POSITIVE[c] = c in KNOWN_POSITIVE or own()
    return POSITIVE[e]


DENOMINATORS, SCANNED = {}, [0]


def denominators():
    """For each part of the arguments of sines and cosines the common denominator of its coefficients so far."""
    for e in range(SCANNED[0], len(NODES)):
        if NODES[e][0] in ("sin", "cos"):
            for m, x in monomials(NODES[e][1]).items():
                DENOMINATORS[m] = lcm(DENOMINATORS.get(m, 1), x.denominator)
    SCANNED[0] = len(NODES)
    return DENOMINATORS


class Point:
    """A random prime field, values of constants in it, and curves by their Taylor coefficients."""

    def __init__(self, rng, prime, strict=False):
        self.rng, self.p = rng, prime
        self.q = self.p // 2
        self.constants, self.curves, self.jets = {}, {}, {}
        self.circles, self.exponentials, self.logarithms, self.arcs = {}, {}, {}, {}
        # Whether a sum that is positive as a real number is no square here: roots may then have the other sign.
        self.strict, self.crooked, self.rooted = strict, False, False

    def any(self):
        return self.rng.randrange(2, self.p)

    def positive(self):
        return pow(self.any(), 2, self.p)

    def is_positive(self, x):
        return pow(x, self.q, self.p) == 1

    def inverse(self, x):
        if x % self.p == 0:
            raise BadPoint("a denominator vanishes")
        return pow(x, -1, self.p)

    def rational(self, x):
        return x.numerator * self.inverse(x.denominator) % self.p

    def root_power(self, x, r):
        """x^r, positive, for positive x."""
        self.rooted = True
        if not self.is_positive(x):
            raise BadPoint("a root of what is not positive")
        return pow(x, r.numerator * pow(r.denominator, -1, self.q) % self.q, self.p)

    def coefficients(self, name, order, n):
        """Those of a derivative: from `jets` where they are given one by one, else from the curve; a constant else."""
        if (name, order) in self.jets:
            return (self.jets[name, order] + [0] * n)[:n]
        if name in self.curves:
            own, p = self.curves[name], self.p
            if len(own) < order + n:
                raise NotCheckable(f"derivatives of `{name}` beyond those computed")
            out = []
            for k in range(n):
                factor = 1
                for j in range(k + 1, k + order + 1):
                    factor = factor * j % p
                out.append(own[k + order] * factor % p)
            return out
        if order:
            return [0] * n
        if name not in self.constants:
            self.constants[name] = self.positive()
        return [self.constants[name]] + [0] * (n - 1)

    def times(self, a, b):
        p, n = self.p, len(a)
        if n == 1:
            return [a[0] * b[0] % p]
        return [sum(a[j] * b[k - j] for j in range(k + 1)) % p for k in range(n)]

    def raised(self, x, r):
        """The series x^r by the recurrence of x y' = r x' y."""
        p, n = self.p, len(x)
        if r.denominator == 1 and r > 0:
            y, base, m = None, x, int(r)
            while m:
                if m & 1:
                    y = base if y is None else self.times(y, base)
                base, m = (self.times(base, base), m >> 1) if m > 1 else (base, 0)
            return y
        first = pow(self.inverse(x[0]), -int(r), p) if r.denominator == 1 else self.root_power(x[0], r)
        y, over, r = [first], self.inverse(x[0]), self.rational(r)
        for k in range(1, n):
            s = sum((j * (r + 1) - k) * x[j] * y[k - j] for j in range(1, k + 1)) % p
            y.append(s * over * pow(k, -1, p) % p)
        return y

    def integral(self, first, rate):
        return [first] + [rate[k - 1] * pow(k, -1, self.p) % self.p for k in range(1, len(rate))]

    def rate(self, x):
        return [k * x[k] % self.p for k in range(1, len(x))] + [0]

    def turned(self, point, k):
        """A point of the circle as an angle times a whole number."""
        (c, s), p, out = point, self.p, (1, 0)
        if k < 0:
            s, k = -s, -k
        while k:
            if k & 1:
                out = ((out[0] * c - out[1] * s) % p, (out[0] * s + out[1] * c) % p)
            c, s, k = (c * c - s * s) % p, 2 * c * s % p, k >> 1
        return out

    def circle(self, arg, memo):
        """(cos, sin) of the first coefficient of an argument."""
        p, out = self.p, (1, 0)
        for m, x in monomials(arg).items():
            atom = m[0][0] if len(m) == 1 and m[0][1] == 1 else None
            if atom == PI:
                over = pow(2, -1, p)
                two, three = (self.root_power(k, Fraction(1, 2)) for k in (2, 3))
                twelfth = (two * (three + 1) % p * over * over % p, two * (three - 1) % p * over * over % p)
                own, d = twelfth, 12
            elif atom is not None and NODES[atom][0] == "atan2":
                y, z = (memo[c][0] for c in NODES[atom][1:])
                size = self.inverse(self.root_power((y * y + z * z) % p, Fraction(1, 2)))
                own, d = (z * size % p, y * size % p), 1
            else:
                if m not in self.circles:
                    u = self.any()
                    over = self.inverse(1 + u * u)
                    self.circles[m] = ((1 - u * u) * over % p, 2 * u * over % p), denominators().get(m, 1)
                own, d = self.circles[m]
            if (x * d).denominator != 1:
                raise NotCheckable("an angle divided by an unusual number")
            c, s = self.turned(own, int(x * d))
            out = ((out[0] * c - out[1] * s) % p, (out[0] * s + out[1] * c) % p)
        return out

    def exponential(self, arg):
        out = 1
        for m, x in monomials(arg).items():
            logs = [a for a, k in m if NODES[a][0] == "log"]
            if len(m) == 1 and logs and m[0][1] == 1:
                own = self.series([NODES[logs[0]][1]], 1)[0][0]
            else:
                own = self.exponentials.setdefault(m, self.positive())
            out = out * self.root_power(own, x) % self.p
        return out

    def logarithm(self, e, memo):
        key = NODES[e]
        if key[0] == "*":
            return sum(self.logarithm(c, memo) for c in key[1:]) % self.p
        if key[0] == "^":
            return self.logarithm(key[1], memo) * self.rational(key[2]) % self.p
        if key[0] == "exp":
            return memo[key[1]][0]
        if not self.is_positive(memo[e][0]):
            raise BadPoint("a logarithm of what is not positive")
        return self.logarithms.setdefault(memo[e][0], self.any())

    def series(self, roots, n):
        """The first n Taylor coefficients of expressions along the curves."""
        memo, p = {}, self.p
        for e in reach(roots):
            key = NODES[e]
            op, args = key[0], key[1:]
            if op == "number":
                memo[e] = [self.rational(args[0])] + [0] * (n - 1)
            elif op == "pi":
                memo[e] = self.coefficients(" pi", 0, n)
            elif op == "symbol":
                memo[e] = self.coefficients(*args, n)
            elif op == "+":
                memo[e] = [(x + y) % p for x, y in zip(memo[args[0]], memo[args[1]])]
            elif op == "*":
                memo[e] = self.times(memo[args[0]], memo[args[1]])
            elif op == "^":
                memo[e] = self.raised(memo[args[0]], args[1])
            elif op in ("sin", "cos"):
                c, s = self.circle(args[0], memo)
                cos, sin, x = [c], [s], memo[args[0]]
                for k in range(1, n):
                    over = pow(k, -1, p)
                    cos.append(-sum(j * x[j] * sin[k - j] for j in range(1, k + 1)) * over % p)
                    sin.append(sum(j * x[j] * cos[k - j] for j in range(1, k + 1)) * over % p)
                memo[e] = sin if op == "sin" else cos
            elif op == "exp":
                y, x = [self.exponential(args[0])], memo[args[0]]
                for k in range(1, n):
                    y.append(sum(j * x[j] * y[k - j] for j in range(1, k + 1)) * pow(k, -1, p) % p)
                memo[e] = y
            elif op == "log":
                x = memo[args[0]]
                memo[e] = self.integral(self.logarithm(args[0], memo), self.times(self.rate(x), self.raised(x, Fraction(-1))))
            elif op == "atan2":
                y, x = memo[args[0]], memo[args[1]]
                size = [(a + b) % p for a, b in zip(self.times(x, x), self.times(y, y))]
                turn = [(a - b) % p for a, b in zip(self.times(x, self.rate(y)), self.times(y, self.rate(x)))]
                first = self.arcs.setdefault(y[0] * self.inverse(x[0]) % p, self.any())
                memo[e] = self.integral(first, self.times(turn, self.raised(size, Fraction(-1))))
            elif op in ("abs", "sign"):
                x = memo[args[0]]
                if x[0] == 0:
                    raise BadPoint("a sign at zero")
                self.rooted = True
                sign = 1 if self.is_positive(x[0]) else p - 1
                memo[e] = [sign * c % p for c in x] if op == "abs" else [sign] + [0] * (n - 1)
            else:
                raise NotCheckable(f"the function `{op}`")
            if op in ("+", "sin", "cos") and is_manifestly_positive(e) and not self.is_positive(memo[e][0]):
                self.crooked = True
                if self.strict:
                    raise BadPoint("a positive sum that is no square")
        return [memo[e] for e in roots]

    def values(self, es):
        return [s[0] for s in self.series(es, 1)]

    def table(self, rows):
        """The values of a matrix, all in one pass."""
        flat = iter(self.values([e for row in rows for e in row]))
        return [[next(flat) for _ in row] for row in rows]

    def value(self, *roots):
        values = [s[0] for s in self.series(roots, 1)]
        return values[0] if len(roots) == 1 else values


def eliminate(rows, p):
    """Reduced rows of an augmented matrix, and the columns of the pivots; the last column is the right side."""
    rows, pivots, width = [list(r) for r in rows], [], len(rows[0]) - 1 if rows else 0
    for column in range(width):
        found = next((i for i in range(len(pivots), len(rows)) if rows[i][column] % p), None)
        if found is None:
            continue
        at = len(pivots)
        rows[at], rows[found] = rows[found], rows[at]
        over = pow(rows[at][column], -1, p)
        rows[at] = [x * over % p for x in rows[at]]
        for i, row in enumerate(rows):
            if i != at and row[column]:
                factor = row[column]
                rows[i] = [(x - factor * y) % p for x, y in zip(row, rows[at])]
        pivots.append(column)
    return rows, pivots


def rank(rows, p):
    return len(eliminate([list(r) + [0] for r in rows], p)[1]) if rows else 0


def solve(rows, right, p, free=None):
    """A solution of rows x = right with the unknowns without pivot as `free` gives them; None where there is none."""
    if not rows:
        return list(free or [])
    reduced, pivots = eliminate([list(r) + [b] for r, b in zip(rows, right)], p)
    if any(r[-1] % p for r in reduced[len(pivots):]):
        return None
    width = len(rows[0])
    x = [(free[j] if free else 0) if j not in pivots else 0 for j in range(width)]
    for i, column in enumerate(pivots):
        x[column] = (reduced[i][-1] - sum(reduced[i][j] * x[j] for j in range(width) if j not in pivots)) % p
    return x


def null_space(rows, width, p):
    """A basis of the solutions of rows x = 0."""
    reduced, pivots = eliminate([list(r) + [0] for r in rows], p) if rows else ([], [])
    basis = []
    for j in (j for j in range(width) if j not in pivots):
        x = [0] * width
        x[j] = 1
        for i, column in enumerate(pivots):
            x[column] = -reduced[i][j] % p
        basis.append(x)
    return basis
