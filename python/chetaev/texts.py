"""Values of Python as the exact texts of model files, and back to SymPy."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping, Sequence
from numbers import Integral, Rational, Real
from typing import Any

_BARE = re.compile(r"[A-Za-z0-9_-]+")
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")


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
    if isinstance(value, Real) and not hasattr(value, "free_symbols"):
        number = float(value)
        if not math.isfinite(number):
            raise ValueError(f"{number} is no finite number")
        return repr(number)
    if hasattr(value, "free_symbols"):
        return of_sympy(value)
    raise TypeError(f"a number, a text or a SymPy expression is needed, not {type(value).__name__}")


def of_sympy(value: Any) -> str:
    """A SymPy expression, or an equation, as text.

    Functions of the time ``x(t)`` become names, their derivatives names with primes.
    """
    import sympy as sp
    from sympy.printing.str import StrPrinter

    class Printer(StrPrinter):  # type: ignore[misc, unused-ignore]
        def _print_Derivative(self, expr: Any) -> str:
            (variable, count), = expr.variable_count
            function = self._print(expr.expr)
            if variable.name not in ("t", "_t") or not count.is_Integer or not _NAME.fullmatch(function):
                raise ValueError(f"{expr} is no derivative of a coordinate with respect to the time")
            return str(function + "'" * int(count))

        def _print_Float(self, expr: Any) -> str:
            # More digits than a double has are kept.
            return repr(float(expr)) if expr._prec <= 53 else str(expr)

        def _print_Function(self, expr: Any) -> str:
            if isinstance(expr, sp.core.function.AppliedUndef):
                if len(expr.args) == 1 and getattr(expr.args[0], "name", "") in ("t", "_t"):
                    return self._name(expr.func.__name__)
                raise ValueError(f"{expr} is no function of the time alone")
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
                raise ValueError(f"`{name}` is no name: letters, digits and underscores are, with a letter first")
            return name

    value = sp.sympify(value)
    for atom in value.atoms(sp.Integral, sp.Piecewise, sp.I.__class__):
        raise ValueError(f"{atom} has no place in a model")
    return str(Printer({"order": "none"}).doprint(value))


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
    # A quotient is an expression, and stands in quotation marks.
    if isinstance(value, Integral) or isinstance(value, Real) and not isinstance(value, Rational):
        return exact(value)
    if isinstance(value, str):
        return _text(value)
    listed: Any = value
    if isinstance(listed, Sequence) or type(listed).__name__ in ("ndarray", "Tuple"):
        return "[" + ", ".join(_value(own) for own in listed) + "]"
    return _text(exact(listed))
