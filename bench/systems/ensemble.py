"""The members of an ensemble of discs: lean and spin vary."""

import math


class Ops:
    num = float
    sin, cos, sqrt = math.sin, math.cos, math.sqrt


def fraction(x):
    return x - math.floor(x)


def start(i):
    """(q, u) of member i, by the golden ratio and the root of two."""
    lean = 0.2 + 0.1 * fraction(0.6180339887 * i)
    spin = 6.5 + fraction(0.4142135624 * i)
    return [0.0, 0.0, 0.4, lean, -0.3], [0.6, 0.35, spin]


def hand_starts(s, count):
    found = []
    for i in range(count):
        q, (dphi, dtheta, dpsi) = start(i)
        v = [0.3 * dpsi * math.cos(q[2]), 0.3 * dpsi * math.sin(q[2]), dphi, dtheta, dpsi]
        found.append(s.hand.state(Ops, q, v))
    return found


def checked(count):
    """The members whose ends are compared with the reference."""
    return range(0, count, max(1, count // 20))
