"""Index notation of model files, read into components: `s_ij (delta_kj + u_k,j)`, `A'_ij(e)`, `(k u,i),i`.

The last underscore of a name separates its indices, a comma without spaces its derivatives. A letter that occurs twice in a product is
summed over. A component is a symbol with the axes by which it is differentiated; a constitutive function at its arguments is a symbol too,
((name, arguments), slots): the tensor of its derivatives by the independent components of the argument.
"""
import contextlib
import itertools
import re
from fractions import Fraction

from expressions import (FUNCTIONS, NODES, ONE, PI, ZERO, NotCheckable, add, children, derive, div, fn, mul, neg, num, power, reach, root, sub, sym,
                         total)

TOKEN = re.compile(r"(\s*)(?:(\d+\.\d*|\.\d+|\d+)|([A-Za-z]\w*)('*)((?<=')_\w+)?|(\*\*|[-+*/^(),=]))")


def pairs(d):
    return [(i, j) for i in range(d) for j in range(i, d)]


def slots(kind, d):
    """The independent components of a kind of tensor, each with how often it occurs."""
    return {"scalar": [((), 1)], "vector": [((i,), 1) for i in range(d)],
            "symmetric": [(ij, 1 if ij[0] == ij[1] else 2) for ij in pairs(d)],
            "matrix": [(ij, 1) for ij in itertools.product(range(d), repeat=2)],
            "elastic": [(ij + kl, 1) for ij in pairs(d) for kl in pairs(d) if ij <= kl],
            "minor": [(ij + kl, 1) for ij in pairs(d) for kl in pairs(d)]}[kind]


def canonical(kind, place):
    if kind == "symmetric":
        return tuple(sorted(place))
    if kind not in ("elastic", "minor"):
        return tuple(place)
    own = [tuple(sorted(place[:2])), tuple(sorted(place[2:]))]
    return sum(sorted(own) if kind == "elastic" else own, ())


class Reader:
    """A text as a tree; `scope` knows names, functions and coordinates."""

    def __init__(self, text, scope):
        self.scope, self.at, self.tokens, place = scope, 0, [], 0
        text = text.rstrip()
        while place < len(text):
            found = TOKEN.match(text, place)
            if not found:
                raise NotCheckable(f"`{text[place:place + 20]}` is not of the grammar read here")
            self.tokens.append((bool(found[1]), found[2], found[3], found[4] or "", found[5] or "", found[6]))
            place = found.end()

    def sign(self, *signs):
        if self.at < len(self.tokens) and self.tokens[self.at][5] in signs:
            self.at += 1
            return self.tokens[self.at - 1][5]
        return None

    def expect(self, sign):
        if not self.sign(sign):
            raise NotCheckable(f"`{sign}` is missing")

    def whole(self):
        e = self.sum()
        if self.at < len(self.tokens):
            raise NotCheckable("an expression ends early")
        return e

    def sum(self):
        terms = [(self.sign("-", "+") == "-", self.product())]
        while s := self.sign("+", "-"):
            terms.append((s == "-", self.product()))
        return ("sum", terms)

    def product(self):
        factors = [(False, self.power())]
        while self.at < len(self.tokens):
            token = self.tokens[self.at]
            if s := self.sign("*", "/"):
                factors.append((s == "/", self.power()))
            elif token[1] or token[2] or token[5] == "(":
                factors.append((False, self.power()))
            else:
                break
        return ("product", factors)

    def power(self):
        if self.sign("-"):
            return ("sum", [(True, self.power())])
        base = self.atom()
        return ("power", base, self.power()) if self.sign("^", "**") else base

    def axes(self):
        """What stands behind a comma without spaces."""
        tokens = self.tokens[self.at:self.at + 2]
        if len(tokens) < 2 or tokens[0][5] != "," or tokens[0][0] or tokens[1][0] or not (tokens[1][1] or tokens[1][2]):
            return []
        self.at += 2
        return self.indices(tokens[1][1] or tokens[1][2], self.scope.suffixes)

    def indices(self, text, named=()):
        out = []
        while text:
            name = next((n for n in sorted(named, key=len, reverse=True) if text.startswith(n)), text[0])
            out.append(named[name] if name in named else int(name) - 1 if name.isdigit() else name)
            text = text[len(name):]
        return out

    def atom(self):
        if self.at >= len(self.tokens):
            raise NotCheckable("an expression ends early")
        _, number, name, primes, behind, _ = self.tokens[self.at]
        if number:
            self.at += 1
            return ("number", Fraction(number))
        if self.sign("("):
            inner = self.sum()
            self.expect(")")
            axes = self.axes()
            return ("derivative", inner, axes) if axes else inner
        if not name:
            raise NotCheckable("an expression ends early")
        self.at += 1
        head, _, places = (name + behind).partition("_") if (name + behind).startswith("sum_") else (name + behind).rpartition("_")
        if head == "sum" and self.sign("("):
            inner = self.sum()
            self.expect(")")
            return ("all", list(places), inner)
        if name in FUNCTIONS and name not in self.scope.tensors:
            exponent = self.power() if self.sign("^") else None
            self.expect("(")
            args = [self.sum()]
            while self.sign(","):
                args.append(self.sum())
            self.expect(")")
            return ("power", ("call", name, args), exponent) if exponent else ("call", name, args)
        whole = (name + behind) in self.scope.tensors or (name + behind) in self.scope.functions or not head
        head, places = (name + behind, "") if whole else (head, places)
        if head in self.scope.functions and self.sign("("):
            argument = self.sum()
            self.expect(")")
            return ("apply", head, len(primes), self.indices(places), argument, self.axes())
        if head not in self.scope.tensors:
            raise NotCheckable(f"the name `{head}`")
        return ("name", head, self.indices(places), self.axes())


