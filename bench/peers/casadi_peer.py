"""CasADi: derivatives of SX graphs, C code compiled by gcc -O3 -march=native, SUNDIALS' cvodes.

As its documentation recommends: SX for scalar formulas, `generate` and an external compiler for speed, `solve` and `ldl` of SX matrices.
"""

import os
import subprocess
import tempfile

import protocol
import casadi as ca
import numpy as np
import systems
from systems import ensemble

FLAGS = ["-O3", "-march=native", "-fPIC", "-shared"]


class Ops:
    num = float
    sin, cos, sqrt = ca.sin, ca.cos, ca.sqrt


def hand(s):
    z = ca.SX.sym("z", len(s.hand.variables(s.n)))
    return z, ca.vertcat(*s.hand.rates(Ops, [z[i] for i in range(z.numel())]))


def terms(s):
    n = s.size
    q, v = ca.SX.sym("q", n), ca.SX.sym("v", n)
    ql, vl = [q[i] for i in range(n)], [v[i] for i in range(n)]
    L = ca.SX(s.lagrangian(Ops, ql, vl))
    p = ca.gradient(L, v)
    M = ca.jacobian(p, v)
    b = ca.gradient(L, q) - ca.jtimes(p, q, v)
    f = ca.vertcat(*s.constraints(Ops, ql, vl))
    held = [phi for phi, _ in s.holonomic(Ops, ql)]
    if held:
        f = ca.vertcat(f, ca.jtimes(ca.vertcat(*held), q, v))
    J = ca.jacobian(f, v)
    g = -ca.jtimes(f, q, v)
    return q, v, M, b, J, g


def symmetric(A, b, amd=True):
    D, LT, p = ca.ldl(A, amd)
    return ca.ldl_solve(b, D, LT, p)


def reduced(s):
    """(state, rates), and accelerations as a function of (q, v)."""
    q, v, M, b, J, g = terms(s)
    n, ind, dep = s.size, s.independent, s.dependent
    X = ca.solve(J[:, dep], ca.horzcat(-J[:, ind], g))
    B, fixed = ca.SX(n, len(ind)), ca.SX(n, 1)
    for place, i in enumerate(ind):
        B[i, place] = 1
    for place, d in enumerate(dep):
        B[d, :] = X[place, :-1]
        fixed[d] = X[place, -1]
    acc = symmetric(B.T @ M @ B, B.T @ (b - M @ fixed))
    whole = B @ acc + fixed
    if not s.linear:
        return (ca.vertcat(q, v), ca.vertcat(v, whole)), (ca.vertcat(q, v), whole)
    u = ca.SX.sym("u", len(ind))
    velocities = B @ u
    free = ca.substitute(acc, v, velocities)
    return (ca.vertcat(q, u), ca.vertcat(velocities, free)), (ca.vertcat(q, v), whole)


def bordered(s):
    q, v, M, b, J, g = terms(s)
    n, r = s.size, J.size1()
    K = ca.vertcat(ca.horzcat(M, J.T), ca.horzcat(J, ca.SX(r, r)))
    # A permutation that is best for zeros would put a zero pivot first.
    whole = symmetric(K, ca.vertcat(b, g), False)[:n]
    return (ca.vertcat(q, v), ca.vertcat(v, whole)), (ca.vertcat(q, v), whole)


LOOP = """
#include <stdlib.h>
typedef double casadi_real;
typedef long long int casadi_int;
extern int f(const casadi_real** arg, casadi_real** res, casadi_int* iw, casadi_real* w, int mem);
extern int f_work(casadi_int*, casadi_int*, casadi_int*, casadi_int*);
void loop(const double* in, double* out, long count, long nin, long nout) {
  casadi_int a, r, i, w;
  f_work(&a, &r, &i, &w);
  const double** arg = malloc((a + 1) * sizeof(double*));
  double** res = malloc((r + 1) * sizeof(double*));
  casadi_int* iw = malloc((i + 1) * sizeof(casadi_int));
  double* work = malloc((w + 1) * sizeof(double));
  for (long k = 0; k < count; k++) {
    arg[0] = in + k * nin;
    res[0] = out + k * nout;
    f(arg, res, iw, work, 0);
  }
  free(arg); free(res); free(iw); free(work);
}
"""


