"""The system of a record (`model.flat`), points of its constraints, and its motions as series: theory 1, equations (1), (2)."""
import re
import tomllib

from expressions import (NODES, ONE, PI, ZERO, BadPoint, NotCheckable, Parser, add, derive, fn, gradient, mul, neg, num, sub, substitute,
                         sym, symbols, total)
from fields import KNOWN_POSITIVE, POSITIVE, Point, draw_prime, null_space, rank, solve

LENGTH, LONGEST = 6, 20  # Taylor coefficients of a coordinate along a motion, and of the time and of controls


class System:
    """Coordinates, L, Q and constraints, with what follows of them by differentiation."""

    def __init__(self, text):
        data = tomllib.loads(text)
        self.q = data["coordinates"]
        self.parameters = data.get("parameters", {})
        self.controls = data.get("controls", {})
        self.masses = data.get("masses", {})
        self.names = {}
        self.quasi = []
        self.parameter_values()
        for name, value in data.get("define", {}).items():
            self.names[name] = self.read(value)
        for name, value in data.get("quasi_velocities", {}).items():
            self.quasi.append((name, self.read(value)))
        self.mass_rates = {name: self.read(law["rate"]) for name, law in self.masses.items()}
        self.lagrangian = self.read(data["lagrangian"]["L"])
        forces, reactive = data.get("forces", {}), data.get("reactive_forces", {})
        self.force = [add(self.read(forces.get(x, "0")), self.read(reactive.get(x, "0"))) for x in self.q]
        self.constraint_names = list(data.get("constraints", {}))
        self.stated = [self.equation(f) for f in data.get("constraints", {}).values()]
        self.equations = data.get("equations", {})
        shared = set(data.get("define", {}))
        self.constraint_texts = [f for f in data.get("constraints", {}).values() if not any(w in f for w in shared)]
        # Definitions of the text stand for parts of it alone; quasi-velocities stand in formulas of the record too.
        for name in data.get("define", {}):
            del self.names[name]
        self.names.update(self.quasi)
        self.integrals = {name: self.read(value, data.get("define")) for name, value in data.get("integrals", {}).items()}
        self.assumptions = data.get("assumptions", [])
        self.assume()
        self.derive_terms()

    def assume(self):
        """What is positive by assumption: parameters, differences, sines of angles in (0, pi), cosines of those in (-pi/2, pi/2)."""
        POSITIVE.clear()
        KNOWN_POSITIVE.clear()
        KNOWN_POSITIVE.update((x, 0) for x in self.parameters if x not in self.names and x not in self.definitions)
        bounds = {}
        for text in self.assumptions:
            left, sign, right = re.split(r" (<=|<|!=) ", text)
            if sign == "!=":
                continue
            a, b = self.read(left), self.read(right)
            KNOWN_POSITIVE.update([sub(b, a), NODES[b][1:] if NODES[b][0] == "symbol" and a == ZERO else sub(b, a)])
            bounds.setdefault(b, [None, None])[0] = a
            bounds.setdefault(a, [None, None])[1] = b
        half = mul(num("1/2"), PI)
        for x, (low, high) in bounds.items():
            if low == ZERO and high in (PI, half):
                KNOWN_POSITIVE.add(fn("sin", x))
            if low in (neg(half), ZERO) and high == half:
                KNOWN_POSITIVE.add(fn("cos", x))

    def parameter_values(self):
        """Parameters stated to be zero are zero, those defined by others follow them; all others are general."""
        self.stated_values, self.definitions = {}, {}
        for name, entry in self.parameters.items():
            if "value" in entry:
                value = Parser(entry["value"]).read()
                if value == ZERO:
                    self.names[name] = value
                elif symbols([value]):
                    self.definitions[name] = value
                else:
                    self.stated_values[name] = value
        for _ in self.definitions:
            table = {(n, 0): e for n, e in [*self.definitions.items(), *self.names.items()]}
            self.definitions = {n: substitute([e], table)[0] for n, e in self.definitions.items()}

    def read(self, text, define=None):
        names = dict(self.names)
        for name, value in (define or {}).items():
            names[name] = Parser(value, names, self.rate).read()
        return Parser(text, names, self.rate).read()

    def equation(self, text, define=None):
        left, right = text.split("=", 1)
        return sub(self.read(left, define), self.read(right, define))

    def rate(self, e, frozen=99):
        """The total derivative; derivatives of coordinates of order `frozen` and more are held."""
        def of(name, order):
            if name == "t":
                return ONE
            if name in self.q:
                return sym(name, order + 1) if order < frozen else ZERO
            if name in self.mass_rates and order == 0:
                return self.mass_rates[name]
            return sym(name, order + 1) if name in self.controls else ZERO
        return derive([e], of)[0]

    def order_of(self, e):
        return max((order for name, order in symbols([e]) if name in self.q), default=0)

    def jet(self, order):
        return [(x, order) for x in self.q]

    def derive_terms(self):
        """W, b, and per constraint its function of the highest order with the gradient and what is left."""
        self.momenta = gradient(self.lagrangian, self.jet(1))
        self.mass_matrix = [gradient(p, self.jet(1)) for p in self.momenta]
        slopes = gradient(self.lagrangian, self.jet(0))
        self.right = [total([s, f, neg(self.rate(p, 1))]) for s, f, p in zip(slopes, self.force, self.momenta)]
        self.orders = [self.order_of(f) for f in self.stated]
        self.order = max([1] + self.orders)
        self.holonomic = [f for f, m in zip(self.stated, self.orders) if m == 0]
        self.lower, self.top = [], []
        for f, m in zip(self.stated, self.orders):
            while m < self.order:
                self.lower.append((m, f))
                f, m = self.rate(f), m + 1
            self.top.append(f)
        # Of order one f itself is a condition on the state, and its rate on the accelerations.
        if self.order == 1:
            self.lower += [(1, f) for f in self.top]
        self.jacobian = [gradient(f, self.jet(self.order)) for f in self.top]
        if self.order == 1:
            self.rest = [neg(self.rate(f, 1)) for f in self.top]
        elif self.order == 2 and all(self.order_of(e) < 2 for row in self.jacobian for e in row):
            at_rest = {s: ZERO for s in self.jet(2)}
            self.rest = [neg(f) for f in substitute(self.top, at_rest)]
        else:
            self.rest = None

    def leave_out_redundant(self, rng):
        """Constraints whose gradients depend on those of earlier ones are left to the conditions on points; says whether there are any."""
        self.all_gradients, self.all_tops, self.all_names = self.jacobian, self.top, self.constraint_names
        self.is_reduced = False
        if self.rest is None:
            return
        p = self.point(rng)
        kept = []
        for l in range(len(self.jacobian)):
            rows = [[p.value(e) for e in self.jacobian[k]] for k in [*kept, l]]
            if rank(rows, p.p) == len(rows):
                kept.append(l)
        self.is_reduced = len(kept) < len(self.jacobian)
        if self.is_reduced:
            pick = lambda items: [items[l] for l in kept] if items is not None else None
            self.top, self.jacobian, self.rest = pick(self.top), pick(self.jacobian), pick(self.rest)
            self.constraint_names = pick(self.constraint_names)

    def bordered(self):
        """The rows of W a - J^T lambda = b, J a = g, and the right side."""
        if self.rest is None:
            raise NotCheckable("constraints of third order, or nonlinear in the accelerations")
        columns = [[neg(row[i]) for row in self.jacobian] for i in range(len(self.q))]
        rows = [w + c for w, c in zip(self.mass_matrix, columns)]
        rows += [row + [ZERO] * len(self.top) for row in self.jacobian]
        return rows, self.right + self.rest

    # --- points and motions
    def point(self, rng, stated=False, on=(), free=False, strict=False):
        """A random admissible state; `stated` takes the parameters of the model, `on` adds conditions on the state, `free` forgets
        the constraints."""
        for k in range(600 if strict else 60):
            # Numbers of the model have roots in some fields and in others not.
            prime = draw_prime(rng) if k % (5 if stated else 60) == 0 else prime
            p = Point(rng, prime, strict)
            try:
                self.place(p, stated, list(on), free)
                return p
            except BadPoint:
                continue
        raise NotCheckable("no point of the constraints was found in prime fields")

    def place(self, p, stated, on, free):
        if stated:
            p.constants |= {name: p.value(value) for name, value in self.stated_values.items()}
        p.constants |= {name: p.value(value) for name, value in self.definitions.items()}
        p.crooked = p.rooted = False
        p.curves["t"] = [p.any(), 1] + [0] * LONGEST
        for name in self.controls:
            p.curves[name] = [p.any() for _ in range(LONGEST)]
        for name in list(self.masses):
            p.curves[name] = [p.positive()]
        for x in self.q:
            p.curves[x] = [p.positive() if any(re.fullmatch(rf"{re.escape(x)} *> *0|0 *< *{re.escape(x)}.*", a)
                                               for a in self.assumptions) else p.any(), p.any()]
        if free:
            return
        conditions = [(m, f) for m, f in self.lower if m < 2] + on
        self.meet(p, [f for m, f in conditions if m == 0], 0)
        self.meet(p, [f for m, f in conditions if m == 1], 1)

    def meet(self, p, functions, order):
        """Changes coordinates (or velocities) so that functions vanish."""
        names = self.jet(order)
        slopes = [gradient(f, names) for f in functions]
        if order == 1 and not any(s in symbols([e]) for row in slopes for e in row for s in names):
            values = p.values(functions)
            rows = p.table(slopes)
            step = solve(rows, [-x for x in values], p.p)
            if step is None:
                raise BadPoint("no such velocity")
            for x, s in zip(self.q, step):
                p.curves[x][1] = (p.curves[x][1] + s) % p.p
            return
        for k, f in enumerate(functions):
            others = set().union(*(symbols([g]) for g in functions[:k])) if k else set()
            own = symbols([f])
            candidates = [s for s in names if s in own and s not in others]
            candidates += [s for s in own if s[0] in self.parameters and s[1] == 0 and s not in others and s[0] not in p.constants]
            if not any(self.solve_for(p, f, s) for s in candidates):
                raise BadPoint("a constraint without a root")

    def solve_for(self, p, f, symbol):
        """Solves f = 0 for one symbol, in which it is a polynomial, or a rational function of the point of its circle."""
        name, order = symbol
        moves = name in p.curves
        kept = (list(p.curves[name]) if moves else None), p.constants.get(name), dict(p.circles)

        def put(u):
            if not moves:
                p.constants[name] = u * u % p.p
                return
            p.curves[name][order] = u
            if order == 0:
                over = p.inverse(1 + u * u)
                p.circles[((sym(name), 1),)] = ((1 - u * u) * over % p.p, 2 * u * over % p.p), 1

        try:
            for k in range(1 if order else 4):
                samples = []
                for u in range(2, 16):
                    put(u)
                    samples.append((u, p.value(f) * pow(1 + u * u, k, p.p) % p.p))
                c = interpolate(samples[:10], p.p)
                if len(c) <= 9 and all(evaluate(c, u, p.p) == x for u, x in samples):
                    for own in field_roots(c, p):
                        put(own)
                        return True
                    break
        except BadPoint:
            pass
        if moves:
            p.curves[name], p.circles = kept[0], kept[2]
        else:
            p.constants.pop(name, None)
        return False

    def move(self, p, length=LENGTH):
        """Continues the state as the motion: Taylor coefficients of the coordinates and of the multipliers."""
        rows, right = self.bordered()
        n, r = len(self.q), len(self.top)
        flat = [e for row in rows for e in row] + right
        for k in range(1, length - 1):
            for mass, rate in self.mass_rates.items():
                series = p.series([rate], k)[0]
                p.curves[mass] = p.curves[mass][:1] + [series[j] * pow(j + 1, -1, p.p) % p.p for j in range(k)]
            values = p.series(flat, k)
            matrix = [values[i * (n + r):(i + 1) * (n + r)] for i in range(n + r)]
            x = solve_series(matrix, values[(n + r) ** 2:], k, p.p)
            for i, name in enumerate(self.q):
                a = x[i][k - 1]
                p.curves[name].append(a * pow(k * (k + 1), -1, p.p) % p.p)
        for l, name in enumerate(self.constraint_names):
            p.curves["lambda_" + name] = x[n + l]
        return p

    def admissible_basis(self, p):
        """A basis of the virtual displacements at the point."""
        return null_space(p.table(self.jacobian), len(self.q), p.p)


