"""Functionals of fields over space: the lowered text of a record, its first variation, and points of what is stated (theory 4).

A point is a value modulo a prime for every jet. Stated equations are solved for some jets, their leaders; derivatives of a leader
follow from the derivatives of the equation. A constitutive function has random derivatives at each of its arguments, so that what
vanishes does so for every energy; its Legendre conjugate has the derivatives that follow: s = A'(e), B'(s) = e, B''(s) = A''(e)^-1.
"""
import itertools
import random
import tomllib

from expressions import NODES, ONE, ZERO, BadPoint, NotCheckable, add, div, mul, neg, num, sub, substitute, sym, symbols, total
from fields import Point, draw_prime, solve
from index_notation import Scope, slots


class Functional:
    """One functional; `special` are values put in for parameters, fields and functions, keyed as they are written."""

    def __init__(self, data, special=None, meanings=None):
        domain, sizes = data["domain"], data.get("sizes", {})
        numbered = isinstance(domain["coordinates"], str)
        d = sizes["d"] if numbered else len(domain["coordinates"])
        names = [f"{domain['coordinates'][:-2]}_{i + 1}" for i in range(d)] if numbered else list(domain["coordinates"])
        suffixes = [str(i + 1) for i in range(d)] if numbered else list(names)
        if "time" in domain:
            names, suffixes = [*names, domain["time"]], [*suffixes, domain["time"]]
        self.scope = scope = Scope(names, suffixes, d)
        self.name, self.data, self.d = data["name"], data, d
        for name, value in sizes.items():
            scope.tensors[name] = {(): num(value)}
        given = dict(special or {})
        for name, own in data.get("parameters", {}).items():
            scope.declare(name, own.get("kind", "scalar"), constant=True)
        for section in ("data", "fields"):
            for name, own in data.get(section, {}).items():
                scope.declare(name, own["kind"])
        scope.functions = {name: dict(own) for name, own in data.get("functions", {}).items()}
        self.given(given, meanings or {})
        for name, own in data.get("parameters", {}).items():
            if "value" in own and name not in self.put:
                scope.tensors[name] = {(): scope.scalar(own["value"])}
        for left, right in data.get("define", {}).items():
            head, _, places = left.rpartition("_")
            scope.tensors[head or left] = scope.components(scope.tree(right), list(places) if head else [])
        self.density = scope.scalar(data["density"])
        self.pieces = {name: Piece(self, name, own) for name, own in data.get("boundary", {}).items()}
        self.on = {name: own.get("on") for name, own in data["fields"].items()}
        bound = [name for key in ("fields", "data") for name, own in data.get(key, {}).items() if "on" in own]
        self.of_boundary = {c for name in bound for c, _ in scope.fields[name]}
        self.varied = [c for name, on in self.on.items() if on is None for c, _ in scope.fields[name]]
        self.times = {c: m for own in scope.fields.values() for c, m in own}
        self.equations = {label: Equation(self, label, own) for label, own in data.get("equations", {}).items()}
        self.imposed, self.yields = ([self.equations[l] for l in data.get(key, [])] for key in ("imposed", "yields"))

    def given(self, special, names):
        """Values of functions become formulas; those of parameters stand for them. On the right `names` mean what they mean there."""
        scope, self.put = self.scope, set()
        for left, right in special.items():
            if "(" in left:
                scope.functions[left.split("(")[0]] = {"of": scope.functions[left.split("(")[0]]["of"], "value": right, "names": names}
                continue
            tree = scope.tree(left)
            name = self.head(tree)
            order, places = self.places(tree)
            with scope.meaning(names):
                values = scope.components(scope.tree(right), order).values()
            table = {scope.tensors[name][t]: e for t, e in zip(places(), values)}
            scope.tensors[name] = {t: table.get(e, e) for t, e in scope.tensors[name].items()}
            self.put.add(name)

    def head(self, tree):
        while tree[0] in ("sum", "product"):
            tree = tree[1][0][1]
        return tree[1]

    def places(self, tree):
        while tree[0] in ("sum", "product"):
            tree = tree[1][0][1]
        order = [i for i in tree[2] if isinstance(i, str)]
        def all_places():
            for t in itertools.product(range(self.d), repeat=len(order)):
                at = dict(zip(order, t))
                yield tuple(at[i] if isinstance(i, str) else i for i in tree[2])
        return order, all_places

    def jets_of(self, e, components=None):
        """Jets in an expression, in arguments of functions too."""
        found, stack = set(), [e]
        while stack:
            for name, order in symbols([stack.pop()]):
                if isinstance(name, tuple):
                    stack.extend(name[1] if name[0] != "slot" else ())
                elif name in self.scope.jets and (components is None or name in components):
                    found.add((name, order))
        return sorted(found)

    # --- the first variation
    def lagrangian(self):
        """The density with the imposed equations whose multipliers are stated; these are functions of place."""
        held, rules = self.data.get("multipliers", {}), []
        out = {None: self.density, **{p: own.density for p, own in self.pieces.items()}}
        for e in self.imposed:
            if e.label in held:
                values = self.scope.components(self.scope.tree(held[e.label])).values()
                for k, (residual, value) in enumerate(zip(e.residuals, values)):
                    name = f"multiplier {e.label} {k}"
                    self.scope.jets.add(name)
                    out[e.on] = add(out[e.on], mul(sym(name, ()), residual))
                    rules.append(([sub(sym(name, ()), value)], [(name, ())], None))
        return out, rules

    def euler(self, density):
        """For each component that is varied the sum of (-D)^a dL/dc_a, divided by how often it occurs in its tensor."""
        out = {}
        for jet in self.jets_of(density, set(self.varied)):
            moved = self.scope.totals(self.scope.partial(density, jet), jet[1])
            out[jet[0]] = add(out.get(jet[0], ZERO), neg(moved) if len(jet[1]) % 2 else moved)
        return {c: div(out.get(c, ZERO), num(self.times[c])) for c in self.varied}

    def flux(self, density):
        """W with dL = sum E dc + D_i W_i: for each variable the coefficients of variations and their slopes."""
        out = [{} for _ in self.scope.coordinates]
        def put(i, jet, e):
            out[i][jet] = add(out[i].get(jet, ZERO), e)
        for c, by in self.jets_of(density, set(self.varied)):
            if len(by) > 2:
                raise NotCheckable("derivatives of higher order than two")
            slope = self.scope.partial(density, (c, by)) if by else ZERO
            if len(by) == 1:
                put(by[0], (c, ()), slope)
            elif by:
                half = slope if by[0] == by[1] else div(slope, num(2))
                for i, j in dict.fromkeys([by, by[::-1]]):
                    put(i, (c, (j,)), half)
                    put(j, (c, ()), neg(self.scope.total(half, i)))
        return out

    def form(self, piece, flux, density):
        """The coefficients of variations and slopes on a piece."""
        out = {}
        for i, own in enumerate(flux[:self.d]):
            for jet, e in own.items():
                out[jet] = add(out.get(jet, ZERO), mul(self.scope.tensors["n"][(i,)], e))
        here = {c for name, on in self.on.items() if on in (None, piece.name) for c, _ in self.scope.fields[name]}
        for jet in self.jets_of(density, here):
            out[jet] = add(out.get(jet, ZERO), self.scope.partial(density, jet))
        return {jet: piece.put(e) for jet, e in out.items()}


