"""Values of Python as the exact texts of model files, and back to SymPy."""

from __future__ import annotations

import json
import math
import re
import sys
from collections.abc import Mapping, Sequence
from decimal import Decimal
from numbers import Integral, Rational, Real
from typing import Any

from .errors import ModelError

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
#: Functions of the notation of models, and what SymPy calls them.
FUNCTIONS = {
    **{name: name for name in "sin cos tan cot sec csc asin acos atan atan2 sinh cosh tanh asinh acosh atanh exp log sign".split()},
    "abs": "Abs",
}


def shown(model: Any) -> str:
    """The file of a model to be looked at: with the values that were set, where it has a place for them."""
    try:
        return str(model.text())
    except ModelError:
        return str(model.texts()[1])


def exact(value: Any) -> str:
    """A number or an expression as the exact text that a model file has.

    Texts are taken as they stand; a float is the shortest decimal that reads back as it (0.1 is a tenth); what SymPy has is
    written by :func:`of_sympy`.
    """
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        raise TypeError("a number or an expression is needed, not a truth value")
    if isinstance(value, Integral):
        return str(int(value))
    if isinstance(value, Rational):
        return f"{int(value.numerator)}/{int(value.denominator)}"
    if isinstance(value, Decimal):
        if not value.is_finite():
            raise ValueError(f"{value} is no finite number")
        return str(value)
    if getattr(value, "shape", None) == () and not hasattr(value, "free_symbols"):
        # An array of one number, of NumPy or of JAX.
        if getattr(value, "mask", False):
            raise TypeError("there is no value where an array is masked")
        plain = value.item()
        if type(plain) is not type(value):
            return exact(plain)
        if isinstance(plain, Real):
            # What Python has no number for, as NumPy's long double, is the decimal that it prints as.
            return exact(Decimal(str(plain)))
    elif isinstance(value, Real) and not hasattr(value, "free_symbols"):
        number = float(value)
        if not math.isfinite(number):
            raise ValueError(f"{number} is no finite number")
        return repr(number)
    if hasattr(value, "free_symbols"):
        return of_sympy(value)
    raise TypeError(f"a number, a text or a SymPy expression is needed, not {type(value).__name__}")


def of_sympy(value: Any) -> str:
    """A SymPy expression, or an equation, as text.

    Functions of the time ``x(t)`` become names, their derivatives names with primes. What the notation of models does not have is refused: its
    name with brackets behind would be read as a product where a parameter has this name.
    """
    import sympy as sp
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):  # type: ignore[misc, unused-ignore]
        def _print_Derivative(self, expr: Any) -> str:
            (variable, count), = expr.variable_count
            function = self._print(expr.expr)
            if variable.name not in ("t", "_t") or not count.is_Integer or not _NAME.fullmatch(function):
                raise ModelError(f"{expr} is no derivative of a coordinate with respect to the time")
            return str(function + "'" * int(count))

        def _print_Float(self, expr: Any) -> str:
            # More digits than a double has are kept, and what is too small or too large for one.
            own = abs(float(expr))
            is_double = expr._prec <= 53 and (expr == 0 or sys.float_info.min <= own <= sys.float_info.max)
            return repr(float(expr)) if is_double else str(expr)

        def _print_Function(self, expr: Any) -> str:
            if isinstance(expr, sp.core.function.AppliedUndef):
                if len(expr.args) == 1 and getattr(expr.args[0], "name", "") in ("t", "_t"):
                    return self._name(expr.func.__name__)
                raise ModelError(f"{expr} is no function of the time alone")
            own = {"Abs": "abs"}.get(expr.func.__name__, expr.func.__name__)
            return f"{own}({', '.join(self._print(a) for a in expr.args)})"

        _print_Abs = _print_Function
        _print_sign = _print_Function

        def _print_Symbol(self, expr: Any) -> str:
            return self._name("t" if expr.name == "_t" else expr.name)

        def _print_Dummy(self, expr: Any) -> str:
            return self._print_Symbol(expr)

        def _print_Exp1(self, expr: Any) -> Any:
            return "exp(1)"

        def _print_Relational(self, expr: Any) -> str:
            return f"{self._print(expr.lhs)} {'=' if expr.rel_op == '==' else expr.rel_op} {self._print(expr.rhs)}"

        @staticmethod
        def _name(name: str) -> str:
            if not _NAME.fullmatch(name):
                raise ModelError(f"`{name}` is no name: letters, digits and underscores are, with a letter first")
            return name

    value = known_functions(value)
    from .trees import nodes

    # The whole before its parts, so that the message names what was written.
    for own in reversed(nodes([value])):
        if not _is_in_the_notation(own):
            is_real = own.is_number and own.evalf().is_Float
            cure = "put its digits in, as `.evalf()` gives them" if is_real else "write it by these, with finite real numbers"
            raise ModelError(f"{own} has no place in a model, whose functions are {', '.join(FUNCTIONS)}: {cure}")
    return str(Printer({"order": "none"}).doprint(value))


