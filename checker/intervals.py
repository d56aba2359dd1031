"""Real values as intervals: integers as ends, in units of 2^-SCALE, rounded outwards."""
from fractions import Fraction
from math import isqrt

from expressions import NODES, NotCheckable, children, reach

SCALE = 192
UNIT = 1 << SCALE
SLACK = 1 << 20  # more than all roundings of a series together


class Uncertain(Exception):
    """An interval is too wide: it contains a pole, the end of a root, or a jump."""


def of_rational(x, y=None):
    x, y = Fraction(x), Fraction(y if y is not None else x)
    return x.numerator * UNIT // x.denominator, -(-y.numerator * UNIT // y.denominator)


def plus(a, b):
    return a[0] + b[0], a[1] + b[1]


def minus(a):
    return -a[1], -a[0]


def times(a, b):
    ends = [x * y for x in a for y in b]
    return min(ends) >> SCALE, -(-max(ends) >> SCALE)


def inverse(a):
    if a[0] <= 0 <= a[1]:
        raise Uncertain("a denominator may vanish")
    ends = [UNIT * UNIT // x for x in a]
    return min(ends) - 1, max(ends) + 1


def root(a):
    if a[0] < 0:
        raise Uncertain("a root of what may be negative")
    return isqrt(a[0] << SCALE), isqrt(a[1] << SCALE) + 1


def monotone(f, a):
    return f(a[0])[0], f(a[1])[1]


def around(x):
    return x - SLACK, x + SLACK


def exponential(x):
    """exp at one point: Taylor's series of a small argument, squared again."""
    halvings = max(x.bit_length() - SCALE + 8, 0)
    small, term, out = x >> halvings, UNIT, 0
    for k in range(1, 60):
        out += term
        term = term * small // (k << SCALE)
    own = around(out)
    for _ in range(halvings):
        own = times(own, own)
    return own


def logarithm(x):
    if x <= 0:
        raise Uncertain("a logarithm of what may not be positive")
    shift = x.bit_length() - SCALE
    m = x >> shift if shift > 0 else x << -shift  # in [1/2, 1)
    two, own = 2 * artanh(UNIT // 3), 2 * artanh((m - UNIT) * UNIT // (m + UNIT))
    return around(own + shift * two)


def artanh(z):
    out, power = 0, z
    for k in range(1, 2 * SCALE, 2):
        out += power // k
        power = (power * z >> SCALE) * z >> SCALE
    return out


def arc(x):
    """atan at one point, after halving the angle five times."""
    for _ in range(5):
        x = x * UNIT // (UNIT + isqrt(UNIT * UNIT + x * x))
    out, power = 0, x
    for k in range(1, SCALE, 2):
        out += power // k if k % 4 == 1 else -(power // k)
        power = (power * x >> SCALE) * x >> SCALE
    return around(out << 5)


def pi():
    low, high = (4 * e for e in arc(UNIT))
    return low, high


def wave(a, shift):
    """sin of an interval (shift 0) or cos (shift 1): the middle by its series, and the radius, since no slope exceeds 1."""
    middle, radius = (a[0] + a[1]) // 2, (a[1] - a[0]) // 2 + 1
    half = sum(pi()) // 4
    turns = round(Fraction(middle, half))
    x, turns = middle - turns * half, turns + shift
    sin = cos = 0
    term = UNIT
    for k in range(0, 80, 2):
        cos += term
        sin += term * x // ((k + 1) << SCALE)
        term = -((term * x >> SCALE) * x) // (((k + 1) * (k + 2)) << SCALE)
    own = (sin, cos, -sin, -cos)[turns % 4]
    spread = radius + SLACK * (abs(turns) + 1)
    return max(own - spread, -UNIT), min(own + spread, UNIT)


def integer_power(a, n):
    out, base, m = of_rational(1), a, abs(n)
    while m:
        out, base, m = times(out, base) if m & 1 else out, times(base, base), m >> 1
    if n % 2 == 0:
        out = max(out[0], 0), out[1]
    return inverse(out) if n < 0 else out


def raised(a, r):
    if r.denominator == 1:
        return integer_power(a, int(r))
    if r.denominator & (r.denominator - 1) == 0:
        for _ in range(r.denominator.bit_length() - 1):
            a = root(a)
        return integer_power(a, r.numerator)
    return monotone(exponential, times(of_rational(r), monotone(logarithm, a)))


def arc2(y, x):
    if x[0] > 0:
        return monotone(arc, times(y, inverse(x)))
    if y[0] > 0:
        return plus(times(pi(), of_rational(Fraction(1, 2))), minus(monotone(arc, times(x, inverse(y)))))
    if y[1] < 0:
        return plus(times(pi(), of_rational(Fraction(-1, 2))), minus(monotone(arc, times(x, inverse(y)))))
    raise Uncertain("an angle at its jump")


def values(roots, of_symbol):
    """Intervals of expressions, where `of_symbol(name, order)` gives those of symbols."""
    memo = {}
    for e in reach(roots):
        key = NODES[e]
        op, args = key[0], [memo[c] for c in children(e)]
        if op == "number":
            memo[e] = of_rational(key[1])
        elif op == "pi":
            memo[e] = pi()
        elif op == "symbol":
            memo[e] = of_symbol(*key[1:])
        elif op == "+":
            memo[e] = plus(*args)
        elif op == "*":
            memo[e] = integer_power(args[0], 2) if key[1] == key[2] else times(*args)
        elif op == "^":
            memo[e] = raised(args[0], key[2])
        elif op in ("sin", "cos"):
            memo[e] = wave(args[0], int(op == "cos"))
        elif op in ("exp", "log"):
            memo[e] = monotone(exponential if op == "exp" else logarithm, args[0])
        elif op == "atan2":
            memo[e] = arc2(*args)
        elif op in ("abs", "sign"):
            if args[0][0] <= 0 <= args[0][1]:
                raise Uncertain("a sign may change")
            sign = of_rational(1 if args[0][0] > 0 else -1)
            memo[e] = sign if op == "sign" else times(sign, args[0])
        else:
            raise NotCheckable(f"the function `{op}`")
    return [memo[e] for e in roots]


def is_not_zero(a):
    return a[0] > 0 or a[1] < 0


def solve(rows, right):
    """Enclosures of the solution of a regular linear system, by elimination with the largest pivot."""
    rows, n = [list(r) + [b] for r, b in zip(rows, right)], len(rows)
    for k in range(n):
        best = max(range(k, n), key=lambda i: min(abs(rows[i][k][0]), abs(rows[i][k][1])) if is_not_zero(rows[i][k]) else -1)
        rows[k], rows[best] = rows[best], rows[k]
        over = inverse(rows[k][k])
        rows[k] = [times(over, x) for x in rows[k]]
        for i in range(n):
            if i != k and rows[i][k] != (0, 0):
                factor = minus(rows[i][k])
                rows[i] = [plus(x, times(factor, y)) for x, y in zip(rows[i], rows[k])]
    return [r[-1] for r in rows]


def text(a):
    return "[{:.6g}, {:.6g}]".format(*(float(Fraction(x, UNIT)) for x in a))
