"""Energy (theory 1 §5.1), and Z f of a reduced symmetry (theory 3 §6, Theorem C): rates along the motion."""
import re

from claims.integrals import rate_of
from expressions import NotCheckable, gradient, mul, says, sub, sym, total


@says("refuted")
def energy(cx, verdict):
    system = cx.system
    h = sub(total(mul(p, sym(x, 1)) for p, x in zip(system.momenta, system.q)), system.lagrangian)
    if verdict["verdict"] == "refuted":
        return cx.counterexample(verdict, [system.rate(h)], along=2)
    formulas = cx.formulas(verdict)
    if not formulas:
        return cx.identity(rate_of(cx, h), [h])
    given = formulas[0][1]
    def at(p):
        rates = rate_of(cx, given)(p)
        return rates + [x for x in p.series([sub(h, given)], 3)[0]]
    return cx.identity(at, [h])


@says("refuted")
def reduced_symmetry(cx, verdict):
    """Refuted: the rates of Z f, stated in the sentence, do not vanish; Z is a derivative by a coordinate."""
    z = re.search(r"Z = ∂/∂(\w+)", verdict["detail"])
    if not z:
        raise NotCheckable("the symmetry is no derivative by a coordinate")
    system = cx.system
    along = [gradient(f, [(z[1], 0)])[0] for f in system.top]
    if verdict["verdict"] == "refuted":
        return cx.counterexample(verdict, [system.rate(f) for f in along], along=2)
    return cx.identity(lambda p: [x for f in along for x in rate_of(cx, f)(p)] if not p.curves.get("lambda_") else [], along)


CLAIMS = {"energy.integral": energy, "noether.reduced-symmetry": reduced_symmetry}
