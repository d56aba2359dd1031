"""`equations.stated#NAME`: with the constraints, the equations that the model states give the motion and nothing else.

The lowered model has them as `[equations.NAME]`; they are read as a formulation whose state is q'. What is refuted does not give the motion
at a random state: the motion fails them, or they leave accelerations open.
"""
from claims.forms import determines
from equations import Form
from expressions import NotCheckable, says


@says("refuted")
def stated(cx, verdict):
    entry = cx.system.equations.get(verdict["subject"])
    if entry is None:
        raise NotCheckable("the lowered model does not have these equations")
    texts = entry["equations"] if isinstance(entry, dict) else entry
    texts = [*(texts.values() if isinstance(texts, dict) else texts), *cx.system.constraint_texts]
    form = Form(cx.system, {
        "state": [{"name": x + "'", "definition": x + "'"} for x in cx.system.q], "definitions": [], "equations": texts,
        "velocities": [x + "'" for x in cx.system.q], "unknowns": [*(entry.get("unknowns", []) if isinstance(entry, dict) else []), *("lambda_" + c for c in cx.system.constraint_names)]})
    holds, why = cx.vanishes(determines(cx.system, form), form.residuals)
    if verdict["verdict"] == "refuted":
        slip = cx.slip_of_counterexample(verdict)
        return ("rejected", slip) if slip else ("rejected", why) if holds else ("confirmed", f"the motion is not what they give: {why}")
    return ("confirmed" if holds else "rejected"), why


CLAIMS = {"equations.stated": stated}
