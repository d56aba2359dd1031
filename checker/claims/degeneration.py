"""`functional.degeneration` (theory 4 §3): with special values put in, the densities are those of another functional."""
from densities import agree
from expressions import sub
from functionals import Functional


def degeneration(cx, verdict):
    own = cx.data["degenerations"][verdict["subject"]]
    other = cx.other(own["becomes"])
    parameters = {name: other.scope.tensors[name] for name in other.data.get("parameters", {})}
    f = Functional(cx.data, own["at"], parameters)
    pairs = [(None, sub(f.density, other.density))]
    pairs += [(name, sub(piece.density, other.pieces[name].density)) for name, piece in f.pieces.items() if name in other.pieces]
    return agree(cx, other, pairs, verdict)


CLAIMS = {"functional.degeneration": degeneration}
