#!/usr/bin/env python3
"""Checks a study.json of Chetaev with nothing of Chetaev: Python's standard library alone (3.11 or later).

    python3 checker/check_study.py study.json [--seed N] [--json] [--only TEXT]

It reads `model.flat` (coordinates, L, Q, constraints), `equations` and the verdicts of the record, solves the multiplier system
    W a - J^T lambda = b,   J a = g            (theory 1, equation (2), differentiated once)
by its own parser, derivatives and arithmetic, and says of each claim that it is *confirmed*, *rejected* or *not checkable here*.
The exit status is 1 where one is rejected, and 2 where the record cannot be read.

An identity is checked at random points. A prime p of 61 bits is drawn, and with it parameters, positions and velocities in the field
of p elements that satisfy the constraints. Curves are Taylor series with coefficients in the field, so that a time derivative is a
shift of coefficients. Sines and cosines are points of the circle, roots exist of squares, and exponentials, logarithms and arcs are
further random elements. What vanishes at three such points, each with a prime of its own, is taken for an identity; what does
not vanish is none in the field that these generators make (theory 6.3), and where they may be tied secretly, as logarithms may,
nothing is said.

Primes are p = 2 q + 1 with q prime and p = 23 mod 24. In such a field exactly one of a, -a is a square, every square has exactly one
root that is a square itself, and products of squares are squares: "is a square" behaves like "is positive", roots are multiplicative as
real ones are, and the roots of 2 and 3 exist.

A refutation is checked at real points: the numbers of the counterexample are intervals with integers as ends, and what ought to
vanish must have an interval without zero.

A record of a functional of fields over space has its densities and equations in `model.flat`; its first variation is derived anew
(theory 4), at random jets modulo a prime.

Files: `expressions` (nodes, parser, derivatives), `fields` (series over a prime field), `systems` (the model, points of its constraints,
motions), `intervals` (real values), `index_notation`, `functionals`,
`jets` and `rules` (fields over space), and `claims/`, one file for each kind of claim.
"""
import importlib
import json
import pathlib
import random
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
sys.setrecursionlimit(10_000)
sys.set_int_max_str_digits(0)

import intervals  # noqa: E402
from expressions import NODES, BadPoint, NotCheckable, reach  # noqa: E402
from systems import System  # noqa: E402
import functionals  # noqa: E402

POINTS, SIGNS = 3, 12
# For identities of degree up to 2^20 in all generators, whose coefficients have up to 2^20 digits: a point errs with probability at
# most 2^20/2^60 (Schwartz, Zippel) and 2^20/2^50 (a prime that divides all coefficients), three with at most their cube.
BOUND = f"{POINTS} points, each modulo a random prime of 61 bits; wrong with probability below 2^-87 for degrees up to 2^20"
STATED = "; for the parameters stated"
CONFIRMED, REJECTED, OPEN = "confirmed", "rejected", "not checkable here"


