"""What L, the forces and the constraints contain (theory 1 §0): the time, coordinates that are absent, odd powers."""
from expressions import gradient, neg, says, sub, substitute, sym
from fields import rank


def polynomial(test, points=lambda system: system.jet(1)):
    """A claim that expressions made of the system vanish identically, without regard to the constraints."""
    @says("refuted")
    def check(cx, verdict):
        es = test(cx.system, verdict)
        if verdict["verdict"] == "proved":
            return cx.identity(lambda p: p.series(es, 1) and [x[0] for x in p.series(es, 1)] if es else [], es, free=True)
        return cx.counterexample(verdict, es, admissible=False)
    return check


def times(system, _):
    moving = [("t", 0)] + [(u, 0) for u in system.controls]
    return [e for f in system.stated for e in gradient(f, moving)]


def even(system, _):
    turned = substitute([system.lagrangian], {(x, 1): neg(sym(x, 1)) for x in system.q})[0]
    return [sub(system.lagrangian, turned)]


def autonomous(system, _):
    moving = [("t", 0)] + [(u, k) for u in system.controls for k in (0, 1)] + [(m, 0) for m in system.masses]
    return gradient(system.lagrangian, moving)


@says("refuted")
def chaplygin(cx, verdict):
    """Coordinates that neither L nor a constraint contains, as many as constraints and with velocities that these determine."""
    system = cx.system
    if verdict["verdict"] != "proved":
        return cx.counterexample(verdict, [e for f in system.top + [system.lagrangian] for e in gradient(f, system.jet(0))])
    slopes = {x: [gradient(f, [(x, 0)])[0] for f in system.top + [system.lagrangian]] for x in system.q}
    def at(p):
        absent = [i for i, x in enumerate(system.q) if all(p.value(e) == 0 for e in slopes[x])]
        rows = p.table(system.jacobian)
        r = rank(rows, p.p)
        return [] if rank([[row[i] for i in absent] for row in rows], p.p) == r else [1]
    return cx.identity(at)


@says("refuted")
def first_order(cx, verdict):
    holds = cx.system.order == 1
    return ("confirmed" if holds == (verdict["verdict"] == "proved") else "rejected"), f"the highest order is {cx.system.order}"


CLAIMS = {
    "model.constraints-scleronomic": polynomial(times), "model.lagrangian-even": polynomial(even),
    "model.lagrangian-autonomous": polynomial(autonomous), "model.forces-absent": polynomial(lambda system, _: system.force),
    "model.chaplygin": chaplygin, "model.constraints-first-order": first_order,
}
