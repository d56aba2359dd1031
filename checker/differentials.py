"""Whether equations follow from others near their solutions: their differentials are combinations, at random points (theory 4 §4)."""
from expressions import ZERO, BadPoint, NotCheckable, mul, sub, total
from fields import rank
from jets import Jets, is_nothing


def spans(cx, f, inside, here, wanted, rules, place=None):
    """Whether the differentials of what is wanted are combinations of those of what is there, and of derivatives inside, at a point."""
    wanted = [e for e in wanted if not is_nothing(f, e)]
    more = lambda: [f.scope.total(e, i) for e in inside if e != ZERO for i in range(len(f.scope.coordinates))]
    for have in (lambda: inside + here, lambda: inside + here + along(f, here, place), lambda: inside + here + more()):
        wanted = wanted and beyond(cx, f, [e for e in have() if e != ZERO], wanted, rules, place)
    return not wanted


def along(f, here, place, once_more=True):
    """Derivatives along a piece of what holds on it."""
    out, n, axes = [], f.scope.tensors["n"], {f.scope.coordinates.index(name) for name, _ in place or {}}
    for e in here + (along(f, here, place, once_more=False) if axes and once_more else []):
        try:
            slopes = [f.scope.total(e, i) for i in range(f.d)]
        except NotCheckable:
            continue  # The curvature is not differentiated.
        if axes:
            out += [s for i, s in enumerate(slopes) if i not in axes]
        else:
            through = total(mul(n[(i,)], s) for i, s in enumerate(slopes))
            out += [sub(s, mul(n[(i,)], through)) for i, s in enumerate(slopes) if f.d > 1]
    return out


def beyond(cx, f, have, wanted, rules, place):
    """Those whose differentials are no combinations of the others."""
    for _ in range(40):
        try:
            p = Jets(f, cx.rng, rules, place)
            jets = sorted({j for e in have + wanted for j in f.jets_of(e)})
            row = lambda e: p.values([f.scope.partial(e, j) for j in jets])
            rows = [row(e) for e in have]
            return [e for e in wanted if rank(rows + [row(e)], p.p) > rank(rows, p.p)]
        except BadPoint:
            continue
    raise NotCheckable("no point was found at which all roots exist")