class Context:
    """A record under examination: its system, its equations, and the ways in which claims are checked."""

    def __init__(self, record, seed):
        self.record, self.rng = record, random.Random(seed)
        flat = record["model"].get("flat")
        if flat is None:
            raise NotCheckable("the record has no model lowered to coordinates, L and Q")
        self.system = System(flat)
        self.system.leave_out_redundant(self.rng)
        self.equations = {e["formulation"]: e for e in record.get("equations", [])}
        self.verdicts = {full(v): v for v in record["verdicts"]}
        self.outcomes = {}

    def read(self, text):
        return self.system.read(text)

    def formulas(self, verdict):
        """The formulas of a verdict: pairs of a left side, where there is one, and an expression."""
        out = []
        for text in verdict["formulas"]:
            left, _, right = text.rpartition(" = ")
            if right == "…":
                raise NotCheckable("a formula is left out of the record as too long")
            out.append((left or None, self.read(right)))
        return out

    def vanishes(self, residuals, kinds=(), **where):
        """Whether residuals, a function of a point, vanish at random points: for general parameters, else for those stated."""
        if self.at_points(residuals, **where):
            return True, BOUND
        try:
            if self.at_points(residuals, stated=True, **where):
                return True, BOUND + STATED
        except NotCheckable:
            pass  # A field with all roots of the numbers stated was not found: general parameters decide.
        if any(NODES[e][0] in ("log", "atan2", "exp") for e in reach(list(kinds) + self.system.top + [self.system.lagrangian])):
            raise NotCheckable("logarithms, arcs or exponentials that may depend on each other")
        return False, "not zero at a random point modulo a prime"

    def at_points(self, residuals, **where):
        """Roots may have the sign that real ones do not have where a positive sum is no square. What is right for real numbers only
        vanishes at some of those points; then points without that possibility decide. What vanishes at all of many does so for all signs."""
        results = [self.at_point(residuals, **where) for _ in range(POINTS)]
        if any(crooked for _, crooked in results) and all(zero for zero, _ in results):
            results += [self.at_point(residuals, **where) for _ in range(SIGNS)]
        if all(zero for zero, _ in results):
            return True
        if any(not zero and not crooked for zero, crooked in results):
            return False
        return all(self.at_point(residuals, strict=True, **where)[0] for _ in range(POINTS))

    def at_point(self, residuals, strict=False, **where):
        """Whether all residuals vanish at one random point, and whether a root may have the other sign there."""
        for _ in range(400 if strict else 40):
            try:
                p = self.system.point(self.rng, strict=strict, **where)
                return all(x == 0 for x in residuals(p)), p.crooked and p.rooted
            except BadPoint:
                continue
        raise NotCheckable("no point was found at which all roots exist")

    def identity(self, residuals, kinds=(), **where):
        """The outcome of a claim that residuals vanish."""
        holds, why = self.vanishes(residuals, kinds, **where)
        return (CONFIRMED if holds else REJECTED), why

    def expect(self, verdict, proved, refuted, kinds=(), **where):
        """Of a claim that residuals vanish, proved or refuted: `proved(point)` are the residuals, `refuted` the same as expressions."""
        if verdict["verdict"] == "proved":
            return self.identity(proved, kinds, **where)
        return self.counterexample(verdict, refuted)

    # --- refutations
    def stated_point(self, verdict, admissible):
        """The values of a counterexample, and what is wrong with it."""
        stated = verdict["counterexample"]
        if not stated:
            return None, "a refutation without counterexample"
        low, high = (intervals.of_rational(x)[0] for x in stated["residual"])
        if low <= 0 <= high or low > high + 1:
            return None, "the residual stated is not apart from zero"
        point = {}
        for own in stated["point"]:
            ends = [own["exact"]] * 2 if own["exact"] is not None else own["enclosure"]
            point[own["name"]] = intervals.of_rational(*ends)
        value = self.real(point)
        if admissible and not self.is_admissible(value):
            return None, "the counterexample does not satisfy the constraints"
        return value, None

    def slip_of_counterexample(self, verdict, admissible=True):
        try:
            return self.stated_point(verdict, admissible)[1]
        except intervals.Uncertain as problem:
            raise NotCheckable(f"at the counterexample: {problem}") from None

    def counterexample(self, verdict, expressions, admissible=True, along=None):
        """Whether some expression, of which the accelerations and multipliers may be part, is not zero at the counterexample."""
        try:
            value, slip = self.stated_point(verdict, admissible)
            if slip:
                return REJECTED, slip
            if along is not None:
                value = self.with_accelerations(value, along)
            apart = [x for x in intervals.values(expressions, value) if intervals.is_not_zero(x)]
            if apart:
                return CONFIRMED, f"at the counterexample, in intervals: {intervals.text(apart[0])}"
        except intervals.Uncertain as problem:
            raise NotCheckable(f"at the counterexample: {problem}") from None
        return REJECTED, "what is said not to vanish has an interval with zero at the counterexample"

    def real(self, point):
        """Intervals of symbols: those stated, those that the model defines, and any for the others."""
        own = self.system.definitions

        def value(name, order):
            key = name + "'" * order
            if key not in point:
                point[key] = (intervals.values([own[name]], value)[0] if name in own else
                              intervals.of_rational(f"{3 + len(point)}/{2 + len(point)}"))
            return point[key]

        for name in set(own) & set(point):
            x, y = point[name], intervals.values([own[name]], value)[0]
            if x[0] > y[1] or y[0] > x[1]:
                raise NotCheckable(f"the counterexample gives `{name}` another value than the model's definition of it")
        return value

    def is_admissible(self, value):
        functions = [f for m, f in self.system.lower if m < 2]
        for f, x in zip(functions, intervals.values(functions, value)):
            if not x[0] <= 0 <= x[1] or x[1] - x[0] > intervals.UNIT >> 16:
                return False
        return True

    def with_accelerations(self, value, order):
        """The same with the accelerations and multipliers of the motion at the point."""
        system = self.system
        rows, right = system.bordered()
        n = len(rows)
        found = intervals.values([e for row in rows for e in row] + right, value)
        x = intervals.solve([found[i * n:(i + 1) * n] for i in range(n)], found[n * n:])
        table = {(q, 2): a for q, a in zip(system.q, x)}
        table |= {("lambda_" + l, 0): y for l, y in zip(system.constraint_names, x[len(system.q):])}
        return lambda name, order: table.get((name, order)) or value(name, order)


def full(verdict):
    return verdict["claim"] + ("#" + verdict["subject"] if verdict["subject"] else "")


def kinds():
    """Which function checks a claim: the `CLAIMS` of each file of `claims/`, keyed by the id or its beginning."""
    table = {}
    for path in sorted((HERE / "claims").glob("*.py")):
        table |= importlib.import_module(f"claims.{path.stem}").CLAIMS
    return table


