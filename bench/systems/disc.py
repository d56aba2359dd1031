"""A thin rolling disc that may lean (Neimark, Fufaev 1972); Euler's equations about the centre, in axes that lean but do not roll."""

T_END = 100.0


def coordinates(n):
    return ["x", "y", "phi", "theta", "psi"]


def start(n):
    import math

    lean = 0.25
    return [0.0, 0.0, 0.4, lean, -0.3], [0.6 / math.cos(lean), 0.35, 7 - 0.6 * math.tan(lean)]


def independent(n):
    return [2, 3, 4]


def dependent(n):
    return [0, 1]


def parameters(o):
    m, r, g = o.num("2"), o.num("0.3"), o.num("9.81")
    return m, r, g, m * r * r / 4, m * r * r / 2


def parts(o, q, v):
    m, r, g, A, C = parameters(o)
    sp, cp, st, ct = o.sin(q[2]), o.cos(q[2]), o.sin(q[3]), o.cos(q[3])
    cx = v[0] + r * (v[2] * cp * st + v[3] * sp * ct)
    cy = v[1] + r * (v[2] * sp * st - v[3] * cp * ct)
    cz = -r * v[3] * st
    w2, w3 = v[4] + v[2] * st, v[2] * ct
    t = (m * (cx * cx + cy * cy + cz * cz) + A * (v[3] * v[3] + w3 * w3) + C * w2 * w2) / 2
    return t, m * g * r * ct


def energy(o, q, v):
    t, p = parts(o, q, v)
    return t + p


def lagrangian(o, q, v):
    t, p = parts(o, q, v)
    return t - p


def constraints(o, q, v):
    r = parameters(o)[1]
    return [v[0] - r * v[4] * o.cos(q[2]), v[1] - r * v[4] * o.sin(q[2])]


class hand:
    @staticmethod
    def variables(n):
        return ["x", "y", "phi", "theta", "psi", "w1", "w2", "w3"]

    @staticmethod
    def state(o, q, v):
        return [*q, v[3], v[4] + v[2] * o.sin(q[3]), v[2] * o.cos(q[3])]

    @staticmethod
    def velocities(o, z):
        return hand.rates(o, z)[:5]

    @staticmethod
    def rates(o, z):
        m, r, g, A, C = parameters(o)
        w1, w2, w3 = z[5], z[6], z[7]
        st, ct = o.sin(z[3]), o.cos(z[3])
        dphi = w3 / ct
        turn = dphi * st
        dpsi = w2 - turn
        I, c, k = A + m * r * r, C + m * r * r, m * g * r
        return [
            r * (dpsi * o.cos(z[2])),
            r * (dpsi * o.sin(z[2])),
            dphi,
            w1,
            dpsi,
            (c / I) * (w2 * w3) - (A / I) * (w3 * turn) + (k / I) * st,
            (-m * r * r / c) * (w1 * w3),
            w1 * (turn - (C / A) * w2),
        ]
