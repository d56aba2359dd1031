"""Stated equations solved for jets, their leaders (theory 4): as many of them as equations, each linear in the jets it leads."""
from expressions import ZERO, NotCheckable, symbols
from fields import eliminate, rank
from jets import Jets, at_a_point, is_nothing

MOST_TRIES = 2_000


def slopes(p, residual):
    """The differential of an expression at a point: jets with derivatives that are not zero."""
    jets = p.functional.jets_of(residual)
    return {j: x for j, x in zip(jets, p.values([p.scope.partial(residual, j) for j in jets])) if x}


def independent(functional, residuals):
    """Residuals without those that are combinations of others, with coefficients that depend on constants, the place and the normal."""
    def kept(p):
        rows = [slopes(p, r) for _, r in residuals]
        jets = sorted({j for row in rows for j in row})
        if rank([[row.get(j, 0) for j in jets] for row in rows], p.p) == len(rows):
            return residuals
        others = [Jets(functional, p.rng, like=p) for _ in range(len(residuals) + 2)]
        columns = [other.values([r for _, r in residuals]) for other in others]
        return [residuals[k] for k in eliminate([c + [0] for c in columns], p.p)[1]]
    return at_a_point(functional, kept)


def reduced(row, pivots, p):
    """A row of slopes without what the rows before it lead."""
    row = dict(row)
    for column, other in pivots:
        if row.get(column):
            factor = row[column] * pow(other[column], -1, p) % p
            for j, x in other.items():
                row[j] = (row.get(j, 0) - factor * x) % p
    return row


def rules_of(functional, equations, piece=None):
    """Equations solved: each group of residuals with as many leaders, jets in which they are linear; those with the least choice first."""
    data = {c for name in functional.data.get("data", {}) for c, _ in functional.scope.fields[name]}
    residuals = [(k, r) for k, e in enumerate(equations) for r in dict.fromkeys(e.residuals) if not is_nothing(functional, r)]
    residuals = independent(functional, residuals) if residuals else []
    wide = {r: len(list(candidates(functional, r, data, set(), piece))) for _, r in residuals}
    residuals.sort(key=lambda own: wide[own[1]])
    prime, rows = at_a_point(functional, lambda p: (p.p, [slopes(p, r) for _, r in residuals]))
    led, pivots, tries = {}, [], [0]
    def choose(at):
        if at == len(residuals):
            return True
        row = reduced(rows[at], pivots, prime)
        for found in candidates(functional, residuals[at][1], data, set(led.values()), piece):
            tries[0] += 1
            if tries[0] > MOST_TRIES:
                raise NotCheckable("too many choices of what the stated equations are solved for")
            if row.get(found):
                led[at] = found
                pivots.append((found, row))
                if choose(at + 1):
                    return True
                pivots.pop()
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