def solve_series(matrix, right, length, p):
    """Solves linear equations whose coefficients are series, order by order; undetermined multipliers are zero."""
    first = [[e[0] for e in row] for row in matrix]
    out = [[] for _ in matrix]
    for k in range(length):
        b = [(right[i][k] - sum(matrix[i][c][j] * out[c][k - j] for c in range(len(matrix)) for j in range(1, k + 1))) % p
             for i in range(len(matrix))]
        x = solve(first, b, p)
        if x is None:
            raise BadPoint("no acceleration")
        for own, value in zip(out, x):
            own.append(value)
    return out


# --- polynomials in one variable over a prime field, lowest coefficient first
def trim(c, p):
    c = [x % p for x in c]
    while c and c[-1] == 0:
        c.pop()
    return c


def times(a, b, p):
    out = [0] * (len(a) + len(b) - 1) if a and b else []
    for i, x in enumerate(a):
        for j, y in enumerate(b):
            out[i + j] = (out[i + j] + x * y) % p
    return out


def remainder(a, b, p):
    a, over = trim(a, p), pow(b[-1], -1, p)
    while len(a) >= len(b):
        factor, shift = a[-1] * over % p, len(a) - len(b)
        a = trim([x - (factor * b[i - shift] if i >= shift else 0) for i, x in enumerate(a)], p)
    return a


