"""SymPy: Kane's method from bodies, frames and points as its documentation shows it, then cse and lambdify.

Dependent speeds are listed in the order of the constraints, with pivots that do not vanish at the states measured; another order can
lose every digit (it is no fault of the user's that no warning comes).
"""

import protocol
import numpy as np
import sympy as sp
import sympy.physics.mechanics as me
import systems

N = lambda s: sp.Float(s, 17) if "." in s else sp.Integer(s)


class Ops:
    num = staticmethod(N)
    sin, cos, sqrt = sp.sin, sp.cos, sp.sqrt


def kinematics(s):
    q = me.dynamicsymbols(" ".join(s.names))
    u = me.dynamicsymbols(" ".join("u_" + x for x in s.names))
    t = me.dynamicsymbols._t
    return list(q), list(u), [x.diff(t) for x in q]


def sleigh(s, q, u):
    m, J, a = s.module.parameters(Ops)
    E, B = me.ReferenceFrame("E"), me.ReferenceFrame("B")
    B.orient_axis(E, E.z, q[2])
    B.set_ang_vel(E, u[2] * E.z)
    O, P = me.Point("O"), me.Point("P")
    O.set_vel(E, 0)
    P.set_vel(E, u[0] * E.x + u[1] * E.y)
    G = P.locatenew("G", a * B.x)
    G.v2pt_theory(P, E, B)
    body = me.RigidBody("body", G, B, m, (me.inertia(B, 0, 0, J), G))
    return E, [body], [], [P.vel(E).dot(B.y)]


def disc(s, q, u):
    m, r, g, A, C = s.module.parameters(Ops)
    E, H, L, D = (me.ReferenceFrame(x) for x in "EHLD")
    H.orient_axis(E, E.z, q[2])
    H.set_ang_vel(E, u[2] * E.z)
    L.orient_axis(H, H.x, q[3])
    L.set_ang_vel(H, u[3] * H.x)
    D.orient_axis(L, L.y, q[4])
    D.set_ang_vel(L, u[4] * L.y)
    P = me.Point("P")
    P.set_vel(E, u[0] * E.x + u[1] * E.y)
    G = P.locatenew("G", r * L.z)
    # The contact moves along the rim; the centre keeps its place in the leaning axes.
    G.v2pt_theory(P, E, L)
    body = me.RigidBody("disc", G, D, m, (me.inertia(L, A, C, A), G))
    contact = G.vel(E) + D.ang_vel_in(E).cross(-r * L.z)
    return E, [body], [(G, -m * g * E.z)], [contact.dot(E.x), contact.dot(E.y)]


def rattleback(s, q, u):
    m, a, b, c, h, A, B, C, D, g = s.module.parameters(Ops)
    E, F, K, S = (me.ReferenceFrame(x) for x in "EFKS")
    F.orient_axis(E, E.z, q[2])
    F.set_ang_vel(E, u[2] * E.z)
    K.orient_axis(F, F.x, q[3])
    K.set_ang_vel(F, u[3] * F.x)
    S.orient_axis(K, K.y, q[4])
    S.set_ang_vel(K, u[4] * K.y)
    n = [E.z.dot(x) for x in S]
    H = sp.sqrt(a**2 * n[0] ** 2 + b**2 * n[1] ** 2 + c**2 * n[2] ** 2)
    r = -a * a * n[0] / H * S.x - b * b * n[1] / H * S.y + (h - c * c * n[2] / H) * S.z
    w = S.ang_vel_in(E)
    G = me.Point("G")
    # The height of the mass centre is H - h n3; its rate follows from the rolling.
    rel = w.cross(r)
    G.set_vel(E, u[0] * E.x + u[1] * E.y - rel.dot(E.z) * E.z)
    body = me.RigidBody("stone", G, S, m, (me.inertia(S, A, B, C, D), G))
    return E, [body], [(G, -m * g * E.z)], [(G.vel(E) + rel).dot(E.x), (G.vel(E) + rel).dot(E.y)]


def snake(s, q, u):
    m, J, a, b = s.module.parameters(Ops)
    E = me.ReferenceFrame("E")
    bodies, rows, loads = [], [], []
    k = N("0.3")
    before = None
    for i in range(s.n):
        L = me.ReferenceFrame("L%d" % i)
        L.orient_axis(E, E.z, q[2 + i])
        L.set_ang_vel(E, u[2 + i] * E.z)
        G = me.Point("G%d" % i)
        if before is None:
            G.set_vel(E, u[0] * E.x + u[1] * E.y)
        else:
            H = before[0].locatenew("H%d" % i, -b * before[1].x)
            H.v2pt_theory(before[0], E, before[1])
            G = H.locatenew("G%d" % i, -a * L.x)
            G.v2pt_theory(H, E, L)
            torque = k * (q[1 + i] - q[2 + i]) * E.z
            loads += [(L, torque), (before[1], -torque)]
        bodies.append(me.RigidBody("link%d" % i, G, L, m, (me.inertia(L, 0, 0, J), G)))
        rows.append(G.vel(E).dot(L.y))
        before = (G, L)
    return E, bodies, loads, rows


