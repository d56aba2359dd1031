"""`functional.descent` (theory 4 §3): a functional is the one above it where one more group of equations is imposed."""
import re

from densities import agree
from expressions import sub
from rules import rules_of


def descent(cx, verdict):
    above = cx.other(cx.data["descent"]["from"])
    f = cx.functional
    pairs = [(None, sub(above.density, f.density))]
    pairs += [(name, sub(piece.density, f.pieces[name].density)) for name, piece in above.pieces.items() if name in f.pieces]
    if set(re.findall(r"\(([^)]*)\)", verdict["detail"].split(" on ")[0])) - set(above.equations):
        return "rejected", "the verdict imposes what is not stated above"
    above.scope.jets |= f.scope.jets
    rules = rules_of(f, [e for e in f.imposed if e.on is None])
    return agree(cx, above, pairs, verdict, cx.data["descent"].get("imposing", []), rules)


CLAIMS = {"functional.descent": descent}