def quotient(a, b, p):
    a, over, out = trim(a, p), pow(b[-1], -1, p), [0] * max(len(a) - len(b) + 1, 0)
    while len(a) >= len(b):
        factor, shift = a[-1] * over % p, len(a) - len(b)
        out[shift] = factor
        a = trim([x - (factor * b[i - shift] if i >= shift else 0) for i, x in enumerate(a)], p)
    return out


def common(a, b, p):
    while b:
        a, b = b, remainder(a, b, p)
    return a


def raise_modulo(base, n, modulus, p):
    out = [1]
    while n:
        if n & 1:
            out = remainder(times(out, base, p), modulus, p)
        base, n = remainder(times(base, base, p), modulus, p), n >> 1
    return out


def field_roots(c, point):
    """The roots in the field of a polynomial (Cantor and Zassenhaus)."""
    p, c = point.p, trim(c, point.p)
    if len(c) < 2:
        return []
    x = raise_modulo([0, 1], p, c, p)
    x = trim([(x[i] if i < len(x) else 0) - (1 if i == 1 else 0) for i in range(max(len(x), 2))], p)
    found, pending = [], [common(c, x, p) if x else c]
    while pending:
        f = trim(pending.pop(), p)
        if len(f) == 2:
            found.append(-f[0] * pow(f[1], -1, p) % p)
        elif len(f) > 2:
            half = raise_modulo([point.any(), 1], p // 2, f, p)
            half = trim([(half[0] if half else 0) - 1] + half[1:], p)
            part = common(f, half, p)
            pending += [f] if len(part) in (0, 1, len(f)) else [part, quotient(f, part, p)]
    return found


def interpolate(samples, p):
    """The polynomial through samples (Newton's divided differences)."""
    xs, d = [u for u, _ in samples], [y for _, y in samples]
    for k in range(1, len(xs)):
        for i in range(len(xs) - 1, k - 1, -1):
            d[i] = (d[i] - d[i - 1]) * pow(xs[i] - xs[i - k], -1, p) % p
    c = []
    for x, y in zip(reversed(xs), reversed(d)):
        c = times(c, [-x % p, 1], p) if c else []
        c = [(c[0] if c else 0) + y] + c[1:]
    return trim(c, p)


def evaluate(c, u, p):
    out = 0
    for x in reversed(c):
        out = (out * u + x) % p
    return out
