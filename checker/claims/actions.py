"""`action.parametric`, `action.jacobi`: what they rest on, claims on equations that the record has (theory 1 §§5.4, 6.3, 6.4)."""
from claims.forms import equivalent
from claims.identities import parametric, parametric_canonical
from expressions import gradient


def all_of(cx, verdict, parts):
    for name, check in parts:
        outcome, why = check(cx, {**verdict, "subject": name})
        if outcome != "confirmed":
            return outcome, f"{name}: {why}"
    return "confirmed", why


def action_parametric(cx, verdict):
    return all_of(cx, verdict, [("parametric", equivalent), ("parametric", parametric), ("parametric-canonical", equivalent),
                                ("parametric-canonical", parametric_canonical)])


def action_jacobi(cx, verdict):
    """Hypotheses J1, J2, and that the equations of Jacobi's principle, changed back to the time, give the motion."""
    system = cx.system
    es = [*system.force, gradient(system.lagrangian, [("t", 0)])[0]]
    holds, why = cx.vanishes(lambda p: p.values(es), free=True)
    if not holds:
        return "rejected", "there are forces, or L contains the time"
    return all_of(cx, verdict, [("jacobi", equivalent)])


CLAIMS = {"action.parametric": action_parametric, "action.jacobi": action_jacobi}