def _is_in_the_notation(own: Any) -> bool:
    """Whether the notation of models has a node of SymPy: sums, products, powers, numbers, names, their derivatives, relations, its functions."""
    import sympy as sp
    from sympy.core.function import AppliedUndef

    if isinstance(own, sp.Function):
        return isinstance(own, AppliedUndef) or own.func in [getattr(sp, name) for name in FUNCTIONS.values()]
    kinds = (sp.Add, sp.Mul, sp.Pow, sp.Rational, sp.Float, sp.Symbol, sp.Derivative, sp.Tuple, sp.core.relational.Relational)
    return isinstance(own, kinds) or own in (sp.pi, sp.E)


def known_functions(value: Any) -> Any:
    """A SymPy expression without functions that a model does not have: ``sech`` is ``1/cosh``; derivatives of expressions, sums and what else waits
    to be done are done."""
    import sympy as sp
    from sympy.core.function import AppliedUndef

    inverse = {
        sp.sech: sp.cosh, sp.csch: sp.sinh, sp.acot: sp.atan, sp.asec: sp.acos, sp.acsc: sp.asin, sp.asech: sp.acosh, sp.acsch: sp.asinh,
        sp.acoth: sp.atanh,
    }
    of_functions = {sp.sech, sp.csch}
    value = sp.sympify(value)
    if value.has(sp.Derivative):
        value = value.replace(lambda own: isinstance(own, sp.Derivative) and not isinstance(own.expr, AppliedUndef), lambda own: own.doit())
    # What SymPy keeps as a name and writes out when it is asked, as the curves of muscles.
    if value.has(sp.Subs, sp.Sum, sp.Product) or any(_is_written_out(own) for own in value.atoms(sp.Function)):
        value = value.replace(lambda own: isinstance(own, (sp.Subs, sp.Sum, sp.Product)) or _is_written_out(own), lambda own: own.doit())
    for known, other in inverse.items():
        if not value.has(known):
            continue
        if known in of_functions:
            value = value.replace(known, lambda x, other=other: 1 / other(x))
        else:
            value = value.replace(known, lambda x, other=other: other(1 / x))
    if value.has(sp.coth):
        value = value.replace(sp.coth, lambda x: sp.cosh(x) / sp.sinh(x))
    return value.xreplace({sp.GoldenRatio: (1 + sp.sqrt(5)) / 2})


def _is_written_out(own: Any) -> bool:
    """Whether a function has a formula of its own that stands in its place."""
    import sympy as sp

    return isinstance(own, sp.Function) and not isinstance(own, sp.Piecewise) and type(own).doit not in (sp.Basic.doit, sp.Function.doit)


def toml(sections: Mapping[str, Any]) -> str:
    """A model file of keys and sections, each a number, a text, a list, or a mapping."""
    plain = {key: own for key, own in sections.items() if not isinstance(own, Mapping)}
    tables = {key: own for key, own in sections.items() if isinstance(own, Mapping)}
    lines = [f"{_key(key)} = {_value(own)}" for key, own in plain.items()]
    for name, table in tables.items():
        lines += ["", f"[{_key(name)}]"]
        lines += [f"{_key(key)} = {_value(own)}" for key, own in table.items()]
    return "\n".join(lines) + "\n"


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else _text(key)


def _text(text: str) -> str:
    # The escapes of JSON are those of TOML, but for that of the delete character.
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(value: Any) -> str:
    if value is None:
        return "{}"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(own)}" for key, own in value.items()) + " }"
    # A quotient is an expression, and stands in quotation marks; so does an integer that TOML does not have.
    if isinstance(value, Integral) and not -(2**63) <= int(value) < 2**63:
        return _text(exact(value))
    if isinstance(value, Integral) or isinstance(value, Real) and not isinstance(value, Rational):
        return exact(value)
    if isinstance(value, str):
        return _text(value)
    listed: Any = value
    is_array = type(listed).__name__ in ("ndarray", "Tuple") and getattr(listed, "shape", None) != ()
    if isinstance(listed, Sequence) or is_array:
        return "[" + ", ".join(_value(own) for own in listed) + "]"
    return _text(exact(listed))
