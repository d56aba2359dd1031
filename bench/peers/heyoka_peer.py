"""heyoka: Taylor integrators and compiled functions by LLVM.

As its documentation recommends: `diff_tensors` for derivatives, `cfunc` with its own vector width for many states, the default
(plain) mode of `taylor_adaptive` for small and compact mode for large systems, `ensemble_propagate_until_batch` for ensembles.
Compiled code is never taken from its cache.
"""

import protocol  # first: it sets the path
import heyoka as hy
import numpy as np
import systems
from systems import derived, ensemble

hy.llvm_state.set_diskcache_enabled(False)
hy.llvm_state.set_memcache_limit(0)


def ops(number=float):
    class Ops:
        num = staticmethod(lambda s: hy.expression(number(s)))
        sin, cos, sqrt = hy.sin, hy.cos, hy.sqrt

    return Ops


def hand(s, number=float):
    names = s.hand.variables(s.n)
    z = hy.make_vars(*names)
    rates = s.hand.rates(ops(number), list(z))
    return list(z), [hy.expression(r) if isinstance(r, (int, float)) else r for r in rates]


def terms(s, number=float):
    o = ops(number)
    q = list(hy.make_vars(*s.names))
    v = list(hy.make_vars(*["d_" + x for x in s.names]))
    n = s.size
    L = s.lagrangian(o, q, v)
    grad = hy.diff_tensors([L], diff_args=q + v, diff_order=1).gradient
    Lq, p = list(grad[:n]), list(grad[n:])
    jac = hy.diff_tensors(p, diff_args=q + v, diff_order=1).jacobian
    f = list(s.constraints(o, q, v))
    held = [phi for phi, _ in s.holonomic(o, q)]
    if held:
        rows = hy.diff_tensors(held, diff_args=q, diff_order=1).jacobian
        f += [hy.sum([rows[l][i] * v[i] for i in range(n)]) for l in range(len(held))]
    jf = hy.diff_tensors(f, diff_args=q + v, diff_order=1).jacobian
    clean = lambda e: 0 if e == hy.expression(0.0) else e
    M = [[clean(jac[i][n + j]) for j in range(n)] for i in range(n)]
    b = [derived.sub(clean(Lq[i]), derived.dot([clean(x) for x in jac[i][:n]], v)) for i in range(n)]
    J = [[clean(x) for x in row[n:]] for row in jf]
    g = [derived.sub(0, derived.dot([clean(x) for x in row[:n]], v)) for row in jf]
    return q, v, M, b, J, g


def full(e):
    return hy.expression(float(e)) if isinstance(e, (int, float)) else e


def reduced(s, number=float):
    """State (q, u), rates, and (q, v) -> q''."""
    q, v, M, b, J, g = terms(s, number)
    if not s.linear:
        acc = [full(x) for x in derived.reduced(s, M, b, J, g)[2]]
        return q + v, [full(x) for x in v] + acc, (q + v, acc)
    B, acc, whole = derived.reduced(s, M, b, J, g)
    u = [v[i] for i in s.independent]
    velocities = [derived.dot(B[i], u) for i in range(s.size)]
    # The dependent velocities in the accelerations are functions of the independent ones.
    tied = {str(v[d]): full(velocities[d]) for d in s.dependent}
    free = [hy.subs(full(x), tied) for x in acc]
    return q + u, [full(x) for x in velocities] + free, (q + v, [full(x) for x in whole])


def many(states, count=1024):
    rows = np.array([states[i % len(states)] for i in range(count)])
    return rows * (1 + 1e-9 * np.arange(count)[:, None])


def derive(request):
    s = systems.load(request["system"])
    compact = request["variant"] == "compact"
    at = np.array(request["states"][0])
    found = []

    def measure():
        clock = protocol.Clock()
        if request["form"] == "hand":
            z, rates = hand(s)
            point = np.array(request["hand_states"][0])
            inputs, outputs = z, rates
        else:
            inputs, outputs = reduced(s)[2]
            point = at
        derived_in = clock.lap()
        f = hy.cfunc(outputs, vars=inputs, compact_mode=compact)
        values = f(point)
        compiled_in = clock.lap()
        found[:] = [float(x) for x in values]
        return {
            "seconds": derived_in[0] + compiled_in[0],
            "wall": derived_in[1] + compiled_in[1],
            "parts": {"derive": derived_in[0], "compile": compiled_in[0]},
            "answer": [found],
        }

    return None, {}, measure


