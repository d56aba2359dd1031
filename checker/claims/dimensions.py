"""Dimensions that sentences name: the set that motions reach, constants of motion and of the extremum (theory 1 §§3, 4.1)."""
import re

from fields import rank


def count(*said):
    """Dimensions that a sentence names: n - r of the set reached, 2 n - r constants of motion, 2 n of the extremum."""
    def check(cx, verdict):
        p, n = cx.system.point(cx.rng), len(cx.system.q)
        r = rank(p.table(cx.system.jacobian), p.p)
        for pattern, number in said:
            found = re.search(pattern, verdict["detail"])
            # Masses with a law of their own are states too.
            extra = len(cx.system.masses) if "constant" in pattern or "extremum" in pattern else 0
            if found and int(found[1]) != number(n, r) + extra:
                return "rejected", f"{number(n, r)}, not {found[1]}"
            if not found and pattern == said[0][0]:
                return "not checkable here", "no number is said"
        return "confirmed", f"n = {n}, r = {r} at a random point"
    return check


CLAIMS = {"hamilton.endpoints": count((r"a set of (\d+) dimension", lambda n, r: n - r)),
          "hamilton.constants": count((r"motion has (\d+) constant", lambda n, r: 2 * n - r), (r"extremum has (\d+)", lambda n, r: 2 * n))}