class Piece:
    """A piece of the boundary: curved with any normal, or a face of a box."""

    def __init__(self, functional, name, own):
        scope, self.name, self.functional = functional.scope, name, functional
        self.axis = None
        if "at" in own:
            left, right = own["at"].split("=")
            self.axis, self.at = scope.coordinates.index(left.strip()), scope.scalar(right)
            low, high = (scope.scalar(e) for e in functional.data["domain"]["intervals"][left.strip()])
            self.upper = self.at == high
        self.fixed = set(own.get("fixed", []))
        self.density = self.put(scope.scalar(own.get("density", "0")))

    def put(self, e):
        if self.axis is None:
            return e
        normal = {f"n_{i + 1}": ZERO for i in range(self.functional.d)} | {f"n_{self.axis + 1}": ONE if self.upper else num(-1)}
        return self.functional.scope.put(e, {sym(n, "n"): x for n, x in normal.items()})

    def place(self):
        return {} if self.axis is None else {(self.functional.scope.coordinates[self.axis], "x"): self.at}

    def conditions(self, form):
        """Coefficients of independent variations, and of slopes along the piece by which these are not moved off; corners."""
        scope, values, normal, along, corners = self.functional.scope, {}, {}, {}, {}
        for (c, by), e in form.items():
            if len(by) > 1:
                raise NotCheckable("second derivatives of variations on the boundary")
            spatial = bool(by) and by[0] < self.functional.d
            if by and (not spatial or self.axis is not None and by[0] != self.axis):
                if spatial:
                    corners[c, by[0]] = e
                values[c] = sub(values.get(c, ZERO), self.put(scope.total(e, by[0])))
            elif not by:
                values[c] = add(values.get(c, ZERO), e)
            elif self.axis is not None:
                normal[c] = e
            else:
                along.setdefault(c, {})[by[0]] = e
        n, places = scope.tensors["n"], range(self.functional.d)
        for c, q in along.items():
            # The divergence theorem on the surface: the part of the slope along the piece is moved off the variation.
            normal[c] = total(mul(n[(i,)], e) for i, e in q.items())
            flat = lambda i, j: sub(num(int(i == j)), mul(n[(i,)], n[(j,)]))
            spread = total(mul(flat(i, j), scope.total(e, j)) for i, e in q.items() for j in places)
            bent = total(scope.tensors["curvature"][i, i] for i in places)
            if c not in self.fixed:
                values[c] = sub(values.get(c, ZERO), sub(spread, mul(normal[c], bent)))
        values = {c: e for c, e in values.items() if c not in self.fixed}
        normal = {c: e for c, e in normal.items() if c + ",n" not in self.fixed}
        return values, normal, set(along), {k: e for k, e in corners.items() if k[0] not in self.fixed}


