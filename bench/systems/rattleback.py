"""The rattleback of Kane and Levinson (1982) without air; the hand form is the balance of moments about the point of contact, in body axes."""

T_END = 20.0


def coordinates(n):
    return ["x", "y", "ga", "al", "be"]


def start(n):
    import math

    tilt = math.pi / 360
    return [0.0, 0.0, 0.0, tilt, tilt], [-5.0, -5 * math.sin(tilt), 5 * math.sin(tilt)]


def independent(n):
    return [2, 3, 4]


def dependent(n):
    return [0, 1]


def parameters(o):
    names = ["1", "0.2", "0.03", "0.02", "0.01", "0.0002", "0.0016", "0.0017", "-0.00002", "9.81"]
    return [o.num(x) for x in names]


def geometry(o, q, v):
    m, a, b, c, h, A, B, C, D, g = parameters(o)
    sa, ca, sb, cb = o.sin(q[3]), o.cos(q[3]), o.sin(q[4]), o.cos(q[4])
    n = [-ca * sb, sa, ca * cb]
    w = [v[3] * cb - v[2] * ca * sb, v[4] + v[2] * sa, v[3] * sb + v[2] * ca * cb]
    H = o.sqrt(a * a * n[0] * n[0] + b * b * n[1] * n[1] + c * c * n[2] * n[2])
    r = [-a * a * n[0] / H, -b * b * n[1] / H, h - c * c * n[2] / H]
    return n, w, H, r, (sa, ca, sb, cb)


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def parts(o, q, v):
    m, a, b, c, h, A, B, C, D, g = parameters(o)
    n, w, H, r, _ = geometry(o, q, v)
    d = cross(n, w)
    vz = (a * a * n[0] * d[0] + b * b * n[1] * d[1] + c * c * n[2] * d[2]) / H - h * d[2]
    t = (
        m * (v[0] * v[0] + v[1] * v[1] + vz * vz)
        + A * w[0] * w[0]
        + B * w[1] * w[1]
        + C * w[2] * w[2]
        + 2 * D * w[0] * w[1]
    ) / 2
    return t, m * g * (H - h * n[2])


def energy(o, q, v):
    t, p = parts(o, q, v)
    return t + p


def lagrangian(o, q, v):
    t, p = parts(o, q, v)
    return t - p


def across(o, q, s, c):
    """Horizontal components of the vector c of the body axes."""
    sa, ca, sb, cb = s
    sg, cg = o.sin(q[2]), o.cos(q[2])
    # Along and across the heading first.
    x = cb * c[0] + sb * c[2]
    y = sa * sb * c[0] + ca * c[1] - sa * cb * c[2]
    return [cg * x - sg * y, sg * x + cg * y]


def constraints(o, q, v):
    n, w, H, r, s = geometry(o, q, v)
    x, y = across(o, q, s, cross(w, r))
    return [v[0] + x, v[1] + y]


class hand:
    @staticmethod
    def variables(n):
        return ["x", "y", "ga", "al", "be", "w1", "w2", "w3"]

    @staticmethod
    def state(o, q, v):
        return [*q, *geometry(o, q, v)[1]]

    @staticmethod
    def velocities(o, z):
        return hand.rates(o, z)[:5]

    @staticmethod
    def rates(o, z):
        m, a, b, c, h, A, B, C, D, g = parameters(o)
        w = z[5:8]
        sa, ca, sb, cb = o.sin(z[3]), o.cos(z[3]), o.sin(z[4]), o.cos(z[4])
        n = [-ca * sb, sa, ca * cb]
        aa, bb, cc = a * a, b * b, c * c
        H2 = aa * (n[0] * n[0]) + bb * (n[1] * n[1]) + cc * (n[2] * n[2])
        i = 1 / o.sqrt(H2)
        e = [aa * (n[0] * i), bb * (n[1] * i), cc * (n[2] * i)]
        r = [-e[0], -e[1], h - e[2]]
        d = cross(n, w)
        # H'/H
        k = (e[0] * d[0] + e[1] * d[1] + e[2] * d[2]) * i
        dr = [e[0] * k - aa * (d[0] * i), e[1] * k - bb * (d[1] * i), e[2] * k - cc * (d[2] * i)]
        u = cross(w, r)
        f = [x + y - g * t for x, y, t in zip(cross(w, dr), cross(w, u), n)]
        L = [A * w[0] + D * w[1], D * w[0] + B * w[1], C * w[2]]
        b1, b2, b3 = [-x - m * y for x, y in zip(cross(w, L), cross(r, f))]
        # Inertia about the point of contact: symmetric.
        xx, yy, zz = r[0] * r[0], r[1] * r[1], r[2] * r[2]
        m11, m22, m33 = A + m * (yy + zz), B + m * (xx + zz), C + m * (xx + yy)
        m12, m13, m23 = D - m * (r[0] * r[1]), -m * (r[0] * r[2]), -m * (r[1] * r[2])
        c11, c12, c13 = m22 * m33 - m23 * m23, m13 * m23 - m12 * m33, m12 * m23 - m13 * m22
        c22, c23, c33 = m11 * m33 - m13 * m13, m12 * m13 - m11 * m23, m11 * m22 - m12 * m12
        det = 1 / (m11 * c11 + m12 * c12 + m13 * c13)
        dga = (w[2] * cb - w[0] * sb) / ca
        x, y = across(o, z, (sa, ca, sb, cb), u)
        return [
            -x,
            -y,
            dga,
            w[0] * cb + w[2] * sb,
            w[1] - dga * sa,
            det * (c11 * b1 + c12 * b2 + c13 * b3),
            det * (c12 * b1 + c22 * b2 + c23 * b3),
            det * (c13 * b1 + c23 * b2 + c33 * b3),
        ]