def rhs(request):
    s = systems.load(request["system"])
    clock = protocol.Clock()
    if request["form"] == "hand":
        z, rates = hand(s)
        answer_of, states = (z, rates), request["hand_states"]
    else:
        z, rates, answer_of = reduced(s)
        states = request["states"]
    batch = request["variant"] == "batch"
    f = hy.cfunc(rates, vars=z, batch_size=0) if batch else hy.cfunc(rates, vars=z, batch_size=1)
    compile_seconds = clock.lap()[0]
    check = hy.cfunc(answer_of[1], vars=answer_of[0], compact_mode=True)
    answer = [list(check(np.array(x))) for x in states]
    if request["form"] != "hand" and s.linear:
        n = s.size
        states = [x[:n] + [x[n + i] for i in s.independent] for x in states]
    block = np.ascontiguousarray(many(states).T)
    out = np.zeros((len(rates), block.shape[1]))
    measure = lambda: protocol.per_unit(lambda: f(block, outputs=out), block.shape[1])
    return protocol.plain(answer), {"compile": compile_seconds}, measure


def initial(s, request):
    if request["form"] == "hand":
        return request["hand_start"]
    n, x = s.size, request["start"]
    return x[:n] + [x[n + i] for i in s.independent] if s.linear else x


def trajectory(request):
    s = systems.load(request["system"])
    z, rates = hand(s) if request["form"] == "hand" else reduced(s)[:2]
    x0 = np.array(initial(s, request))
    clock = protocol.Clock()
    compact = request["variant"] == "compact"
    ta = hy.taylor_adaptive(list(zip(z, rates)), x0, tol=request["tolerance"], compact_mode=compact)
    compile_seconds = clock.lap()[0]
    counts = {}

    def once():
        ta.time = 0.0
        ta.state[:] = x0
        counts["steps"] = ta.propagate_until(s.t_end)[3]

    once()
    answer = [list(ta.state[: s.size])]
    info = {"compile": compile_seconds, "steps": counts["steps"], "order": ta.order}
    return protocol.plain(answer), info, lambda: protocol.per_unit(once, 1)


