"""Appell and Hamel: z' = rho sqrt(x'^2 + y'^2) under gravity; the horizontal speed falls uniformly."""

T_END = 1.0
LINEAR = False


def coordinates(n):
    return ["x", "y", "z"]


def start(n):
    import math

    return [0.0, 0.0, 0.0], [6 * math.cos(0.5), 6 * math.sin(0.5)]


def independent(n):
    return [0, 1]


def dependent(n):
    return [2]


def parameters(o):
    return o.num("1.3"), o.num("0.7"), o.num("9.81")


def energy(o, q, v):
    m, rho, g = parameters(o)
    return m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2 + m * g * q[2]


def lagrangian(o, q, v):
    m, rho, g = parameters(o)
    return m * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2 - m * g * q[2]


def constraints(o, q, v):
    rho = parameters(o)[1]
    return [v[2] - rho * o.sqrt(v[0] * v[0] + v[1] * v[1])]


class hand:
    @staticmethod
    def variables(n):
        return ["x", "y", "z", "vx", "vy"]

    @staticmethod
    def state(o, q, v):
        return [*q, v[0], v[1]]

    @staticmethod
    def velocities(o, z):
        return hand.rates(o, z)[:3]

    @staticmethod
    def rates(o, z):
        m, rho, g = parameters(o)
        s = o.sqrt(z[3] * z[3] + z[4] * z[4])
        k = (-g * rho / (1 + rho * rho)) / s
        return [z[3], z[4], rho * s, k * z[3], k * z[4]]
