"""Functionals of fields over space: the lowered text of a record and its first variation (theory 4)."""
import itertools
import random
import tomllib

from expressions import NODES, ONE, ZERO, BadPoint, NotCheckable, add, div, mul, neg, num, reach, sub, sym, symbols, total
from index_notation import Scope
from jets import Jets


class Functional:
    """One functional; `special` are values put in for parameters, fields and functions, keyed as they are written."""

    def __init__(self, data, special=None, meanings=None):
        given = dict(special or {})
        sizes = {name: int(given.pop(name, value)) for name, value in data.get("sizes", {}).items()}
        domain = data["domain"]
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
        for name, own in data.get("parameters", {}).items():
            scope.declare(name, own.get("kind", "scalar"), constant=True)
        for section in ("data", "fields"):
            for name, own in data.get(section, {}).items():
                scope.declare(name, own["kind"])
        scope.functions = {"det": {"of": "matrix"}, **{name: dict(own) for name, own in data.get("functions", {}).items()}}
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

    def by_formulas(self):
        """The same, in which no function is known as the conjugate of another where both have formulas."""
        own = {name: {k: v for k, v in f.items() if k != "conjugate"} if "value" in f else f
               for name, f in self.data["functions"].items()}
        return Functional({**self.data, "functions": own})

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
                    self.without_hidden_relations(functional, [*es, *(r for own in rules for r in own[0])])
                    return False
                done += 1
            except BadPoint:
                continue
        return True

    def without_hidden_relations(self, functional, es):
        """Values of logarithms, and of exponentials where rules hold, are drawn by how they are written: they may be tied all the same."""
        stack, seen = list(es), set()
        while stack:
            for c in reach([stack.pop()]):
                key = NODES[c]
                if c in seen:
                    continue
                seen.add(c)
                if key[0] in ("log", "exp", "sin", "cos", "atan2", "abs", "sign"):
                    raise NotCheckable("logarithms, arcs or exponentials that may depend on each other")
                if key[0] == "symbol" and isinstance(key[1], tuple) and key[1][0] != "slot":
                    stack.extend(key[1][1])
