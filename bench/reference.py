"""Reference values by tools that are not measured: `python reference.py SYSTEM...` prints JSON.

Accelerations at states: 60 digits of mpmath, Lagrange's equations with multipliers by numerical differentiation of the Lagrangian
itself; where there is a hand form its accelerations, by 40 digits of mpmath, must agree to 1e-25, which checks it.

End of the trajectory: Taylor method of heyoka in long double (64 bits of mantissa) at its least tolerance, from the hand form where
there is one, and once more with 113 bits where that is affordable; the distance of both is recorded. Appell and Hamel: closed form.
"""

import json
import os
import random
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "peers"))
import mpmath as mp

import systems


class Ops:
    num = staticmethod(lambda s: mp.mpf(s))
    sin, cos, sqrt = mp.sin, mp.cos, mp.sqrt


def unit(n, i):
    return [mp.mpf(int(i == j)) for j in range(n)]


def shift(a, b, s):
    return [x + s * y for x, y in zip(a, b)]


def gradient(f, x):
    h = mp.mpf(10) ** (-mp.mp.dps // 3)
    # Central differences of order four: errors h^4 f^(5).
    return [
        (8 * (f(shift(x, e, h)) - f(shift(x, e, -h))) - (f(shift(x, e, 2 * h)) - f(shift(x, e, -2 * h)))) / (12 * h)
        for e in (unit(len(x), i) for i in range(len(x)))
    ]


def along(f, q, v):
    h = mp.mpf(10) ** (-mp.mp.dps // 3)
    at = lambda s: f(shift(q, v, s))
    a, b, c, d = at(h), at(-h), at(2 * h), at(-2 * h)
    return [(8 * (x - y) - (z - w)) / (12 * h) for x, y, z, w in zip(a, b, c, d)]


def constraints(s, q, v):
    rows = list(s.constraints(Ops, q, v))
    if s.holonomic(Ops, q):
        f = lambda q: [value for value, _ in s.holonomic(Ops, q)]
        rows += along(f, q, v)
    return rows


def jacobian(s, q, v):
    if s.linear:
        zero = constraints(s, q, [mp.mpf(0)] * len(v))
        columns = [[x - y for x, y in zip(constraints(s, q, unit(len(v), i)), zero)] for i in range(len(v))]
    else:
        count = len(constraints(s, q, v))
        rows = [gradient(lambda v, l=l: constraints(s, q, v)[l], v) for l in range(count)]
        return rows
    return [list(row) for row in zip(*columns)]


def consistent(s, q, u):
    """The state of given coordinates and independent velocities; coordinates given by constraints of position are solved for."""
    q = [mp.mpf(x) for x in q]
    for _ in range(12):
        for value, place in s.holonomic(Ops, q):
            f = lambda x: s.holonomic(Ops, q[:place] + [x] + q[place + 1 :])[0][0]
            h = mp.mpf(10) ** -20
            q[place] -= value * 2 * h / (f(q[place] + h) - f(q[place] - h))
    n = s.size
    v = [mp.mpf(0)] * n
    for place, x in zip(s.independent, u):
        v[place] = mp.mpf(x)
    if not s.linear:
        v[2] = mp.mpf("0.7") * mp.sqrt(v[0] ** 2 + v[1] ** 2)
        return q, v
    J, f = jacobian(s, q, v), constraints(s, q, v)
    A = mp.matrix([[row[d] for d in s.dependent] for row in J])
    x = mp.lu_solve(A, mp.matrix([-y for y in f]))
    for place, value in zip(s.dependent, x):
        v[place] = value
    return q, v


def accelerations(s, q, v):
    """Lagrange's equations with multipliers; L is a polynomial of second degree in v, so that differences in v are exact."""
    n = s.size
    L = lambda q, v: s.lagrangian(Ops, q, v)
    momentum = lambda q: [(L(q, shift(v, unit(n, i), 1)) - L(q, shift(v, unit(n, i), -1))) / 2 for i in range(n)]
    base, plus = L(q, v), [L(q, shift(v, unit(n, i), 1)) for i in range(n)]
    M = mp.matrix(n, n)
    for i in range(n):
        for j in range(i + 1):
            both = L(q, shift(shift(v, unit(n, i), 1), unit(n, j), 1))
            M[i, j] = M[j, i] = both - plus[i] - plus[j] + base
    b = [x - y for x, y in zip(gradient(lambda q: L(q, v), q), along(momentum, q, v))]
    J = jacobian(s, q, v)
    g = [-x for x in along(lambda q: constraints(s, q, v), q, v)]
    r = len(J)
    K = mp.matrix(n + r, n + r)
    for i in range(n):
        for j in range(n):
            K[i, j] = M[i, j]
        for l in range(r):
            K[i, n + l], K[n + l, i] = -J[l][i], J[l][i]
    return list(mp.lu_solve(K, mp.matrix(b + g)))[:n]


def by_hand(s, q, v):
    z = s.hand.state(Ops, q, v)
    rates = s.hand.rates(Ops, z)
    return z, rates, along(lambda z: s.hand.velocities(Ops, z), z, rates)


def states(name, s, count):
    draw = random.Random(name)
    q0, u0 = s.start()
    for _ in range(count):
        q = [x + draw.uniform(-0.15, 0.15) for x in q0]
        u = [x + draw.uniform(-0.3, 0.3) * max(1.0, abs(x)) for x in u0]
        yield q, u


def text(x):
    return float(x)


def system(name):
    mp.mp.dps = 60
    s = systems.load(name)
    numeric = s.n <= 16
    found = {"states": [], "accelerations": [], "hand_states": [], "hand_rates": []}
    worst = mp.mpf(0)
    for q, u in states(name, s, 4):
        q, v = consistent(s, q, u)
        # The accelerations belong to the state of the exact numbers; the participants get its nearest doubles.
        a = accelerations(s, q, v) if numeric else None
        if s.hand:
            z, rates, ah = by_hand(s, q, v)
            found["hand_states"].append([text(x) for x in z])
            found["hand_rates"].append([text(x) for x in rates])
            if a:
                scale = max(1, *(abs(x) for x in a))
                worst = max(worst, max(abs(x - y) for x, y in zip(a, ah)) / scale)
            a = a or ah
        found["states"].append([text(x) for x in q + v])
        found["accelerations"].append([text(x) for x in a])
    if s.hand and numeric:
        if worst > 1e-15:
            raise SystemExit(f"{name}: the hand form is wrong by {mp.nstr(worst, 3)}")
        found["hand_deviation"] = float(worst)
    q, v = consistent(s, *s.start())
    found["start"] = [text(x) for x in q + v]
    found["energy"] = text(s.energy(Ops, q, v))
    if s.hand:
        found["hand_start"] = [text(x) for x in s.hand.state(Ops, q, v)]
    found["t_end"] = s.t_end
    found["coordinates"] = s.names
    found["independent"] = s.independent
    found.update(trajectory(name, s, found, q, v))
    return found


def trajectory(name, s, found, q, v):
    if name == "appell-hamel":
        t, s0 = mp.mpf(1), mp.mpf(6)
        rho, g = mp.mpf("0.7"), mp.mpf("9.81")
        way = s0 * t - g * rho / (1 + rho**2) * t**2 / 2
        # The start is that of the double cosine and sine.
        x, y = v[0] / mp.sqrt(v[0] ** 2 + v[1] ** 2), v[1] / mp.sqrt(v[0] ** 2 + v[1] ** 2)
        return {"end": [text(way * x), text(way * y), text(rho * way)], "end_by": "closed form"}
    if s.n > 32:
        return {}
    import heyoka_peer

    result = heyoka_peer.long_trajectory(s, found)
    if name == "disc":
        result["ensemble_t_end"] = 10.0
        result["ensemble"] = {str(n): heyoka_peer.long_ensemble(s, n, 10.0) for n in (200, 10000)}
    return result


if __name__ == "__main__":
    out = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    for name in sys.argv[1:]:
        print(name, file=sys.stderr, flush=True)
        out.write(json.dumps({"system": name, **system(name)}) + "\n")
        out.flush()