def bicycle(s, q, u):
    w, c, g = N("1.02"), N("0.08"), N("9.81")
    lam = sp.pi / 10
    rR, rF = N("0.3"), N("0.35")
    E, Y, X, R, T, D, F, WR, WF = (me.ReferenceFrame(x) for x in ["E", "Y", "X", "R", "T", "D", "F", "WR", "WF"])
    # z points down.
    for child, parent, axis, k in [(Y, E, E.z, 2), (X, Y, Y.x, 3), (R, X, X.y, 4)]:
        child.orient_axis(parent, axis, q[k])
        child.set_ang_vel(parent, u[k] * axis)
    T.orient_axis(R, R.y, lam)
    T.set_ang_vel(R, 0)
    D.orient_axis(T, T.z, q[5])
    D.set_ang_vel(T, u[5] * T.z)
    F.orient_axis(D, D.y, -lam)
    F.set_ang_vel(D, 0)
    WR.orient_axis(R, R.y, -q[6])
    WR.set_ang_vel(R, -u[6] * R.y)
    WF.orient_axis(F, F.y, -q[7])
    WF.set_ang_vel(F, -u[7] * F.y)
    O, P = me.Point("O"), me.Point("P")
    O.set_vel(E, 0)
    P.set_pos(O, q[0] * E.x + q[1] * E.y)
    P.set_vel(E, u[0] * E.x + u[1] * E.y)
    hub = P.locatenew("hub", -rR * X.z)
    hub.v2pt_theory(P, E, X)
    B = hub.locatenew("B", N("0.3") * R.x + (N("-0.9") + rR) * R.z)
    B.v2pt_theory(hub, E, R)
    S = hub.locatenew("S", (w + c) * R.x + rR * R.z)
    S.v2pt_theory(hub, E, R)
    H = S.locatenew("H", (N("0.9") - w - c) * F.x + N("-0.7") * F.z)
    H.v2pt_theory(S, E, F)
    front = S.locatenew("front", -c * F.x - rF * F.z)
    front.v2pt_theory(S, E, F)
    e1, e3 = E.z.dot(F.x), E.z.dot(F.z)
    root = sp.sqrt(e1**2 + e3**2)
    Q = front.locatenew("Q", rF * (e1 * F.x + e3 * F.z) / root)
    slip = front.vel(E) + WF.ang_vel_in(E).cross(Q.pos_from(front))
    rear = hub.vel(E) + WR.ang_vel_in(E).cross(rR * X.z)
    ahead = (F.y.cross(E.z)) / root
    bodies = [
        me.RigidBody("rear wheel", hub, WR, N("2"), (me.inertia(R, N("0.0603"), N("0.12"), N("0.0603")), hub)),
        me.RigidBody("rear frame", B, R, N("85"), (me.inertia(R, N("9.2"), N("11"), N("2.8"), 0, 0, N("2.4")), B)),
        me.RigidBody("fork", H, F, N("4"), (me.inertia(F, N("0.05892"), N("0.06"), N("0.00708"), 0, 0, N("-0.00756")), H)),
        me.RigidBody("front wheel", front, WF, N("3"), (me.inertia(F, N("0.1405"), N("0.28"), N("0.1405")), front)),
    ]
    loads = [(x.masscenter, x.mass * g * E.z) for x in bodies]
    contact = Q.pos_from(O).dot(E.z)
    t = me.dynamicsymbols._t
    touch = contact.diff(t).subs({x.diff(t): y for x, y in zip(q, u)})
    rows = [rear.dot(Y.x), rear.dot(Y.y), slip.dot(ahead), slip.dot(ahead.cross(E.z)), touch]
    return E, bodies, loads, rows


BODIES = {"sleigh": sleigh, "disc": disc, "rattleback": rattleback, "snake": snake, "bicycle": bicycle}


def kane(s, name):
    q, u, qd = kinematics(s)
    E, bodies, loads, rows = BODIES[name.partition("-")[0]](s, q, u)
    ind = [u[i] for i in s.independent]
    dep = [u[i] for i in s.dependent]
    method = me.KanesMethod(
        E, q_ind=q, u_ind=ind, u_dependent=dep, velocity_constraints=rows, kd_eqs=[x - y for x, y in zip(u, qd)]
    )
    method.kanes_equations(bodies, loads or None)
    return q, u, ind + dep, method


def function(s, name):
    q, u, order, method = kane(s, name)
    return q, u, order, method.mass_matrix, method.forcing


def derive(request):
    name = request["system"]
    s = systems.load(name)
    point = request["states"][0]

    def measure():
        sp.core.cache.clear_cache()
        clock = protocol.Clock()
        q, u, order, M, f = function(s, name)
        derived = clock.lap()
        compiled = sp.lambdify([*q, *u], [M, f], cse=True)
        A, b = compiled(*point)
        x = np.linalg.solve(np.array(A, float), np.array(b, float)).ravel()
        built = clock.lap()
        a = [0.0] * s.size
        for place, symbol in enumerate(order):
            a[u.index(symbol)] = float(x[place])
        return {
            "seconds": derived[0] + built[0],
            "wall": derived[1] + built[1],
            "parts": {"derive": derived[0], "compile": built[0]},
            "answer": [a],
        }

    return None, {}, measure


if __name__ == "__main__":
    protocol.serve({"derive": derive})