def examined(cx, verdict, check):
    """The outcome of a check; one that only reads what is proved tells whether the claim is true nevertheless."""
    if verdict["verdict"] in getattr(check, "says", {"proved"}):
        return check(cx, verdict)
    outcome, why = check(cx, {**verdict, "verdict": "proved"})
    return (REJECTED, f"it is true: {why}") if outcome == CONFIRMED else (OPEN, "it is not proved, and no refutation of this kind is read")


def examine(cx, verdict, table):
    """The outcome of one claim and its reason."""
    if verdict["verdict"] not in ("proved", "refuted", "conditional"):
        return OPEN, f"the record says {verdict['verdict']}"
    if len([v for v in cx.record["verdicts"] if full(v) == full(verdict)]) > 1:
        return REJECTED, "the claim is stated more than once"
    check = table.get(full(verdict)) or table.get(verdict["claim"])
    if check is None:
        return OPEN, "no check of this kind is written"
    try:
        outcome, why = examined(cx, verdict, check)
        if outcome == REJECTED and verdict["verdict"] == "conditional" and why.endswith(STATED):
            return where_stated(cx, verdict, why)
        if outcome == REJECTED and "for general values of the parameters:" in verdict["detail"]:
            return OPEN, f"it says one thing of the parameters stated and another of general ones: {why}"
        return outcome, why
    except NotCheckable as why:
        return OPEN, str(why)
    except BadPoint as why:
        return OPEN, f"no point was found at which everything that the claim speaks of exists: {why}"
    except (RecursionError, MemoryError):
        return OPEN, "expressions too deep for this program"
    except (KeyError, ValueError, TypeError, IndexError, ZeroDivisionError, ArithmeticError) as slip:
        return REJECTED, f"what the record holds cannot be read: {slip!r}"
    except Exception as slip:  # What this program did not foresee is no fault of the record.
        return OPEN, f"this check ended with {slip!r}"


def where_stated(cx, verdict, why):
    """A condition beside what is true for the parameters stated and false for general ones: these have to satisfy it."""
    parts = [part.split(" = ") for part in (verdict["condition"] or "").split(" and ")]
    if any(len(part) != 2 for part in parts):
        return OPEN, "it is true for the parameters stated, and the condition is not read"
    sides = [[cx.read(side) for side in part] for part in parts]
    if cx.at_points(lambda p: [(p.value(a) - p.value(b)) % p.p for a, b in sides], stated=True):
        return CONFIRMED, f"false for general parameters, true for those stated, which satisfy the condition: {why}"
    return REJECTED, f"it is true where the condition does not hold: {why}"


def check(record, seed=0, only=""):
    """Of every claim of a record: its id, verdict, outcome and reason."""
    table = kinds()
    if not (isinstance(record, dict) and isinstance(record.get("model"), dict) and isinstance(record.get("verdicts"), list)):
        raise ValueError("it is no record of a study")
    try:
        cx = (functionals.Context if record.get("functional") else Context)(record, seed)
    except (NotCheckable, BadPoint, RecursionError) as why:
        return [(full(v), v["verdict"], OPEN, str(why)) for v in record["verdicts"] if only in full(v)]
    lines = []
    for verdict in record["verdicts"]:
        if only in full(verdict):
            outcome, why = examine(cx, verdict, table)
            cx.outcomes[full(verdict)] = outcome
            lines.append((full(verdict), verdict["verdict"], outcome, why))
    return lines


def main(arguments):
    options = dict(zip(arguments[1::2], arguments[2::2])) if "--json" not in arguments else {}
    words = [a for a in arguments if a != "--json"]
    options = {words[i]: words[i + 1] for i in range(1, len(words) - 1, 2)}
    if not words or set(options) - {"--seed", "--only"}:
        print(__doc__.split("\n\n")[1].strip(), file=sys.stderr)
        return 2
    try:
        record = json.loads(pathlib.Path(words[0]).read_text(encoding="utf-8"))
        seed = int(options.get("--seed", random.SystemRandom().randrange(2**32)))
        lines = check(record, seed, options.get("--only", ""))
    except KeyboardInterrupt:
        return 130
    except Exception as problem:  # Nothing that a file holds ends this program with a trace of its own lines.
        print(f"the record cannot be read: {problem!r}", file=sys.stderr)
        return 2
    if "--json" in arguments:
        print(json.dumps([dict(zip(("claim", "verdict", "outcome", "why"), line)) for line in lines], ensure_ascii=False, indent=1))
    else:
        for claim, verdict, outcome, why in lines:
            if verdict in ("proved", "refuted", "conditional"):
                print(f"{outcome:20}{verdict:12}{claim}: {why}")
        counts = {o: sum(line[2] == o for line in lines) for o in (CONFIRMED, REJECTED, OPEN)}
        print(", ".join(f"{n} {o}" for o, n in counts.items()) + f" (seed {seed})")
    return 1 if any(line[2] == REJECTED for line in lines) else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