class Equation:
    def __init__(self, functional, label, own):
        self.label, self.on = label, own.get("on")
        self.residuals = functional.scope.equation(own["equation"])
        for name in (self.on or "").split(","):
            if name.strip():
                piece = functional.pieces[name.strip()]
                self.residuals = [piece.put(e) for e in self.residuals]


class Jets(Point):
    """A point of the jets: random where nothing is stated, else by the rules, pairs of residuals and leaders."""

    def __init__(self, functional, rng, rules=(), place=None):
        super().__init__(rng, draw_prime(rng))
        self.functional, self.scope = functional, functional.scope
        self.rules, self.known, self.busy, self.bases = list(rules), {}, set(), {}
        # Whether a derivative along a curved piece of what holds there was drawn at random.
        self.loose, self.place = False, place or {}
        self.across = next((self.scope.coordinates.index(name) for name, kind in self.place if kind == "x"), None)
        d = functional.d
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
        if isinstance(name, tuple):
            return self.known.setdefault(key, self.of_function(name[0], tuple(self.values(list(name[1]))), order))
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
                            return self.lead(residuals, leaders, tuple(rest), key)
        return self.known.setdefault(key, self.positive() if order == 0 else self.any())

    def lead(self, residuals, leaders, rest, key):
        targets = [(name, tuple(sorted((*order, *rest)))) for name, order in leaders]
        if set(targets) & self.busy:
            raise NotCheckable("equations that are not solved one after the other")
        self.busy |= set(targets)
        moved = [self.scope.totals(e, rest) for e in residuals]
        slopes = [self.scope.partial(e, t) for e in moved for t in targets]
        for t in targets:
            self.known[t] = 0
        right, matrix = self.values(moved), self.values(slopes)
        n = len(targets)
        x = solve([matrix[i * n:(i + 1) * n] for i in range(len(moved))], [-r % self.p for r in right], self.p)
        if x is None:
            raise BadPoint("equations that contradict each other here")
        self.known.update(zip(targets, x))
        self.busy -= set(targets)
        return self.known[key]

    # --- constitutive functions
    def base(self, name, e):
        """f'(e), and the derivatives of f' and f'' by the independent components, at values e."""
        own = self.scope.functions[name]
        hold = [(("slot", name), (k,)) for k in range(len(e))]
        before = {h: self.known.pop(h) for h in hold if h in self.known}
        self.known.update(zip(hold, e))
        saved = {k: v for k, v in self.known.items() if isinstance(k[0], tuple) and k[0][0] != "slot"}
        for k in saved:
            del self.known[k]
        args = tuple(sym(*h) for h in hold)
        first = [self.scope.function(name, args, (k,)) for k in range(len(e))]
        second = [[self.scope.partial(g, h) for h in hold] for g in first]
        def third():
            return [[[self.scope.partial(m, h) for h in hold] for m in row] for row in second]
        out = self.values(first), lambda: self.table_at(name, e, second), lambda: [self.table_at(name, e, row) for row in third()]
        self.restore(hold, before, saved)
        return out

    def table_at(self, name, e, rows):
        hold = [(("slot", name), (k,)) for k in range(len(e))]
        before = {h: self.known.pop(h) for h in hold if h in self.known}
        saved = {k: v for k, v in self.known.items() if isinstance(k[0], tuple) and k[0][0] != "slot"}
        for k in saved:
            del self.known[k]
        self.known.update(zip(hold, e))
        out = self.table(rows)
        self.restore(hold, before, saved)
        return out

    def restore(self, hold, before, saved):
        for key in [k for k in self.known if isinstance(k[0], tuple) and k[0][0] != "slot"] + hold:
            self.known.pop(key, None)
        self.known.update(before | saved)

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


