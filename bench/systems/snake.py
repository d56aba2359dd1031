"""A chain of n equal links in the plane, each with a blade under its mass centre; (x, y) is that of the first.

The hinges are 0.25 ahead of a blade and 0.15 behind it, and a spring in each straightens the chain. Hand form: speed u and yaw rate w of a link follow from those of the link
before it, and so do their rates; two independent velocities remain, and cost grows like n.
"""

T_END = 20.0


def coordinates(n):
    return ["x", "y"] + [f"th_{i}" for i in range(1, n + 1)]


def start(n):
    import math

    angles = [0.2 * math.sin(0.7 * i) for i in range(1, n + 1)]
    return [0.0, 0.0, *angles], [0.9, 0.3]


def independent(n):
    return [0, 2]


def dependent(n):
    return [1] + list(range(3, n + 2))


def parameters(o):
    # Mass, moment of inertia, hinge ahead, hinge behind.
    return o.num("0.5"), o.num("0.01"), o.num("0.25"), o.num("0.15")


def springs(o, q):
    k = o.num("0.3")
    total = 0
    for i in range(2, len(q) - 1):
        total = total + k * (q[i] - q[i + 1]) * (q[i] - q[i + 1]) / 2
    return total


def kinetic(o, q, v):
    m, J, a, b = parameters(o)
    x, y = v[0], v[1]
    total = 0
    before = None
    for i in range(len(q) - 2):
        here = (v[2 + i] * o.sin(q[2 + i]), v[2 + i] * o.cos(q[2 + i]))
        if before is not None:
            x = x + b * before[0] + a * here[0]
            y = y - b * before[1] - a * here[1]
        before = here
        total = total + m * (x * x + y * y) + J * v[2 + i] * v[2 + i]
    return total / 2


def energy(o, q, v):
    return kinetic(o, q, v) + springs(o, q)


def lagrangian(o, q, v):
    return kinetic(o, q, v) - springs(o, q)


def constraints(o, q, v):
    m, J, a, b = parameters(o)
    x, y = v[0], v[1]
    before = None
    found = []
    for i in range(len(q) - 2):
        s, c = o.sin(q[2 + i]), o.cos(q[2 + i])
        here = (v[2 + i] * s, v[2 + i] * c)
        if before is not None:
            x = x + b * before[0] + a * here[0]
            y = y - b * before[1] - a * here[1]
        before = here
        found.append(y * c - x * s)
    return found


class hand:
    @staticmethod
    def variables(n):
        return coordinates(n) + ["u", "w"]

    @staticmethod
    def state(o, q, v):
        return [*q, v[0] * o.cos(q[2]) + v[1] * o.sin(q[2]), v[2]]

    @staticmethod
    def velocities(o, z):
        return hand.rates(o, z)[:-2]

    @staticmethod
    def rates(o, z):
        m, J, a, b = parameters(o)
        n = len(z) - 4
        th = z[2 : 2 + n]
        u, w = z[-2], z[-1]
        # (u, w) of a link are g and h times (u, w) of the first; p, r are what their rates have beside that.
        g, h = (1, 0), (0, 1)
        p, r = 0, 0
        m11, m12, m22 = m, 0, J
        f1, f2 = 0, 0
        stiffness = o.num("0.3")
        turns = [w]
        for i in range(1, n):
            d = th[i - 1] - th[i]
            s, c = o.sin(d), o.cos(d)
            bs, sa, ca = b * s, s / a, (b / a) * c
            u1, w1 = u * c + w * bs, u * sa - w * ca
            last = h
            g, h = (
                (g[0] * c + h[0] * bs, g[1] * c + h[1] * bs),
                (g[0] * sa - h[0] * ca, g[1] * sa - h[1] * ca),
            )
            dd = w - w1
            p, r = p * c + r * bs - a * (dd * w1), p * sa - r * ca + (1 / a) * (dd * u1)
            u, w = u1, w1
            turns.append(w)
            e, k = (m * g[0], m * g[1]), (J * h[0], J * h[1])
            m11, m12, m22 = (
                m11 + e[0] * g[0] + k[0] * h[0],
                m12 + e[0] * g[1] + k[0] * h[1],
                m22 + e[1] * g[1] + k[1] * h[1],
            )
            f1, f2 = f1 - e[0] * p - k[0] * r, f2 - e[1] * p - k[1] * r
            t = stiffness * d
            f1, f2 = f1 + t * (h[0] - last[0]), f2 + t * (h[1] - last[1])
        det = 1 / (m11 * m22 - m12 * m12)
        return [
            z[-2] * o.cos(th[0]),
            z[-2] * o.sin(th[0]),
            *turns,
            det * (m22 * f1 - m12 * f2),
            det * (m11 * f2 - m12 * f1),
        ]
