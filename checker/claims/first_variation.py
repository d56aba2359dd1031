"""`functional.euler` (theory 4 §4): the first variation of the density, derived anew, vanishes where the stated equations hold; and near
their solutions these are no more than it: their differentials are combinations of those of the Euler equations and natural conditions.
"""
from differentials import spans
from expressions import ONE, ZERO, NotCheckable, add, div, mul, num, sub
from rules import rules_of

WHY = "its own first variation, at random points modulo primes: {}"


def euler(cx, verdict):
    """With functions and their conjugates as symbols that undo each other; then, where that is not enough, by their formulas."""
    found = compared(cx, cx.functional)
    functions = cx.data.get("functions", {}).values()
    pairs = [f for f in functions if "value" in f and "conjugate" in f]
    if found[0] == "rejected" and pairs:
        if any("value" not in cx.data["functions"][f["conjugate"]] for f in pairs):
            raise NotCheckable("a function that is known by its conjugate alone")
        return compared(cx, cx.functional.by_formulas())
    return found


def compared(cx, f):
    density, held = f.lagrangian()
    inside = f.euler(density[None])
    rules = held + rules_of(f, [e for e in [*f.imposed, *f.yields] if e.on is None])
    if slip := printed(cx, f, {("δ" + c, None): e for c, e in inside.items()}, held, "euler"):
        return "rejected", slip
    if not cx.vanish(f, inside.values(), rules):
        return "rejected", WHY.format("Euler equations do not follow from what is stated")
    base = [r for e in f.imposed if e.on is None for r in e.residuals] + [r for own, _, _ in held for r in own]
    wanted = [r for e in f.yields if e.on is None for r in e.residuals]
    if not spans(cx, f, [*base, *inside.values()], [], wanted, rules):
        return "rejected", WHY.format("what is stated does not follow from the Euler equations")
    flux, corners = f.flux(density[None]), []
    for name, piece in f.pieces.items():
        values, normal, along, ends = piece.conditions(f.form(piece, flux, density[name]))
        corners += [(piece, c, axis, e) for (c, axis), e in ends.items()]
        here = [e for e in [*f.imposed, *f.yields] if e.on == name]
        own = rules_of(f, here, piece) + rules
        place = piece.place()
        if not cx.vanish(f, [*values.values(), *normal.values()], own, place):
            return "rejected", WHY.format(f"conditions on {name} do not follow from what is stated")
        shown = {("δ" + c, name): div(e, num(f.times[c])) for c, e in values.items() if c not in along}
        if slip := printed(cx, f, shown, held, "boundary", place, piece):
            return "rejected", slip
        have = [r for e in f.imposed if e.on == name for r in e.residuals] + [*values.values(), *normal.values()]
        if not spans(cx, f, [*base, *inside.values()], have, [r for e in f.yields if e.on == name for r in e.residuals], own, place):
            return "rejected", WHY.format(f"what is stated on {name} does not follow from the conditions there")
    return at_corners(cx, f, corners, rules) or ("confirmed", WHY.format("equivalent near their solutions"))


def printed(cx, f, own, held, key, place=None, piece=None):
    """What the record prints of these is the same, for all fields."""
    for line in cx.record["functional"][key]:
        at = (line["of"], line.get("on"))
        if at in own:
            try:
                shown = f.scope.scalar(line["zero"])
            except NotCheckable:
                continue  # An argument of a function may have a name that is made for reading only.
            if not cx.vanish(f, [sub(own[at], piece.put(shown) if piece else shown)], held, place):
                return f"the equation of {line['of']} is printed otherwise than it is"
    return None


def at_corners(cx, f, corners, rules):
    for e in [e for e in f.yields if e.on and "," in e.on]:
        a, b = (f.pieces[n.strip()] for n in e.on.split(","))
        sign = {True: ONE, False: num(-1)}
        for c in {c for _, c, _, _ in corners}:
            own = ZERO
            for piece, component, axis, q in corners:
                for one, other in ((a, b), (b, a)):
                    if piece is one and component == c and axis == other.axis:
                        own = add(own, mul(sign[other.upper], q))
            if not cx.vanish(f, [other for other in [a.put(b.put(own))]], rules_of(f, [e]) + rules, a.place() | b.place()):
                return "rejected", WHY.format(f"the condition at the corner {e.on} does not follow from what is stated")
    return None


CLAIMS = {"functional.euler": euler}
