"""Expressions: nodes that are stored once, the parser of the grammar of model files, derivatives."""
import re
from fractions import Fraction

# An expression is a number: the place of its node (operation, arguments...). Arguments stand before what is made of them.
NODES, PLACES = [], {}
LONGEST = 1_000_000  # bits of a number


class NotCheckable(Exception):
    """Nothing is said of a claim, and why."""


class BadPoint(Exception):
    """A denominator vanishes or a root does not exist: another point is drawn."""


def node(*key):
    if key not in PLACES:
        PLACES[key] = len(NODES)
        NODES.append(key)
    return PLACES[key]


def num(value):
    return node("number", Fraction(value))


def sym(name, order=0):
    return node("symbol", name, order)


ZERO, ONE, PI = num(0), num(1), node("pi")


def value_of(e):
    return NODES[e][1] if NODES[e][0] == "number" else None


def add(a, b):
    if a == ZERO or b == ZERO:
        return b if a == ZERO else a
    x, y = value_of(a), value_of(b)
    if x is not None and y is not None:
        return num(x + y)
    return node("+", min(a, b), max(a, b))


def mul(a, b):
    if a == ZERO or b == ZERO:
        return ZERO
    if a == ONE or b == ONE:
        return b if a == ONE else a
    x, y = value_of(a), value_of(b)
    if x is not None and y is not None:
        return num(x * y)
    return node("*", min(a, b), max(a, b))


def total(es):
    out = ZERO
    for e in es:
        out = add(out, e)
    return out


def neg(a):
    return mul(num(-1), a)


def sub(a, b):
    return add(a, neg(b))


def power(a, b):
    """a^b; an exponent that is no number makes an exponential of it."""
    x, y = value_of(a), value_of(b)
    if y is None:
        return fn("exp", mul(b, fn("log", a)))
    if y == 0 or y == 1:
        return ONE if y == 0 else a
    if x is not None and y.denominator == 1 and (x != 0 or y > 0):
        if abs(y) * max(x.numerator.bit_length(), x.denominator.bit_length()) > LONGEST:
            raise NotCheckable("a number with too many digits")
        return num(x ** int(y))
    return node("^", a, y)


def div(a, b):
    return mul(a, power(b, num(-1)))


def root(a):
    return power(a, num(Fraction(1, 2)))


def fn(name, *args):
    """Functions, lowered to sin, cos, exp, log, atan2, abs, sign and powers."""
    a = args[0]
    half, square = num(Fraction(1, 2)), lambda e: mul(e, e)
    grow = lambda: node("exp", a)
    fall = lambda: node("exp", neg(a))
    lowered = {
        "sqrt": lambda: root(a), "ln": lambda: fn("log", a),
        "tan": lambda: div(fn("sin", a), fn("cos", a)), "cot": lambda: div(fn("cos", a), fn("sin", a)),
        "sec": lambda: div(ONE, fn("cos", a)), "csc": lambda: div(ONE, fn("sin", a)),
        "sinh": lambda: mul(half, sub(grow(), fall())), "cosh": lambda: mul(half, add(grow(), fall())),
        "tanh": lambda: div(sub(grow(), fall()), add(grow(), fall())),
        "asinh": lambda: fn("log", add(a, root(add(square(a), ONE)))),
        "acosh": lambda: fn("log", add(a, root(sub(square(a), ONE)))),
        "atanh": lambda: mul(half, fn("log", div(add(ONE, a), sub(ONE, a)))),
        "asin": lambda: node("atan2", a, root(sub(ONE, square(a)))),
        "acos": lambda: node("atan2", root(sub(ONE, square(a))), a),
        "atan": lambda: node("atan2", a, ONE),
    }
    if name in lowered:
        return lowered[name]()
    if a == ZERO and name in ("sin", "cos", "exp"):
        return ZERO if name == "sin" else ONE
    if a == ONE and name == "log":
        return ZERO
    return node(name, *args)


def children(e):
    key = NODES[e]
    if key[0] in ("number", "symbol", "pi"):
        return ()
    return key[1:2] if key[0] == "^" else key[1:]


REACHED = {}


def reach(roots):
    """All nodes below some, arguments first."""
    key = tuple(roots)
    if key in REACHED:
        return REACHED[key]
    seen, stack = set(), list(roots)
    while stack:
        e = stack.pop()
        if e not in seen:
            seen.add(e)
            stack.extend(children(e))
    if len(REACHED) > 5_000:
        REACHED.clear()
    REACHED[key] = sorted(seen)
    return REACHED[key]


def symbols(roots):
    return {NODES[e][1:] for e in reach(roots) if NODES[e][0] == "symbol"}


FUNCTIONS = {"sin", "cos", "tan", "cot", "sec", "csc", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "acosh",
             "atanh", "exp", "log", "ln", "sqrt", "abs", "sign"}
TOKEN = re.compile(r"\s*(?:(\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+)|([A-Za-z_]\w*)|('+)|(\*\*|[-+*/^(),]))")


