"""The hand form as C with a variable for each operation, compiled by gcc -O3 -march=native; one state at a time."""

import ctypes
import os
import subprocess
import tempfile

import protocol
import numpy as np
import systems
from systems import trace


def code(s):
    z, steps, rates = trace.hand(s)
    inside = ["const double %s = in[%d];" % (x, i) for i, x in enumerate(z)]
    inside += ["const double %s = %s;" % step for step in steps]
    inside += ["out[%d] = %s;" % (i, e) for i, e in enumerate(rates)]
    body = "\n  ".join(inside)
    return (
        "#include <math.h>\n__attribute__((noinline)) void f(const double* restrict in, double* restrict out) {\n  "
        + body
        + "\n}\nvoid loop(const double* in, double* out, long count) {\n"
        + "  for (long k = 0; k < count; k++) f(in + k * %d, out + k * %d);\n}\n" % (len(z), len(rates))
    )


def built(s):
    folder = tempfile.mkdtemp()
    with open(folder + "/f.c", "w") as out:
        out.write(code(s))
    subprocess.run(
        ["gcc", "-O3", "-march=native", "-fno-math-errno", "-fPIC", "-shared", "-o", folder + "/f.so", folder + "/f.c", "-lm"],
        check=True,
    )
    return ctypes.CDLL(folder + "/f.so")


def rhs(request):
    s = systems.load(request["system"])
    clock = protocol.Clock()
    library = built(s)
    compile_seconds = clock.lap()[0]
    states = request["hand_states"]
    count, width = 1024, len(states[0])
    rows = np.ascontiguousarray(
        np.array([states[i % len(states)] for i in range(count)]) * (1 + 1e-9 * np.arange(count)[:, None])
    )
    out = np.zeros((count, width))
    at = lambda a: a.ctypes.data_as(ctypes.c_void_p)
    checks = np.ascontiguousarray(np.array(states))
    library.loop(at(checks), at(out), ctypes.c_long(len(states)))
    answer = out[: len(states)].copy()
    arguments = (at(rows), at(out), ctypes.c_long(count))
    return protocol.plain(answer), {"compile": compile_seconds}, lambda: protocol.per_unit(
        lambda: library.loop(*arguments), count
    )


if __name__ == "__main__":
    protocol.serve({"rhs": rhs})
