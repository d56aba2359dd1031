"""diffrax on JAX, double precision on the processor, one jit of the whole integration; vmap for ensembles."""

import os

os.environ["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
os.environ["JAX_PLATFORMS"] = "cpu"

import protocol
import jax

jax.config.update("jax_enable_x64", True)
import diffrax
import jax.numpy as jnp
import numpy as np
import systems
from systems import ensemble


class Ops:
    num = float
    sin, cos, sqrt = jnp.sin, jnp.cos, jnp.sqrt


def solver(s, request, t_end):
    term = diffrax.ODETerm(lambda t, z, _: jnp.stack([jnp.asarray(x) for x in s.hand.rates(Ops, [z[i] for i in range(z.shape[0])])]))
    method = getattr(diffrax, request["variant"])()
    tolerance = request["tolerance"]
    control = diffrax.PIDController(rtol=tolerance, atol=tolerance)

    def run(z):
        found = diffrax.diffeqsolve(
            term, method, 0.0, t_end, 0.001, z, stepsize_controller=control, max_steps=10_000_000,
            saveat=diffrax.SaveAt(t1=True), adjoint=diffrax.ForwardMode() if hasattr(diffrax, "ForwardMode") else diffrax.DirectAdjoint(),
        )
        return found.ys[-1], found.stats["num_steps"]

    return run


def trajectory(request):
    s = systems.load(request["system"])
    run = jax.jit(solver(s, request, s.t_end))
    start = jnp.array(request["hand_start"])
    clock = protocol.Clock()
    end, steps = jax.block_until_ready(run(start))
    compile_seconds = clock.lap()[0]
    return protocol.plain([np.array(end)[: s.size]]), {"compile": compile_seconds, "steps": int(steps)}, lambda: protocol.per_unit(
        lambda: jax.block_until_ready(run(start)), 1
    )


def ensembles(request):
    s = systems.load(request["system"])
    count = request["count"]
    starts = jnp.array(ensemble.hand_starts(s, count))
    run = jax.jit(jax.vmap(solver(s, request, request["t_end"])))
    clock = protocol.Clock()
    ends, _ = jax.block_until_ready(run(starts))
    compile_seconds = clock.lap()[0]
    ends = np.array(ends)
    answer = [ends[i][: s.size] for i in ensemble.checked(count)]
    return protocol.plain(answer), {"compile": compile_seconds}, lambda: protocol.per_unit(
        lambda: jax.block_until_ready(run(starts)), count
    )


if __name__ == "__main__":
    protocol.serve({"trajectory": trajectory, "ensemble": ensembles})