def drift(request):
    s = systems.load(request["system"])
    z, rates = hand(s)
    x0 = np.array(request["hand_start"])
    ta = hy.taylor_adaptive(list(zip(z, rates)), x0, tol=request["tolerance"])

    class Numeric:
        num = float
        sin, cos, sqrt = np.sin, np.cos, np.sqrt

    steps = request["steps"]
    chunk = max(1, steps // 200)

    def energy():
        state = [np.longdouble(x) for x in ta.state]
        return float(s.energy(Numeric, state[: s.size], s.hand.velocities(Numeric, state)) - np.longdouble(request["energy"]))

    def measure():
        ta.time = 0.0
        ta.state[:] = x0
        done, cpu, wall, errors, times = 0, 0.0, 0.0, [], []
        scale = abs(request["energy"])
        while done < steps:
            clock = protocol.Clock()
            done += ta.propagate_until(1e12, max_steps=min(chunk, steps - done))[3]
            lap = clock.lap()
            cpu, wall = cpu + lap[0], wall + lap[1]
            errors.append(energy() / scale)
            times.append(done)
        return {
            "seconds": cpu / steps,
            "wall": wall / steps,
            "parts": {"largest": max(map(abs, errors)), "last": errors[-1], "time": float(ta.time)},
            "curve": [times, errors],
        }

    return None, {}, measure


def ensembles(request):
    s = systems.load(request["system"])
    z, rates = hand(s)
    starts = np.array(ensemble.hand_starts(s, request["count"]))
    batch = hy.recommended_simd_size()
    clock = protocol.Clock()
    ta = hy.taylor_adaptive_batch(
        list(zip(z, rates)), np.zeros((len(z), batch)), tol=request["tolerance"]
    )
    compile_seconds = clock.lap()[0]
    t_end, count = request["t_end"], len(starts)
    blocks = (count + batch - 1) // batch
    padded = starts[np.minimum(np.arange(blocks * batch), count - 1)].reshape(blocks, batch, len(z)).transpose(0, 2, 1)
    ends = np.zeros((blocks, len(z), batch))

    def reused():
        for i in range(blocks):
            ta.set_time(0.0)
            ta.state[:] = padded[i]
            ta.propagate_until(t_end)
            ends[i] = ta.state

    def call():
        def begin(ta, i):
            ta.set_time(0.0)
            ta.state[:] = padded[i]
            return ta

        found = hy.ensemble_propagate_until_batch(ta, t_end, blocks, begin, max_workers=1)
        for i, one in enumerate(found):
            ends[i] = one[0].state

    work = reused if request["variant"] == "reused" else call
    work()
    all_ends = ends.transpose(0, 2, 1).reshape(-1, len(z))[:count]
    answer = [list(all_ends[i][: s.size]) for i in ensemble.checked(count)]
    return protocol.plain(answer), {"compile": compile_seconds}, lambda: protocol.per_unit(work, count)


def long_ensemble(s, count, t_end):
    """The ends of those members of an ensemble that are compared, in long double."""
    z, rates = hand(s, np.longdouble)
    starts = ensemble.hand_starts(s, count)
    ta = hy.taylor_adaptive(
        list(zip(z, rates)), np.zeros(len(z), dtype=np.longdouble), tol=np.longdouble(2e-19), fp_type=np.longdouble, compact_mode=True
    )
    ends = []
    for i in ensemble.checked(count):
        ta.time = np.longdouble(0)
        ta.state[:] = np.array(starts[i], dtype=np.longdouble)
        ta.propagate_until(np.longdouble(t_end))
        ends.append([float(x) for x in ta.state[: s.size]])
    return ends


def long_trajectory(s, found):
    """The end of the trajectory in long double, and with 113 bits where that takes less than minutes."""
    form = "hand" if s.hand else "derived"
    start = found["hand_start"] if s.hand else initial(s, {"form": "derived", "start": found["start"]})
    number = lambda x: np.longdouble(x)
    z, rates = hand(s, number) if s.hand else reduced(s, number)[:2]
    x0 = np.array([np.longdouble(x) for x in start])
    ta = hy.taylor_adaptive(list(zip(z, rates)), x0, tol=np.longdouble(2e-19), fp_type=np.longdouble, compact_mode=True)
    steps = ta.propagate_until(np.longdouble(s.t_end))[3]
    end = [float(x) for x in ta.state[: s.size]]
    result = {"end": end, "end_by": f"heyoka, {form} form, long double", "end_steps": steps}
    if s.hand and s.n <= 4:
        real = lambda x: hy.real(x, 113) if isinstance(x, str) else hy.real(float(x), 113)
        z, rates = hand(s, real)
        x0 = np.array([hy.real(float(x), 113) for x in start], dtype=hy.real)
        tb = hy.taylor_adaptive(
            list(zip(z, rates)), x0, tol=hy.real("1e-30", 113), fp_type=hy.real, prec=113, compact_mode=True
        )
        tb.propagate_until(hy.real(float(s.t_end), 113))
        better = [float(x) for x in tb.state[: s.size]]
        scale = max(1.0, *(abs(x) for x in better))
        result["end"] = better
        result["end_by"] = f"heyoka, {form} form, 113 bits"
        result["end_uncertainty"] = max(abs(x - y) for x, y in zip(better, end)) / scale
    return result


if __name__ == "__main__":
    protocol.serve(
        {"derive": derive, "rhs": rhs, "trajectory": trajectory, "drift": drift, "ensemble": ensembles}
    )