def letters(items):
    return [i for i in items if isinstance(i, str)]


def once(items):
    return [i for i in dict.fromkeys(items) if items.count(i) == 1]


def free(tree):
    """Letters that occur once, in the order in which they are written."""
    kind = tree[0]
    if kind == "name":
        return once(letters(tree[2] + tree[3]))
    if kind == "apply":
        return once(letters(tree[3] + tree[5]))
    if kind == "sum":
        return max((free(t) for _, t in tree[1]), key=len)
    if kind == "product":
        return once([i for _, t in tree[1] for i in free(t)])
    if kind == "derivative":
        return once(free(tree[1]) + letters(tree[2]))
    return free(tree[1]) if kind == "power" else []


class Scope:
    """Names with their components, functions, and the calculus of jets."""

    def __init__(self, coordinates, suffixes, d):
        self.coordinates, self.d = coordinates, d
        self.suffixes = {s: i for i, s in enumerate(suffixes)}
        self.tensors, self.functions, self.fields = {}, {}, {}
        self.jets = set()
        for c in coordinates:
            self.tensors[c] = {(): sym(c, "x")}
        if coordinates[0].endswith("_1"):
            self.tensors[coordinates[0][:-2]] = {(i,): sym(c, "x") for i, c in enumerate(coordinates[:d])}
        places = range(d)
        self.tensors["delta"] = {(i, j): ONE if i == j else ZERO for i in places for j in places}
        self.tensors["n"] = {(i,): sym(f"n_{i + 1}", "n") for i in places}
        bent = lambda i, j: sym(f"curvature_{min(i, j) + 1}{max(i, j) + 1}", "k")
        self.tensors["curvature"] = {(i, j): bent(i, j) for i in places for j in places}
        self.tensors["epsilon"] = {t: num(self.parity(t)) for t in itertools.product(places, repeat=d)}
        self.tensors["pi"] = {(): PI}

    @staticmethod
    def parity(t):
        out = 1
        for i, j in itertools.combinations(t, 2):
            out *= (j > i) - (j < i)
        return out

    def declare(self, name, kind, constant=False):
        """A tensor of symbols; those that are not constant have jets."""
        label = lambda place: name + ("_" + "".join(str(i + 1) for i in place) if place else "")
        own = {place: sym(label(place), 0 if constant else ()) for place, _ in slots(kind, self.d)}
        rank = len(next(iter(own)))
        self.tensors[name] = {t: own[canonical(kind, t)] for t in itertools.product(range(self.d), repeat=rank)}
        if not constant:
            self.jets |= {label(place) for place in own}
            self.fields[name] = [(label(place), times) for place, times in slots(kind, self.d)]

    @contextlib.contextmanager
    def meaning(self, names):
        """Names that mean something else for a while."""
        before, self.tensors = self.tensors, {**self.tensors, **names}
        try:
            yield
        finally:
            self.tensors = before

    # --- values
    def tree(self, text):
        return Reader(text, self).whole()

    def scalar(self, text):
        return self.value(self.tree(text), {})

    def components(self, tree, order=None):
        order = free(tree) if order is None else order
        return {t: self.value(tree, dict(zip(order, t))) for t in itertools.product(range(self.d), repeat=len(order))}

    def equation(self, text):
        """Left minus right, all components."""
        left, _, right = text.partition("=")
        left, right = self.tree(left), self.tree(right or "0")
        order = free(left) or free(right)
        a, b = self.components(left, order), self.components(right, order)
        return [sub(a[t], b[t]) for t in a]

    def over(self, bound, places, value):
        bound = [i for i in dict.fromkeys(bound) if bound.count(i) == 2]
        return total(value({**places, **dict(zip(bound, t))}) for t in itertools.product(range(self.d), repeat=len(bound)))

    def value(self, tree, places):
        kind = tree[0]
        at = lambda own, items: tuple(own[i] if isinstance(i, str) else i for i in items)
        if kind == "number":
            return num(tree[1])
        if kind == "name":
            return self.over(letters(tree[2] + tree[3]), places, lambda own: self.totals(self.component(tree[1], at(own, tree[2])), at(own, tree[3])))
        if kind == "apply":
            return self.over(letters(tree[3] + tree[5]), places, lambda own: self.totals(self.applied(tree, at(own, tree[3])), at(own, tree[5])))
        if kind == "sum":
            return total(neg(self.value(t, places)) if minus else self.value(t, places) for minus, t in tree[1])
        if kind == "product":
            def one(own):
                out = ONE
                for divides, t in tree[1]:
                    out = div(out, self.value(t, own)) if divides else mul(out, self.value(t, own))
                return out
            return self.over([i for _, t in tree[1] for i in free(t)], places, one)
        if kind == "power":
            return power(self.value(tree[1], places), self.value(tree[2], places))
        if kind == "call":
            args = [self.value(t, places) for t in tree[2]]
            return root(args[0]) if tree[1] == "sqrt" else fn(tree[1], *args)
        if kind == "all":
            return total(self.value(tree[2], {**places, **dict(zip(tree[1], t))}) for t in itertools.product(range(self.d), repeat=len(tree[1])))
        return self.over(free(tree[1]) + letters(tree[2]), places, lambda own: self.totals(self.value(tree[1], own), at(own, tree[2])))

    def component(self, name, place):
        if place not in self.tensors[name]:
            raise NotCheckable(f"`{name}` has other indices")
        return self.tensors[name][place]

    def argument(self, name, tree):
        kind = self.functions[name]["of"]
        while tree[0] in ("sum", "product") and len(tree[1]) == 1 and not tree[1][0][0]:
            tree = tree[1][0][1]
        own = self.tensors[tree[1]] if tree[0] == "name" and not tree[2] else self.components(tree)
        return tuple(own[place] for place, _ in slots(kind, self.d))

    def determinant(self, tree):
        """Of a tensor of rank two, by permutations."""
        own = self.argument("det", tree)
        at = lambda i, j: own[i * self.d + j]
        def term(order):
            out = num(self.parity(order))
            for i, j in enumerate(order):
                out = mul(out, at(i, j))
            return out
        return total(term(order) for order in itertools.permutations(range(self.d)))

    def applied(self, tree, place):
        _, name, primes, _, argument, _ = tree
        if name == "det":
            return self.determinant(argument)
        kind, args = self.functions[name]["of"], self.argument(name, argument)
        rank = len(slots(kind, self.d)[0][0])
        of = [p for p, _ in slots(kind, self.d)]
        if rank == 0:
            by = (0,) * primes
        else:
            by = tuple(of.index(canonical(kind, place[i:i + rank])) for i in range(0, len(place), rank))
        return self.function(name, args, by)

    def function(self, name, args, by=()):
        """A function at arguments; a stated formula, or a stated gradient, is put in."""
        own = self.functions[name]
        kind = own["of"]
        # Of a gradient that is stated, or undone by a conjugate, it is not used that it is one.
        is_map = "gradient" in own or "gradient" in self.functions.get(own.get("conjugate"), {})
        by = (*by[:1], *sorted(by[1:])) if is_map else tuple(sorted(by))
        if by and "gradient" in own or "value" in own and "conjugate" not in own:
            hold = [sym(("slot", name), (k,)) for k in range(len(args))]
            place = [p for p, _ in slots(kind, self.d)]
            x = {t: hold[place.index(canonical(kind, t))] for t in itertools.product(range(self.d), repeat=len(place[0]))}
            with self.meaning({**own.get("names", {}), "X": x}):
                if "gradient" in own:
                    tree = self.tree(own["gradient"])
                    out, by = self.value(tree, dict(zip(free(tree), place[by[0]]))), by[1:]
                else:
                    out = self.scalar(own["value"])
            for k in by:
                out = div(self.partial(out, (("slot", name), (k,))), num(slots(kind, self.d)[k][1]))
            return self.put(out, dict(zip(hold, args)))
        return sym((name, args), by)

    def put(self, e, table):
        """Symbols replaced, in arguments of functions too."""
        out = {}
        for c in reach([e]):
            key = NODES[c]
            if key[0] == "symbol":
                out[c] = table.get(c, c)
                if c not in table and isinstance(key[1], tuple) and key[1][0] != "slot":
                    out[c] = self.function(key[1][0], tuple(self.put(a, table) for a in key[1][1]), key[2])
            elif not children(c):
                out[c] = c
            else:
                args = [out[a] for a in children(c)]
                make = {"+": add, "*": mul, "^": lambda a: power(a, num(key[2]))}
                out[c] = make[key[0]](*args) if key[0] in make else fn(key[0], *args)
        return out[e]

    # --- derivatives
    def along(self, e, of_jet):
        def of(name, order):
            if isinstance(name, tuple) and name[0] != "slot":
                times = [m for _, m in slots(self.functions[name[0]]["of"], self.d)]
                inner = [self.along(a, of_jet) for a in name[1]]
                return total(mul(mul(num(m), self.function(name[0], name[1], (*order, k))), da)
                             for k, (m, da) in enumerate(zip(times, inner)) if da != ZERO)
            return of_jet(name, order)
        return derive([e], of)[0]

    def partial(self, e, symbol):
        return self.along(e, lambda *own: ONE if own == symbol else ZERO)

    def total(self, e, axis):
        def of(name, order):
            if order == "x":
                return ONE if name == self.coordinates[axis] else ZERO
            if order == "k":
                raise NotCheckable("derivatives of the curvature")
            if order == "n":
                return self.tensors["curvature"][int(name[2:]) - 1, axis] if axis < self.d else ZERO
            return sym(name, tuple(sorted((*order, axis)))) if name in self.jets else ZERO
        return self.along(e, of)

    def totals(self, e, axes):
        for axis in axes:
            e = self.total(e, axis)
        return e
