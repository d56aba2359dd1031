"""Nothing is lost: memory of systems and motions, threads, subinterpreters."""

from __future__ import annotations

import gc
import os
import subprocess
import sys
import textwrap
import threading
from pathlib import Path

import numpy as np
import pytest

from chetaev import System

TEXT = """
name = "pendulum"
coordinates = ["th"]
parameters = { l = 1.5, g = 9.81 }
lagrangian = { T = "1/2 l^2 th'^2", V = "-g l cos(th)" }
initial = { th = 0.3 }
simulation = { t_end = 0.05, output = 5 }
"""
#: Systems with a motion each, of which there are more in the full run.
COUNT = 100_000 if os.environ.get("CHETAEV_TESTS") == "full" else 10_000


def resident() -> float:
    """Memory of this process in MB: as Linux tells it, elsewhere as `ps` does."""
    told = Path("/proc/self/statm")
    if told.exists():
        return int(told.read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 1e6
    kibibytes = subprocess.run(["ps", "-o", "rss=", "-p", str(os.getpid())], capture_output=True, text=True, check=True).stdout
    return int(kibibytes) * 1.024e-3


def used(number: int) -> None:
    """A system of its own, with everything that keeps memory in the native part."""
    system = System.from_text(TEXT, set={"l": 1 + number / COUNT})
    motion = system.simulate()
    assert motion["th"][0] == 0.3 and motion.sol(0.01).shape == (2,)
    if number % 10 == 0:
        f = system.compile()
        f.jac(0.0, np.zeros((40, 2)))
        assert f.rhs.address
        system.derive("maggi").to_latex()


def test_systems_and_motions_leave_no_memory_behind() -> None:
    for number in range(COUNT // 5):
        used(number)
    gc.collect()
    before = resident()
    for number in range(COUNT // 5, COUNT):
        used(number)
    gc.collect()
    # 100 bytes lost with each would be 0.8 MB; what an allocator keeps for itself differs by as much.
    assert resident() - before < 0.001 * COUNT / 10 + 4


def test_threads_use_one_system() -> None:
    system = System.from_text(TEXT)
    expected = system.simulate()["th"][-1]
    f = system.compile()
    wrong: list[BaseException] = []

    def work() -> None:
        try:
            for _ in range(10):
                assert system.simulate()["th"][-1] == expected
                assert system.derive("maggi").to_dict()
                np.testing.assert_allclose(f.rhs(0.0, [0.3, 0.0]), [0, -9.81 / 1.5 * np.sin(0.3)])
        except BaseException as problem:  # noqa: BLE001
            wrong.append(problem)

    threads = [threading.Thread(target=work) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wrong == []


#: An interpreter that shares the lock of the main one, which loads everything, and one that has a lock of its own where Python makes such.
KINDS = ["legacy", "isolated"]


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("is_first", [True, False], ids=["before", "after"])
def test_subinterpreters_are_refused(kind: str, is_first: bool) -> None:
    """Whether they try before the main interpreter or after it, and the main one goes on with types of its own."""
    script = textwrap.dedent(
        """
        import sys
        kind, is_first = sys.argv[1], sys.argv[2] == "True"
        try:
            import _interpreters as interpreters
            own = interpreters.create(kind)
        except ImportError:
            import _xxsubinterpreters as interpreters
            own = interpreters.create(isolated=kind == "isolated")
        if not is_first:
            import chetaev
        try:
            found = interpreters.run_string(own, "import chetaev; chetaev.System.from_gallery('chaplygin-sleigh').compile()")
            said = "" if found is None else str(getattr(found, "formatted", found))
        except Exception as problem:
            said = str(problem)
        print(said)
        interpreters.destroy(own)
        import chetaev
        f = chetaev.System.from_gallery("chaplygin-sleigh").compile()
        assert len(f.rhs(0.0, f.start)) == 6
        """
    )
    done = subprocess.run([sys.executable, "-c", script, kind, str(is_first)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    assert "ImportError" in done.stdout and "interpreter" in done.stdout.replace("RunFailedError", ""), done.stdout