def is_nothing(functional, e):
    """Whether an expression vanishes for all fields, as what is imposed by a definition does."""
    return not any(Jets(functional, random.Random(k)).value(e) for k in (1, 2)) if e != ZERO else True


def rules_of(functional, equations, piece=None):
    """Equations solved: each group of residuals with as many leaders, jets in which they are linear; those with the least choice first."""
    data = {c for name in functional.data.get("data", {}) for c, _ in functional.scope.fields[name]}
    residuals = [(k, r) for k, e in enumerate(equations) for r in dict.fromkeys(e.residuals) if not is_nothing(functional, r)]
    wide = {r: len(list(candidates(functional, r, data, set(), piece))) for _, r in residuals}
    residuals.sort(key=lambda own: wide[own[1]])
    led = {}
    def choose(at):
        if at == len(residuals):
            return True
        for found in candidates(functional, residuals[at][1], data, set(led.values()), piece):
            led[at] = found
            if choose(at + 1):
                return True
            del led[at]
        return False
    if not choose(0):
        raise NotCheckable("what is stated is not solved for jets in which it is linear")
    rules = []
    for k in range(len(equations)):
        own = [at for at, (group, _) in enumerate(residuals) if group == k]
        if own:
            axes = None if piece is None else set() if piece.axis is None else set(range(len(functional.scope.coordinates))) - {piece.axis}
            rules.append(([residuals[at][1] for at in own], [led[at] for at in own], axes))
    return rules


def candidates(functional, residual, data, taken, piece=None):
    """Jets in which a residual is linear, the best leader first: data, then what is not differentiated, then the highest derivative.

    Of the jets of a component only the highest leads, since the others follow by differentiation from it; on a piece of the boundary
    derivatives across it are values of their own."""
    own = [s for s in symbols([residual]) if s[0] in functional.scope.jets]
    inside = set()
    for name, _ in symbols([residual]):
        if isinstance(name, tuple) and name[0] != "slot":
            for a in name[1]:
                inside |= set(functional.jets_of(a))
    height = lambda jet: (len(jet[1]), [-a for a in jet[1]])
    top = {name: max((j for j in own if j[0] == name), key=height) for name, _ in own}
    def clash(a, b):
        if a[0] != b[0]:
            return False
        if piece is not None:
            across = lambda jet: len(jet[1]) if piece.axis is None else jet[1].count(piece.axis)
            return a == b or across(a) == across(b) and piece.axis is not None
        return set(a[1]) <= set(b[1]) or set(b[1]) <= set(a[1])
    def is_free(jet):
        slope = functional.scope.partial(residual, jet)
        return not any(clash(jet, t) for t in taken) and jet not in inside and slope != ZERO and jet not in functional.jets_of(slope)
    return (jet for jet in sorted(top.values(), key=lambda jet: (jet[0] not in data, bool(jet[1]), -len(jet[1]), jet[1], jet[0])) if is_free(jet))


class Context:
    """A record of a functional under examination."""

    def __init__(self, record, seed):
        self.record, self.rng = record, random.Random(seed)
        self.data = tomllib.loads(record["model"]["flat"])
        self.functional = Functional(self.data)
        self.verdicts = {v["claim"] + ("#" + v["subject"] if v["subject"] else ""): v for v in record["verdicts"]}
        self.outcomes = {}

    def other(self, name, special=None):
        return Functional(self.data["others"][name], special)

    def vanish(self, functional, es, rules=(), place=None, points=3):
        """Whether expressions vanish at random points of the rules."""
        done, tries = 0, 0
        while done < points:
            tries += 1
            if tries > 40:
                raise NotCheckable("no point was found at which all roots exist")
            try:
                point = Jets(functional, self.rng, rules, place)
                if any(point.values(list(es))):
                    if point.loose:
                        raise NotCheckable("derivatives along a curved piece of what holds there")
                    return False
                done += 1
            except BadPoint:
                continue
        return True
