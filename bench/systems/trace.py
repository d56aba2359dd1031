"""A hand form as straight-line statements, as a person writes them in C: each operation once, in the order in which it is stated."""


class Trace:
    """Records operations; `statements` are (name, text)."""

    def __init__(self):
        self.statements, self.known = [], {}

    def emit(self, text):
        if text not in self.known:
            name = "t%d" % len(self.statements)
            self.statements.append((name, text))
            self.known[text] = Value(self, name)
        return self.known[text]


def number(x):
    return isinstance(x, (int, float))


class Value:
    def __init__(self, trace, name):
        self.trace, self.name = trace, name

    def _with(self, sign, other, swap=False):
        text = repr(float(other)) if number(other) else other.name
        a, b = (text, self.name) if swap else (self.name, text)
        return self.trace.emit("(%s) %s (%s)" % (a, sign, b))

    def __add__(self, x):
        return self if number(x) and x == 0 else self._with("+", x)

    __radd__ = __add__

    def __sub__(self, x):
        return self if number(x) and x == 0 else self._with("-", x)

    def __rsub__(self, x):
        return -self if number(x) and x == 0 else self._with("-", x, True)

    def __mul__(self, x):
        if number(x) and x in (0, 1):
            return self if x == 1 else 0
        return self._with("*", x)

    __rmul__ = __mul__

    def __truediv__(self, x):
        return self._with("/", x)

    def __rtruediv__(self, x):
        return self._with("/", x, True)

    def __neg__(self):
        return self.trace.emit("-%s" % self.name)


def apply(function):
    return lambda x: x.trace.emit("%s(%s)" % (function, x.name))


class Ops:
    num = float
    sin, cos, sqrt = apply("sin"), apply("cos"), apply("sqrt")


def hand(system):
    """(names of the state, statements, what the rates are)."""
    trace = Trace()
    names = ["z%d" % i for i in range(len(system.hand.variables(system.n)))]
    rates = system.hand.rates(Ops, [Value(trace, x) for x in names])
    return names, trace.statements, [repr(float(r)) if number(r) else r.name for r in rates]
