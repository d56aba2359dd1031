"""`functional.legendre` (theory 4 §1): two functions stated are conjugates, A + B = A' X and B'(A'(X)) = X."""
from expressions import NotCheckable, mul, num, sub, sym, total
from index_notation import slots


def legendre(cx, verdict):
    """A + B = A' X and B'(A'(X)) = X with both formulas, at X in the range of one of the gradients."""
    f, name = cx.functional, verdict["subject"]
    functions = {n: {k: v for k, v in own.items() if k != "conjugate"} for n, own in f.scope.functions.items()}
    other = f.scope.functions[name]["conjugate"]
    if "value" not in functions[name] or "value" not in functions[other]:
        return "rejected", "a function without a formula"
    f.scope.functions, before = functions, f.scope.functions
    try:
        times = [m for _, m in slots(functions[name]["of"], f.d)]
        at = tuple(sym(f"argument {k}", 0) for k in range(len(times)))
        slope = lambda g, x: tuple(f.scope.function(g, x, (k,)) for k in range(len(times)))
        for x in (at, slope(name, at)):
            image = slope(other, x)
            whole = [f.scope.function(other, x), f.scope.function(name, image), *(mul(num(-m), mul(a, b)) for m, a, b in zip(times, x, image))]
            if cx.vanish(f, [total(whole), *(sub(a, b) for a, b in zip(slope(name, image), x))]):
                return "confirmed", "both formulas, at random arguments modulo primes"
    finally:
        f.scope.functions = before
    if any(w in str(functions) for w in ("exp", "cosh", "sinh", "log", "sin", "cos")):
        raise NotCheckable("exponentials and logarithms that may depend on each other")
    return "rejected", "the formulas are not conjugate"


CLAIMS = {"functional.legendre": legendre}
