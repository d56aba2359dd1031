"""Suslov's rule: `variation.suslov`, and `hamilton.stationary-suslov` (theory 1 (8), (15))."""
import itertools

from reduced import Reduced
from claims.principles import curve
from expressions import NotCheckable, says
from fields import eliminate, rank
from variations import Variation


@says("refuted")
def by_suslov(cx, verdict):
    """(15): sum theta A = 0 on motions, for some choice of dependent velocities where proved, for none where refuted."""
    import itertools
    system = cx.system
    if system.order != 1 or not system.top:
        raise NotCheckable("no constraints of first order")
    p = system.point(cx.rng)
    v = p.table(system.jacobian)
    r, outcomes = len(system.top), []
    for d in itertools.combinations(range(len(system.q)), r):
        if rank([[row[i] for i in d] for row in v], p.p) == r:
            reduced = Reduced(cx, [x for i, x in enumerate(system.q) if i not in d])
            outcomes.append(cx.vanishes(lambda p: reduced.at(system.move(p))[0])[0])
    wanted = verdict["verdict"] == "proved"
    if any(outcomes) and not all(outcomes):
        return ("confirmed", "for a choice of dependent velocities") if wanted else ("not checkable here", "it depends on the choice")
    return ("confirmed" if any(outcomes) == wanted else "rejected"), f"for {len(outcomes)} choices of dependent velocities: {any(outcomes)}"


def suslov_rule(cx, verdict):
    """delta f = 0 by Suslov's rule, and the dv that the record states are those."""
    stated = cx.formulas(verdict)
    def at(p):
        w = Variation(cx, p, curve(cx))
        dv = w.suslov()
        out = w.cut(*w.of_constraints(dv))
        for x, series in zip(cx.system.q, w.dq):
            p.curves["delta_" + x] = series
        given = [p.value(e) for _, e in stated]
        # Which velocities are dependent is the choice of the record: every choice gives another rule, and is fitted to it.
        if given and len(given) == len(w.columns):
            fits = []
            for columns in itertools.combinations(range(w.size), len(given)):
                w.columns = list(columns)
                if len(eliminate([[row[c][0] for c in columns] + [0] for row in w.f_v], p.p)[1]) == len(columns):
                    own = w.suslov()
                    fits.append(sorted(own[c][0] for c in columns) == sorted(given))
            out.append(0 if any(fits) else 1)
        return out
    return cx.identity(at, [e for _, e in stated])


CLAIMS = {"hamilton.stationary-suslov": by_suslov, "variation.suslov": suslov_rule}
