"""symjit: SymPy expressions to machine code without a compiler; vectors where the machine has them."""

import protocol
import numpy as np
import symjit
import sympy as sp
import systems


class Ops:
    num = staticmethod(lambda s: sp.Float(s, 17))
    sin, cos, sqrt = sp.sin, sp.cos, sp.sqrt



def rhs(request):
    s = systems.load(request["system"])
    clock = protocol.Clock()
    z = sp.symbols(" ".join("z%d" % i for i in range(len(s.hand.variables(s.n)))))
    rates = [sp.sympify(e) for e in s.hand.rates(Ops, list(z))]
    derived = clock.lap()[0]
    f = symjit.compile_func(list(z), rates, use_simd=True)
    compile_seconds = clock.lap()[0]
    states = np.array(request["hand_states"])
    count = 1024
    rows = np.array([states[i % len(states)] for i in range(count)]) * (1 + 1e-9 * np.arange(count)[:, None])
    columns = [np.ascontiguousarray(c) for c in rows.T]
    answer = [list(f(*[float(x) for x in state])) for state in states]
    return protocol.plain(answer), {"compile": compile_seconds, "derive": derived}, lambda: protocol.per_unit(
        lambda: f(*columns), count
    )


if __name__ == "__main__":
    protocol.serve({"rhs": rhs})
