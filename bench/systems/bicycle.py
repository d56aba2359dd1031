"""Whipple's bicycle with the parameters of Meijaard, Papadopoulos, Ruina, Schwab (2007).

Coordinates and bodies as in the gallery: yaw, lean and pitch of the rear frame, steer, angles of the wheels; the rear contact is
built into the coordinates, the front contact is a constraint of position. Nobody has compact equations by hand.
"""

T_END = 2.0


def coordinates(n):
    return ["x", "y", "psi", "phi", "theta", "delta", "thR", "thF"]


def start(n):
    return [0.0] * 8, [0.5, 0.0, 5 / 0.3]


def independent(n):
    return [3, 5, 6]


def dependent(n):
    # In the order of the constraints: both of the rear wheel, both of the front wheel, the front contact.
    return [0, 1, 7, 2, 4]


def sq(x):
    return x * x


def parts(o, q, v):
    """Everything named in the model file."""
    num = o.num
    w, c, g = num("1.02"), num("0.08"), num("9.81")
    # cos and sin of pi/10, the tilt of the steering axis.
    s_lam = (o.sqrt(num("5")) - 1) / 4
    c_lam = o.sqrt(1 - s_lam * s_lam)
    rR, mR, IRxx, IRyy = num("0.3"), num("2"), num("0.0603"), num("0.12")
    xB, zB, mB = num("0.3"), num("-0.9"), num("85")
    IBxx, IByy, IBzz, IBxz = num("9.2"), num("11"), num("2.8"), num("2.4")
    xH, zH, mH = num("0.9"), num("-0.7"), num("4")
    IHxx, IHyy, IHzz, IHxz = num("0.05892"), num("0.06"), num("0.00708"), num("-0.00756")
    rF, mF, IFxx, IFyy = num("0.35"), num("3"), num("0.1405"), num("0.28")
    s_psi, c_psi, s_phi, c_phi = o.sin(q[2]), o.cos(q[2]), o.sin(q[3]), o.cos(q[3])
    s_theta, c_theta, s_delta, c_delta = o.sin(q[4]), o.cos(q[4]), o.sin(q[5]), o.cos(q[5])
    d_x, d_y, d_psi, d_phi, d_theta, d_delta, d_thR, d_thF = v
    o1 = d_phi
    o2 = d_psi*s_phi
    o3 = d_psi*c_phi
    u1 = d_x*c_psi + d_y*s_psi
    u2 = d_y*c_psi - d_x*s_psi
    vR1 = u1 - rR*o2
    vR2 = u2*c_phi + rR*o1
    vR3 = -u2*s_phi
    b1 = o1*c_theta - o3*s_theta
    b2 = o2 + d_theta
    b3 = o1*s_theta + o3*c_theta
    c1 = vR1*c_theta - vR3*s_theta
    c3 = vR1*s_theta + vR3*c_theta
    vB1 = c1 + b2*(zB + rR)
    vB2 = vR2 + b3*xB - b1*(zB + rR)
    vB3 = c3 - b2*xB
    vS1 = c1 + b2*rR
    vS2 = vR2 + b3*(w + c) - b1*rR
    vS3 = c3 - b2*(w + c)
    k1 = b1*c_lam - b3*s_lam
    k3 = b1*s_lam + b3*c_lam + d_delta
    m1 = k1*c_delta + b2*s_delta
    h2 = b2*c_delta - k1*s_delta
    h1 = m1*c_lam + k3*s_lam
    h3 = k3*c_lam - m1*s_lam
    p1 = vS1*c_lam - vS3*s_lam
    p3 = vS1*s_lam + vS3*c_lam
    s1 = p1*c_delta + vS2*s_delta
    f2 = vS2*c_delta - p1*s_delta
    f1 = s1*c_lam + p3*s_lam
    f3 = p3*c_lam - s1*s_lam
    vH1 = f1 + h2*zH
    vH2 = f2 + h3*(xH - w - c) - h1*zH
    vH3 = f3 - h2*(xH - w - c)
    vF1 = f1 - h2*rF
    vF2 = f2 - h3*c + h1*rF
    vF3 = f3 + h2*c
    z1 = -c_phi*s_theta
    z3 = c_phi*c_theta
    n1 = z1*c_lam - z3*s_lam
    n3 = z1*s_lam + z3*c_lam
    n4 = n1*c_delta + s_phi*s_delta
    e2 = s_phi*c_delta - n1*s_delta
    e1 = n4*c_lam + n3*s_lam
    e3 = n3*c_lam - n4*s_lam
    N = o.sqrt(sq(e1) + sq(e3))
    zR = -rR*c_phi
    zBody = zR + xB*z1 + (zB + rR)*z3
    zS = zR + (w + c)*z1 + rR*z3
    zFork = zS + (xH - w - c)*e1 + zH*e3
    zFront = zS - c*e1 - rF*e3
    q1 = vF1 + (h2 - d_thF)*rF*e3/N
    q2 = vF2 + (h3*e1 - h1*e3)*rF/N
    q3 = vF3 - (h2 - d_thF)*rF*e1/N
    T = mR*(sq(vR1) + sq(vR2) + sq(vR3))/2 + mB*(sq(vB1) + sq(vB2) + sq(vB3))/2 + mH*(sq(vH1) + sq(vH2) + sq(vH3))/2 + mF*(sq(vF1) + sq(vF2) + sq(vF3))/2 + (IRxx*(sq(b1) + sq(b3)) + IRyy*sq((b2 - d_thR)))/2 + (IBxx*sq(b1) + IByy*sq(b2) + IBzz*sq(b3) + 2*IBxz*b1*b3)/2 + (IHxx*sq(h1) + IHyy*sq(h2) + IHzz*sq(h3) + 2*IHxz*h1*h3)/2 + (IFxx*(sq(h1) + sq(h3)) + IFyy*sq((h2 - d_thF)))/2
    V = -g*(mR*zR + mB*zBody + mH*zFork + mF*zFront)
    across = N * q2 - e2 * (e1 * q1 + e3 * q3) / N
    rolling = [u1 - rR * (d_thR - d_theta), u2, (q1 * e3 - q3 * e1) / N, across]
    return T, V, rolling, zFront + rF * N


def energy(o, q, v):
    T, V, _, _ = parts(o, q, v)
    return T + V


def lagrangian(o, q, v):
    T, V, _, _ = parts(o, q, v)
    return T - V


def constraints(o, q, v):
    return parts(o, q, v)[2]


def holonomic(o, q):
    zero = [0 * q[2]] * 8
    return [(parts(o, q, zero)[3], 4)]
