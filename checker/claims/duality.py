"""`functional.duality` (theory 4 §1, identity (D)): the densities of a pair add up to the divergence of the flux stated, and on each piece
what is left vanishes modulo what the verdict names; without a flux the sum has no Euler equations.
"""
from densities import WHY, agree
from expressions import ZERO, add, mul, sub, total


def duality(cx, verdict):
    f, own = cx.functional, cx.data["duality"]
    other = cx.other(own["with"])
    if "flux" not in own:
        whole = add(f.density, other.density)
        es = [total(f.scope.totals(f.scope.partial(whole, j), j[1]) if len(j[1]) % 2 == 0 else
                    sub(ZERO, f.scope.totals(f.scope.partial(whole, j), j[1])) for j in f.jets_of(whole) if j[0] == c)
              for c in {j[0] for j in f.jets_of(whole)}]
        return ("confirmed" if cx.vanish(f, es) else "rejected"), WHY
    tree = f.scope.tree(own["flux"])
    flux = [f.scope.components(tree)[(i,)] for i in range(f.d)]
    inside = sub(add(f.density, other.density), total(f.scope.total(w, i) for i, w in enumerate(flux)))
    pairs = [(None, inside)]
    for name, piece in f.pieces.items():
        through = piece.put(total(mul(f.scope.tensors["n"][(i,)], w) for i, w in enumerate(flux)))
        pairs.append((name, total([through, piece.density, other.pieces[name].density])))
    return agree(cx, f, pairs, verdict)


CLAIMS = {"functional.duality": duality}
