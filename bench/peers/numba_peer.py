"""Numba and SciPy: the hand form with a variable for each operation, jitted by Numba, integrated by SciPy's solve_ivp."""

import protocol
import numba
import numpy as np
import scipy.integrate
import systems
from systems import trace


def function(s, loop):
    z, steps, rates = trace.hand(s)
    lines = ["def f(t, z):" if not loop else "def f(rows, out):"]
    indent = "    "
    if loop:
        lines.append("    for k in range(rows.shape[0]):")
        indent = "        "
    for i, x in enumerate(z):
        lines.append("%s%s = %s" % (indent, x, "rows[k, %d]" % i if loop else "z[%d]" % i))
    lines += ["%s%s = %s" % (indent, x, e) for x, e in steps]
    if not loop:
        lines.append("    out = np.empty(%d)" % len(rates))
    target = "out[k, %d]" if loop else "out[%d]"
    lines += [("%s" + target + " = %s") % (indent, i, e) for i, e in enumerate(rates)]
    if not loop:
        lines.append("    return out")
    space = {"np": np}
    exec("from math import sin, cos, sqrt\n" + "\n".join(lines), space)
    return numba.njit(space["f"], fastmath=False)


def rhs(request):
    s = systems.load(request["system"])
    clock = protocol.Clock()
    f = function(s, True)
    states = np.array(request["hand_states"])
    count = 1024
    rows = np.array([states[i % len(states)] for i in range(count)]) * (1 + 1e-9 * np.arange(count)[:, None])
    out = np.zeros((count, states.shape[1]))
    f(states, out)
    compile_seconds = clock.lap()[0]
    answer = out[: len(states)].copy()
    return protocol.plain(answer), {"compile": compile_seconds}, lambda: protocol.per_unit(lambda: f(rows, out), count)


def trajectory(request):
    s = systems.load(request["system"])
    f = function(s, False)
    start = np.array(request["hand_start"])
    f(0.0, start)
    tolerance = max(request["tolerance"], 3e-14)
    found = {}

    def once():
        found["end"] = scipy.integrate.solve_ivp(
            f, (0.0, s.t_end), start, method=request["variant"], rtol=tolerance, atol=tolerance
        )

    once()
    end = found["end"]
    if end.status != 0:
        raise ArithmeticError(end.message)
    return protocol.plain([end.y[: s.size, -1]]), {"steps": len(end.t) - 1, "evaluations": int(end.nfev)}, lambda: protocol.per_unit(once, 1)


if __name__ == "__main__":
    protocol.serve({"rhs": rhs, "trajectory": trajectory})
