"""Chaplygin's sleigh; (x, y) is the point of contact of the blade, the mass centre a ahead of it (Neimark, Fufaev 1972)."""

T_END = 100.0


def coordinates(n):
    return ["x", "y", "phi"]


def start(n):
    return [0.0, 0.0, 0.0], [0.0, 2.1]


def independent(n):
    return [0, 2]


def dependent(n):
    return [1]


def parameters(o):
    return o.num("1.5"), o.num("0.4"), o.num("0.25")


def energy(o, q, v):
    m, J, a = parameters(o)
    s, c = o.sin(q[2]), o.cos(q[2])
    cx, cy = v[0] - a * v[2] * s, v[1] + a * v[2] * c
    return (m * (cx * cx + cy * cy) + J * v[2] * v[2]) / 2


def lagrangian(o, q, v):
    return energy(o, q, v)


def constraints(o, q, v):
    return [v[1] * o.cos(q[2]) - v[0] * o.sin(q[2])]


class hand:
    @staticmethod
    def variables(n):
        return ["x", "y", "phi", "u", "w"]

    @staticmethod
    def state(o, q, v):
        return [*q, v[0] * o.cos(q[2]) + v[1] * o.sin(q[2]), v[2]]

    @staticmethod
    def velocities(o, z):
        return [z[3] * o.cos(z[2]), z[3] * o.sin(z[2]), z[4]]

    @staticmethod
    def rates(o, z):
        m, J, a = parameters(o)
        u, w = z[3], z[4]
        k = m * a / (J + m * a * a)
        return [u * o.cos(z[2]), u * o.sin(z[2]), w, a * (w * w), -k * (u * w)]