class Parser:
    """Reads the grammar of model files; `names` gives what stands for a name, `rate` the total derivative of an expression."""

    def __init__(self, text, names=None, rate=None):
        self.names, self.rate, self.at, self.tokens = names or {}, rate, 0, []
        place, text = 0, text.strip()
        while place < len(text):
            found = TOKEN.match(text, place)
            if not found:
                raise NotCheckable(f"`{text[place:place + 20]}` is not of the grammar read here")
            self.tokens.append(found.groups())
            place = found.end()

    def peek(self, kind):
        return self.tokens[self.at][kind] if self.at < len(self.tokens) else None

    def take(self, sign):
        if self.peek(3) == sign:
            self.at += 1
            return True
        return False

    def read(self):
        e = self.sum()
        if self.at < len(self.tokens):
            raise NotCheckable("an expression ends early")
        return e

    def sum(self):
        e = self.product()
        while self.peek(3) in ("+", "-"):
            e = add(e, self.product()) if self.take("+") else (self.take("-"), sub(e, self.product()))[1]
        return e

    def product(self):
        if self.take("-"):
            return neg(self.product())
        if self.take("+"):
            return self.product()
        e = self.power()
        while self.at < len(self.tokens):
            if self.take("*"):
                e = mul(e, self.factor())
            elif self.take("/"):
                e = div(e, self.factor())
            elif self.peek(0) or self.peek(1) or self.peek(3) == "(":
                e = mul(e, self.power())
            else:
                break
        return e

    def factor(self):
        return neg(self.factor()) if self.take("-") else self.power()

    def power(self):
        base = self.atom()
        if self.take("^") or self.take("**"):
            return power(base, self.factor())
        return base

    def primes(self, e, name=None):
        marks = self.peek(2)
        if marks:
            self.at += 1
            if name is not None:
                return sym(name, len(marks))
            for _ in marks:
                e = self.rate(e)
        return e

    def atom(self):
        if self.peek(0):
            self.at += 1
            return num(Fraction(self.tokens[self.at - 1][0]))
        if self.take("("):
            e = self.sum()
            if not self.take(")"):
                raise NotCheckable("a parenthesis is not closed")
            return e
        name = self.peek(1)
        if not name:
            raise NotCheckable("an expression ends early")
        self.at += 1
        if name in FUNCTIONS:
            exponent = self.factor_exponent()
            if not self.take("("):
                raise NotCheckable(f"`{name}` without its argument")
            args = [self.sum()]
            while self.take(","):
                args.append(self.sum())
            self.take(")")
            return power(fn(name, *args), exponent)
        if name == "pi":
            return PI
        if name in self.names:
            return self.primes(self.names[name])
        return self.primes(sym(name), name)

    def factor_exponent(self):
        return self.factor() if self.take("^") else ONE


def derive(roots, of_symbol):
    """Derivatives of expressions, where `of_symbol(name, order)` is that of a symbol."""
    d = {}
    for e in reach(roots):
        key = NODES[e]
        op, args = key[0], key[1:]
        if op in ("number", "pi"):
            d[e] = ZERO
        elif op == "symbol":
            d[e] = of_symbol(*args)
        elif op == "+":
            d[e] = add(d[args[0]], d[args[1]])
        elif op == "*":
            d[e] = add(mul(d[args[0]], args[1]), mul(args[0], d[args[1]]))
        elif op == "^":
            a, n = args
            d[e] = ZERO if d[a] == ZERO else mul(mul(num(n), power(a, num(n - 1))), d[a])
        elif op == "atan2":
            y, x = args
            d[e] = div(sub(mul(x, d[y]), mul(y, d[x])), add(mul(x, x), mul(y, y)))
        else:
            a = args[0]
            slope = {"sin": lambda: fn("cos", a), "cos": lambda: neg(fn("sin", a)), "exp": lambda: e,
                     "log": lambda: power(a, num(-1)), "abs": lambda: fn("sign", a), "sign": lambda: ZERO}
            if op not in slope:
                raise NotCheckable(f"the function `{op}`")
            d[e] = ZERO if d[a] == ZERO else mul(slope[op](), d[a])
    return [d[e] for e in roots]


def gradient(e, names):
    """The partial derivatives by symbols, each (name, order)."""
    return [derive([e], lambda *s, own=own: ONE if s == own else ZERO)[0] for own in names]


def substitute(roots, table):
    """Expressions with symbols, each (name, order), replaced."""
    out = {}
    for e in reach(roots):
        key = NODES[e]
        args = [out[c] for c in children(e)]
        if key[0] == "symbol":
            out[e] = table.get(key[1:], e)
        elif not args:
            out[e] = e
        else:
            make = {"+": add, "*": mul, "^": lambda a: power(a, num(key[2]))}
            out[e] = make[key[0]](*args) if key[0] in make else fn(key[0], *args)
    return [out[e] for e in roots]


def says(*words):
    """Marks a check that knows what to do with verdicts other than `proved`."""
    def mark(check):
        check.says = {"proved", *words}
        return check
    return mark
