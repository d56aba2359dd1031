"""`equations.stated#NAME`: what a user states gives the motion, and nothing else. The record holds it among `equations` as `stated:NAME`."""
from claims.forms import equivalent


def stated(cx, verdict):
    return equivalent(cx, {**verdict, "subject": f"stated:{verdict['subject']}"})


CLAIMS = {"equations.stated": stated}
