"""`formulation.equivalent`: the motion satisfies the equations of a formulation, and they leave no other.

At a random admissible state the checker's own motion is put into the equations of the record: the variables of their state are what they
are defined to be, their rates are those along the motion. Other unknowns (multipliers, accelerations beside a state of momenta)
must exist as numbers. Then the equations must determine the rates: the rank of their matrix by all unknowns exceeds that by the
others by the number of rates, where an equation without unknowns counts by its own rate.
"""
from equations import Form
from expressions import NotCheckable
from fields import rank, solve


def determines(system, form):
    """What vanishes at a point where the motion satisfies the equations and they leave no other rates."""
    places = [len(form.rates) + form.others.index(s) for s in form.free]

    def at(p):
        same = form.put(system, p)
        # Only the energy of Jacobi's principle is a variable without an equation: it is constant, for want of a rate.
        steady = [p.curves[s[0]][1] if s[0].rstrip("_") == "h" else 1 for s in form.constant]
        for s in form.free:
            p.jets[s] = [0, 0]
        values = p.values(form.residuals)
        matrix = p.table(form.rows)
        others = [[0] * len(form.others) if c else row[len(form.rates):] for row, c in zip(matrix, form.is_condition)]
        exists = solve([[0 if c else row[k] for k in places] for row, c in zip(matrix, form.is_condition)], [-y for y in values], p.p)
        determined = rank(matrix, p.p) - rank(others, p.p) == len(form.rates)
        return same + steady + ([] if exists is not None and determined else [1])

    return at


def equivalent(cx, verdict):
    entry, system = cx.equations.get(verdict["subject"]), cx.system
    if verdict["verdict"] != "proved":
        raise NotCheckable("only proved equivalence is examined")
    if entry is None or entry["omitted"]:
        raise NotCheckable("the equations are not in the record")
    form = Form(system, entry)
    return cx.identity(determines(system, form), form.residuals)


CLAIMS = {"formulation.equivalent": equivalent}
