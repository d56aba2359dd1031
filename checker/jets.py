"""Points of the jets of a functional (theory 4): a value modulo a prime for every jet.

Stated equations are solved for some jets, their leaders; derivatives of a leader follow from the derivatives of the equation. Rules that
need each other's leaders are solved together. A constitutive function has random derivatives at each of its arguments, so that what
vanishes does so for every energy; its Legendre conjugate has the derivatives that follow: s = A'(e), B'(s) = e, B''(s) = A''(e)^-1.
"""
import functools
import random

from expressions import ZERO, BadPoint, NotCheckable, sym
from fields import Point, draw_prime, solve
from index_notation import slots


HIGHEST = 10


class Circle(Exception):
    """Rules that are being solved need each other: the place of the outermost, and the others."""

    def __init__(self, depth, groups):
        super().__init__()
        self.depth, self.groups = depth, groups


def derived(leaders, rest):
    return [(name, tuple(sorted((*order, *rest)))) for name, order in leaders]


class Jets(Point):
    """A point of the jets: random where nothing is stated, else by the rules, pairs of residuals and leaders."""

    def __init__(self, functional, rng, rules=(), place=None, like=None, prime=None):
        """`like` is another point with the same constants, place and normal."""
        super().__init__(rng, like.p if like else prime or draw_prime(rng))
        self.functional, self.scope = functional, functional.scope
        self.rules, self.known, self.frames, self.bases = list(rules), {}, [], {}
        # Whether a derivative along a curved piece of what holds there was drawn at random.
        self.loose, self.place = False, place or {}
        self.across = next((self.scope.coordinates.index(name) for name, kind in self.place if kind == "x"), None)
        self.like, d = like, functional.d
        if like:
            self.known.update((key, x) for key, x in like.known.items() if key[1] in ("n", "k"))
            return
        if d == 1:
            normal = [rng.choice([1, self.p - 1])]
        else:
            c, s = self.unit()
            normal = [c, s] if d == 2 else [c * x % self.p for x in self.unit()] + [s]
        self.known.update({(f"n_{i + 1}", "n"): x for i, x in enumerate(normal)})
        self.bend(normal)

    def bend(self, n):
        """A random curvature: symmetric, and nothing across the piece, as the normal stays a unit vector."""
        d, p, loose = range(len(n)), self.p, [[self.any() for _ in n] for _ in n]
        flat = [[(int(i == j) - n[i] * n[j]) % p for j in d] for i in d]
        for i in d:
            for j in d:
                own = sum(flat[i][k] * (loose[k][l] + loose[l][k]) * flat[l][j] for k in d for l in d) % p
                self.known[f"curvature_{min(i, j) + 1}{max(i, j) + 1}", "k"] = own

    def unit(self):
        u = self.any()
        over = self.inverse(1 + u * u)
        return (1 - u * u) * over % self.p, 2 * u * over % self.p

    def coefficients(self, name, order, n):
        return [self.of_symbol(name, order)] + [0] * (n - 1)

    def of_symbol(self, name, order):
        key = (name, order)
        if key in self.known:
            return self.known[key]
        if (trial := self.open(key)) is not None:
            return trial
        if isinstance(name, tuple):
            self.frames.append((None, {}))
            try:
                at = tuple(self.values(list(name[1])))
            finally:
                self.frames.pop()
            return self.known.setdefault(key, self.of_function(name[0], at, order))
        if key in self.place:
            self.known[key] = self.value(self.place[key])
            return self.known[key]
        if name in self.scope.jets:
            for residuals, leaders, axes in self.rules:
                for leader in leaders:
                    if leader[0] == name and len(leader[1]) <= len(order):
                        rest = list(order)
                        if all(a in rest and not rest.remove(a) for a in leader[1]):
                            if axes is not None and not set(rest) <= axes and leader[0] not in self.functional.of_boundary:
                                self.loose = self.loose or bool(set(rest) - axes - {self.across})
                                continue
                            return self.lead((residuals, leaders, tuple(rest)), key)
        if self.like and order in (0, "x"):
            return self.known.setdefault(key, self.like.of_symbol(name, order))
        return self.known.setdefault(key, self.positive() if order == 0 else self.any())

    def lead(self, own, key):
        """The value of a jet by the rule that leads to it; rules that need each other's leaders are solved together."""
        groups = [own]
        while True:
            targets = list(dict.fromkeys(t for _, leaders, rest in groups for t in derived(leaders, rest)))
            if any(len(order) > HIGHEST for _, order in targets):
                raise NotCheckable("equations that are solved by ever higher derivatives")
            self.frames.append((groups, dict.fromkeys(targets, 0)))
            try:
                moved = [self.scope.totals(e, rest) for residuals, _, rest in groups for e in residuals]
                slopes = [self.scope.partial(e, t) for e in moved for t in targets]
                right, matrix = self.values(moved), self.values(slopes)
                if len(groups) > 1 or len(targets) > 1:
                    self.is_linear(moved, targets, matrix)
                break
            except Circle as circle:
                if circle.depth < len(self.frames) - 1:
                    raise
                groups = groups + [g for g in circle.groups if g not in groups]
            finally:
                self.frames.pop()
        n = len(targets)
        x = solve([matrix[i * n:(i + 1) * n] for i in range(len(moved))], [-r % self.p for r in right], self.p)
        if x is None:
            raise BadPoint("equations that contradict each other here")
        self.known.update(zip(targets, x))
        return self.known[key]

    def is_linear(self, moved, targets, matrix):
        """Whether residuals solved together are linear in their leaders: the slopes are the same at other values."""
        trial = self.frames[-1][1]
        trial.update((t, self.any()) for t in targets)
        if self.values([self.scope.partial(e, t) for e in moved for t in targets]) != matrix:
            raise NotCheckable("equations that are not linear together in what they are solved for")

    def open(self, key):
        """The trial value of a leader for which the innermost rules are being solved; those further out are solved together with these."""
        for depth in range(len(self.frames) - 1, -1, -1):
            groups, trial = self.frames[depth]
            if key in trial:
                if depth == len(self.frames) - 1:
                    return trial[key]
                if any(own is None for own, _ in self.frames[depth:]):
                    break
                raise Circle(depth, [g for own, _ in self.frames[depth + 1:] for g in own])
        else:
            return None
        raise NotCheckable("equations whose unknowns are arguments of functions in each other")

    # --- constitutive functions
    def base(self, name, e):
        """f'(e), and the derivatives of f' and f'' by the independent components, at values e."""
        hold = [(("slot", name), (k,)) for k in range(len(e))]
        args = tuple(sym(*h) for h in hold)
        first = [self.scope.function(name, args, (k,)) for k in range(len(e))]
        second = [[self.scope.partial(g, h) for h in hold] for g in first]
        def third():
            return [[[self.scope.partial(m, h) for h in hold] for m in row] for row in second]
        at = lambda rows: self.table_at(name, e, rows)
        return at([first])[0], lambda: at(second), lambda: [at(row) for row in third()]

    def table_at(self, name, e, rows):
        """The values of a matrix where the slots of a function are its arguments."""
        hold = [(("slot", name), (k,)) for k in range(len(e))]
        is_of_function = lambda key: isinstance(key[0], tuple) and key[0][0] != "slot"
        before = {key: self.known.pop(key) for key in list(self.known) if key in hold or is_of_function(key)}
        self.known.update(zip(hold, e))
        try:
            return self.table(rows)
        finally:
            for key in [key for key in self.known if key in hold or is_of_function(key)]:
                del self.known[key]
            self.known.update(before)

    def is_second(self, name):
        """Whether a function is the conjugate of one that stands before it."""
        other, all_ = self.scope.functions[name].get("conjugate"), list(self.scope.functions)
        return other in all_ and all_.index(other) < all_.index(name)

    def of_function(self, name, args, by):
        if self.is_second(name):
            return self.of_conjugate(name, args, by)
        own = self.bases.setdefault((name, args), {})
        return own.setdefault(by, self.any())

    def strain(self, name, s):
        """A new strain whose stress, given by a gradient linear in that of another function, is s."""
        text, n = self.scope.functions[name]["gradient"], len(s)
        others = [g for g, own in self.scope.functions.items() if g + "'" in text and "gradient" not in own and not self.is_second(g)]
        if len(others) != 1:
            raise NotCheckable("a conjugate whose function has a gradient of another kind")
        e = tuple(self.any() for _ in s)
        def stress(x):
            self.bases[others[0], e] = {(k,): y for k, y in enumerate(x)}
            return self.base(name, e)[0]
        zero = stress([0] * n)
        columns = [stress([int(i == j) for i in range(n)]) for j in range(n)]
        rows = [[(columns[j][i] - zero[i]) % self.p for j in range(n)] for i in range(n)]
        x = solve(rows, [(a - b) % self.p for a, b in zip(s, zero)], self.p)
        if x is None:
            raise BadPoint("a stress that no strain has")
        stress(x)
        return e

    def points(self, size):
        return [e for (_, e) in list(self.bases) if len(e) == size]

    def of_conjugate(self, name, s, by):
        first, n = self.scope.functions[name]["conjugate"], len(s)
        times = [m for _, m in slots(self.scope.functions[name]["of"], self.functional.d)]
        e = next((e for e in self.points(n) if tuple(self.base(first, e)[0]) == s), None)
        if e is None and "gradient" in self.scope.functions[first]:
            e = self.strain(first, s)
        if e is None:
            e = tuple(self.any() for _ in s)
            self.bases[first, e] = {(k,): x for k, x in enumerate(s)}
        if not by:
            value = self.of_function(first, e, ())
            return (sum(m * a * b for m, a, b in zip(times, s, e)) - value) % self.p
        if len(by) == 1:
            return e[by[0]]
        _, second, third = self.base(first, e)
        columns = [solve(second(), [int(i == j) for i in range(n)], self.p) for j in range(n)]
        inverse = [[columns[j][i] for j in range(n)] for i in range(n)]
        over = lambda k: self.inverse(times[k])
        if len(by) == 2:
            return inverse[by[0]][by[1]] * over(by[1]) % self.p
        if len(by) > 3:
            raise NotCheckable("derivatives of a conjugate above the third")
        a, b, c = by
        m3 = third()
        turned = sum(inverse[a][i] * m3[i][j][k] * inverse[j][b] * inverse[k][c] for i in range(n) for j in range(n) for k in range(n))
        return -turned * over(b) * over(c) % self.p


@functools.cache
def prime_of(seed):
    return draw_prime(random.Random(seed))


def at_a_point(functional, of, tries=40):
    """What a function of a point gives at the first random one at which everything exists."""
    for seed in range(tries):
        try:
            return of(Jets(functional, random.Random(seed), prime=prime_of(seed)))
        except BadPoint:
            continue
    raise NotCheckable("no point was found at which all roots exist")


def is_nothing(functional, e):
    """Whether an expression vanishes for all fields, as what is imposed by a definition does."""
    return e == ZERO or at_a_point(functional, lambda p: p.value(e)) == 0