def compiled(x, y, loop=True):
    """(the library, seconds of code generation and of gcc)."""
    import ctypes

    folder = tempfile.mkdtemp()
    clock = protocol.Clock()
    F = ca.Function("f", [x], [ca.densify(y)])
    here = os.getcwd()
    os.chdir(folder)
    F.generate("f.c")
    os.chdir(here)
    generated = clock.lap()
    sources = [folder + "/f.c"]
    if loop:
        with open(folder + "/loop.c", "w") as out:
            out.write(LOOP)
        sources.append(folder + "/loop.c")
    subprocess.run(["gcc", *FLAGS, "-o", folder + "/f.so", *sources, "-lm"], check=True)
    built = clock.lap()
    return (folder + "/f.so", generated, built, ctypes.CDLL(folder + "/f.so") if loop else None)


def derive(request):
    s = systems.load(request["system"])

    def measure():
        clock = protocol.Clock()
        if request["form"] == "hand":
            x, y = hand(s)
            point = request["hand_states"][0]
        elif request["variant"] == "bordered":
            x, y = bordered(s)[1]
            point = request["states"][0]
        else:
            x, y = reduced(s)[1]
            point = request["states"][0]
        derived_in = clock.lap()
        library, generated, built, _ = compiled(x, y, loop=False)
        F = ca.external("f", library)
        value = F(ca.DM(point))
        first = clock.lap()
        return {
            "seconds": derived_in[0] + first[0],
            "wall": derived_in[1] + first[1],
            "parts": {"derive": derived_in[0], "compile": generated[0] + built[0]},
            "answer": [[float(a) for a in np.array(value).ravel()]],
        }

    return None, {}, measure


def rhs(request):
    import ctypes

    s = systems.load(request["system"])
    if request["form"] == "hand":
        x, y = hand(s)
        states, check = request["hand_states"], (x, y)
    else:
        (x, y), check = bordered(s) if request["variant"] == "bordered" else reduced(s)
        states = request["states"]
    answer = [np.array(ca.Function("c", [check[0]], [check[1]])(ca.DM(p))).ravel() for p in states]
    if request["form"] != "hand" and x.numel() != 2 * s.size:
        states = [p[: s.size] + [p[s.size + i] for i in s.independent] for p in states]
    _, generated, built, library = compiled(x, y)
    count = 1024
    rows = np.array([states[i % len(states)] for i in range(count)]) * (1 + 1e-9 * np.arange(count)[:, None])
    rows = np.ascontiguousarray(rows)
    out = np.zeros((count, y.numel()))
    at = lambda a: a.ctypes.data_as(ctypes.c_void_p)
    arguments = (at(rows), at(out), ctypes.c_long(count), ctypes.c_long(x.numel()), ctypes.c_long(y.numel()))
    work = lambda: library.loop(*arguments)
    info = {"instructions": ca.Function("c", [x], [y]).n_instructions(), "compile": generated[0] + built[0]}
    return protocol.plain(answer), info, lambda: protocol.per_unit(work, count)


def integrator(s, request, t_end):
    x, y = hand(s) if request["form"] == "hand" else reduced(s)[0]
    tolerance = request["tolerance"]
    options = {"abstol": tolerance, "reltol": tolerance, "max_num_steps": 1000000}
    return ca.integrator("i", "cvodes", {"x": x, "ode": y}, 0.0, t_end, options)


def trajectory(request):
    s = systems.load(request["system"])
    F = integrator(s, request, s.t_end)
    n, x = s.size, request["start"]
    start = request["hand_start"] if request["form"] == "hand" else x[:n] + [x[n + i] for i in s.independent]
    found = {}

    def once():
        found["end"] = F(x0=start)["xf"]

    once()
    answer = [list(np.array(found["end"]).ravel()[:n])]
    return protocol.plain(answer), {}, lambda: protocol.per_unit(once, 1)


if __name__ == "__main__":
    protocol.serve({"derive": derive, "rhs": rhs, "trajectory": trajectory})
