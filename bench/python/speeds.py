"""What the Python package costs beside the native code: `python bench/python/speeds.py [MODEL]`, with the package installed.

One state: the same machine code called from Numba by its address (nothing of Python in between), and through `rhs` with and without `out`.
A batch: the slope over the number of rows is the loop of the native part over blocks; what the call adds does not grow with them. An ensemble: against
`chetaev sweep` on the same trajectories, both as differences of two sizes, so that reading the model and compiling do not count. Nothing here is a test.
"""

from __future__ import annotations

import os
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable

import numba
import numpy as np

import chetaev


def used() -> float:
    """Processor time of this process and of those that it has waited for, in seconds: other work on the machine counts little."""
    children = resource.getrusage(resource.RUSAGE_CHILDREN)
    return time.process_time() + children.ru_utime + children.ru_stime


def least(work: Callable[[], object], tries: int = 9) -> float:
    """The shortest of several times, in seconds."""
    found = []
    for _ in range(tries):
        began = used()
        work()
        found.append(used() - began)
    return min(found)


def one_state(system: chetaev.System) -> None:
    f = system.compile().rhs
    call, data = f.ctypes, f.data
    y = np.linspace(0.1, 0.4, len(system.compile().state))
    out, calls = np.empty_like(y), 200_000

    @numba.njit  # type: ignore[misc, unused-ignore]
    def native(y, out, data, calls):  # type: ignore[no-untyped-def]
        a, b, c = y.ctypes.data, out.ctypes.data, data.ctypes.data
        for _ in range(calls):
            call(0.0, a, b, c)

    native(y, out, data, 1)
    own = least(lambda: native(y, out, data, calls)) / calls

    def loop(work: Callable[[], object]) -> float:
        def many() -> None:
            for _ in range(calls):
                work()

        return least(many) / calls

    nothing = loop(lambda: None)
    into = loop(lambda: f(0.0, y, out)) - nothing
    new = loop(lambda: f(0.0, y)) - nothing
    print(f"one state: native by its address {own * 1e6:.3f} µs; rhs with out {into * 1e6:.3f} µs ({(into - own) * 1e6:+.3f}), without {new * 1e6:.3f} µs ({(new - own) * 1e6:+.3f})")


def batch(system: chetaev.System, rows: int = 100_000) -> None:
    f = system.compile().rhs
    y = np.random.default_rng(1).normal(size=(rows, len(system.compile().state)))
    out = np.empty_like(y)
    whole = least(lambda: f(0.0, y, out))
    half = least(lambda: f(0.0, y[: rows // 2], out[: rows // 2]))
    native = 2 * (whole - half)
    new = least(lambda: f(0.0, y))
    print(f"{rows} states: {whole / rows * 1e9:.1f} ns each with out, {new / rows * 1e9:.1f} ns without; the blocks alone {native / rows * 1e9:.1f} ns: {whole / native:.3f} times")


def ensemble(name: str, parameter: str, low: float, high: float, count: int = 10_000) -> None:
    program = shutil.which("chetaev") or os.environ.get("CHETAEV_PROGRAM")
    system = chetaev.System.from_gallery(name)

    def ours(count: int) -> float:
        values = np.linspace(low, high, count)
        return least(lambda: chetaev.ensemble(system, parameters={parameter: values}), 3)

    said = f"{count} trajectories from Python: {ours(count):.3f} s"
    if program:
        with tempfile.TemporaryDirectory() as folder:
            chetaev.gallery.copy(name, os.path.join(folder, "model"))
            path = os.path.join(folder, "model", "model.toml")

            def theirs(count: int) -> float:
                command = [program, "sweep", path, "--vary", f"{parameter}={low}:{high}:{count}", "--out", os.path.join(folder, "out")]

                def run() -> None:
                    shutil.rmtree(os.path.join(folder, "out"), ignore_errors=True)
                    subprocess.run(command, check=True, capture_output=True)

                return least(run, 3)

            python, rust = ours(count) - ours(2), theirs(count) - theirs(2)
            said += f"; less two of them {python:.3f} s, by `chetaev sweep` {rust:.3f} s: {python / rust:.3f} times"
    print(said)


if __name__ == "__main__":
    model = sys.argv[1] if len(sys.argv) > 1 else "chaplygin-sleigh"
    print(model)
    one_state(chetaev.System.from_gallery(model))
    batch(chetaev.System.from_gallery(model))
    ensemble("chaplygin-sleigh", "a", 0.1, 0.5)
