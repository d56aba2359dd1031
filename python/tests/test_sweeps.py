"""Sweeps and ensembles: the same bits as the command, wherever they are computed."""

from __future__ import annotations

import concurrent.futures
import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import program
from test_commands import said

import chetaev
from chetaev import System

VARIED = {"a": np.linspace(0.1, 0.5, 12), "W": np.linspace(1.0, 3.0, 12)}


@pytest.fixture(scope="module")
def sleigh(gallery: Path) -> System:
    return System.from_file(gallery / "chaplygin-sleigh" / "model.toml")


def same(ours: Any, theirs: Any) -> None:
    assert ours.keys() == theirs.keys() or list(ours.keys()) == list(theirs.keys())
    for name in ours.keys():
        assert np.array_equal(ours[name], theirs[name], equal_nan=True), name


def test_sweeps_are_those_of_the_command(sleigh: System, command: Any, gallery: Path, tmp_path: Path) -> None:
    path = str(gallery / "chaplygin-sleigh" / "model.toml")
    arguments = ["--vary", "a=0.1:0.5:5", "--initial", "phi=0,1/10", "--samples", "4", "--t-end", "3"]
    told = command("sweep", path, *arguments, "--out", str(tmp_path))
    ours = sleigh.sweep(vary={"a": "0.1:0.5:5"}, initial={"phi": [0, "1/10"]}, samples=4, t_end=3, out=tmp_path / "ours")
    assert ours.to_dict() | {"archive": None} == told | {"archive": None}
    with np.load(tmp_path / "sweep.npz") as theirs, np.load(tmp_path / "ours" / "sweep.npz") as written:
        same(ours, dict(theirs))
        same(ours, dict(written))
    assert ours["sample_x"].shape == (10, 4)
    assert np.array_equal(ours["sample_x"][:, -1], ours["end_x"])


def test_a_row_is_the_motion_with_its_values(sleigh: System) -> None:
    found = chetaev.ensemble(sleigh, parameters={"a": [0.2, 0.3]}, t_end=2)
    for number, a in enumerate((0.2, 0.3)):
        motion = sleigh.with_values(a=a).simulate(t_end=2)
        assert found["end_x"][number] == motion["x"][-1]


def test_random_values_follow_from_the_seed(sleigh: System) -> None:
    one, two, other = (sleigh.sweep(vary={"a": "0.1:0.5:uniform"}, count=3, seed=seed, t_end=1) for seed in (4, 4, 5))
    same(one, two)
    assert not np.array_equal(one["vary_a"], other["vary_a"])


def test_what_fails_is_told() -> None:
    falling = System(
        "falling", coordinates=["x"], lagrangian="1/2 x'^2 - sqrt(x)", initial={"x": 1}, simulation={"t_end": 10},
    )
    found = falling.sweep(rows={"x": [1.0, 1e6]})
    assert list(found["stop"]) == [1, 0]
    assert list(found.failures) == [0]
    assert "ended early" in str(found)


def test_wrong_values_are_told(sleigh: System) -> None:
    with pytest.raises(chetaev.ModelError, match="nothing"):
        sleigh.sweep(vary={"nothing": "0:1:3"})
    with pytest.raises(chetaev.OptionError, match="nothing varies"):
        sleigh.sweep()
    with pytest.raises(ValueError, match="nothing varies"):
        chetaev.ensemble(sleigh)
    with pytest.raises(ValueError):
        chetaev.ensemble(sleigh, parameters={"a": [1, 2], "W": [1, 2, 3]})
    with pytest.raises(ValueError, match="2 dimensions"):
        chetaev.ensemble(sleigh, parameters={"a": [[1, 2]]})


def test_rows_come_from_files_and_frames(sleigh: System, tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    (tmp_path / "rows.csv").write_text("a,W\n0.2,1.5\n0.3,1.25\n")
    frame = pandas.DataFrame({"a": [0.2, 0.3], "W": [1.5, 1.25]})
    one, two = sleigh.sweep(rows=tmp_path / "rows.csv", t_end=1), sleigh.sweep(rows=frame, t_end=1)
    same(one, two)
    assert list(one.to_pandas()["vary_W"]) == [1.5, 1.25]


def test_executors_give_the_same_bits(sleigh: System, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    alone = chetaev.ensemble(sleigh, parameters=VARIED, samples=3, t_end=2)
    context = multiprocessing.get_context("spawn")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as executor:
        apart = chetaev.ensemble(sleigh, parameters=VARIED, samples=3, t_end=2, executor=executor, chunk=5, out=tmp_path)
    same(alone, apart)
    with concurrent.futures.ThreadPoolExecutor(2) as executor:
        same(alone, chetaev.ensemble(sleigh, parameters=VARIED, samples=3, t_end=2, executor=executor, chunk=4))


def test_a_computation_goes_on_with_what_is_missing(sleigh: System, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    asked: Any = {"parameters": VARIED, "t_end": 2, "chunk": 5, "out": tmp_path}
    alone = chetaev.ensemble(sleigh, **asked)
    files = sorted(tmp_path.iterdir())
    assert len(files) == 3
    files[1].unlink()
    kept = {own: own.stat().st_mtime_ns for own in files if own.exists()}
    same(alone, chetaev.ensemble(sleigh, **asked))
    assert {own: own.stat().st_mtime_ns for own in kept} == kept
    assert files[1].exists()
    # Other values are other files.
    chetaev.ensemble(sleigh, **(asked | {"t_end": 3}))
    assert len(list(tmp_path.iterdir())) == 6


def test_a_cluster_of_which_a_worker_dies(sleigh: System, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed")
    pytest.importorskip("pyarrow")
    parameters = {"a": np.linspace(0.1, 0.5, 60)}
    alone = chetaev.ensemble(sleigh, parameters=parameters, t_end=20)
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster:
        with distributed.Client(cluster) as client:
            victim = client.submit(os.getpid, pure=False).result()
            kill = client.submit(_killed, victim, os.getpid(), pure=False)
            found = chetaev.ensemble(sleigh, parameters=parameters, t_end=20, executor=client, chunk=6, out=tmp_path)
            kill.cancel()
    same(alone, found)
    assert len(list(tmp_path.glob("*.parquet"))) == 10


def _killed(victim: int, keeper: int) -> None:
    """Kills a worker, which may be the one that runs this; once, as the second time nobody has the number."""
    assert victim != keeper
    try:
        os.kill(victim, signal.SIGKILL)
    except ProcessLookupError:
        pass


def test_steady_motions_are_the_json(command: Any, gallery: Path) -> None:
    path = gallery / "double-pendulum" / "model.toml"
    found = System.from_file(path).steady()
    assert found.to_dict() == command("steady", str(path))
    assert len(found.motions) == 4


def _killing(path: str) -> None:
    """Ends one process of a pool, once."""
    try:
        os.close(os.open(path, os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return
    # Where there is no SIGKILL, SIGTERM ends a process at once.
    os.kill(os.getpid(), getattr(signal, "SIGKILL", signal.SIGTERM))


def test_a_process_that_dies_costs_its_chunk_only(sleigh: System, tmp_path: Path) -> None:
    context = multiprocessing.get_context("spawn")
    mark = str(tmp_path / "killed")
    with concurrent.futures.ProcessPoolExecutor(2, mp_context=context) as pool:
        pool.submit(_killing, mark)
        found = chetaev.ensemble(sleigh, parameters=VARIED, t_end=1, executor=pool, chunk=3)
    assert os.path.exists(mark)
    same(found, chetaev.ensemble(sleigh, parameters=VARIED, t_end=1))


@pytest.mark.parametrize(
    ("values", "said"),
    [
        (np.ma.masked_array([0.1, 0.2], [False, True]), "masked"),
        (np.array([0.1 + 1j, 0.2]), "complex"),
        (np.ones((2, 2)), "2 dimensions"),
    ],
)
def test_no_part_of_a_value_is_lost(sleigh: System, values: Any, said: str) -> None:
    with pytest.raises((TypeError, ValueError), match=said):
        chetaev.ensemble(sleigh, parameters={"a": values}, t_end=1)
    with pytest.raises((TypeError, ValueError)):
        sleigh.sweep(vary={"a": values}, t_end=1)


def test_a_name_that_varies_twice_is_refused(sleigh: System) -> None:
    with pytest.raises(ValueError, match="`a` stands among the parameters and among the initial values"):
        chetaev.ensemble(sleigh, parameters={"a": [0.1]}, initial={"a": [0.2]}, t_end=1)


def test_a_file_that_is_not_whole_is_computed_again(sleigh: System, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    first = chetaev.ensemble(sleigh, parameters=VARIED, t_end=1, chunk=5, out=tmp_path)
    broken = next(tmp_path.glob("*.parquet"))
    broken.write_bytes(broken.read_bytes()[:-9])
    same(first, chetaev.ensemble(sleigh, parameters=VARIED, t_end=1, chunk=5, out=tmp_path))


@pytest.mark.parametrize(
    ("keywords", "said"),
    [
        ({"samples": -1}, "samples: a whole number from 0"),
        ({"samples": 4 * 10**9}, "samples: a whole number from 0 to 1000000"),
        ({"samples": 2.5}, "samples: a whole number is needed, not 2.5"),
        ({"threads": 0}, "threads: a whole number from 1 to 4096"),
        ({"seed": -1}, "seed: a whole number from 0"),
        ({"count": -1}, "count: a whole number from 1"),
    ],
)
def test_numbers_out_of_range_are_told_by_their_keyword(sleigh: System, keywords: dict[str, Any], said: str) -> None:
    with pytest.raises((TypeError, chetaev.OptionError), match=said):
        sleigh.sweep(vary={"a": [0.1]}, t_end=1, **keywords)


@pytest.mark.parametrize("kind", ["pandas", "polars", "pyarrow", "xarray", "structured"])
def test_rows_are_any_table_with_named_columns(sleigh: System, kind: str) -> None:
    columns = {"a": np.array([0.2, 0.3]), "phi'": np.array([1.5, 1.25])}
    if kind == "structured":
        table: Any = np.rec.fromarrays(list(columns.values()), names=list(columns))
    else:
        module = pytest.importorskip(kind)
        table = {"pandas": "DataFrame", "polars": "DataFrame", "pyarrow": "table", "xarray": "Dataset"}[kind]
        table = getattr(module, table)({name: ("row", own) for name, own in columns.items()} if kind == "xarray" else columns)
    same(sleigh.sweep(rows=table, t_end=1), sleigh.sweep(rows=columns, t_end=1))


@pytest.mark.parametrize(
    ("keywords", "said"),
    [
        ({"vary": {"m": np.linspace(1, 2, 1500)}}, "`vary` is no keyword of ensemble"),
        ({"rows": {"m": [1, 2]}}, "`rows` is no keyword"),
        ({"tolerence": 1e-9}, "`tolerence` is no keyword"),
        ({"executor": 3}, "executor: one of concurrent.futures, or a client of Dask, is needed, not int"),
        ({"parameters": [1]}, "parameters: a mapping from names to values is needed, not list"),
        ({"initial": {"phi": np.array(["2020-01-01"], "M8[D]")}}, "`phi`: numbers are needed"),
    ],
)
def test_keywords_of_an_ensemble_are_those_of_a_motion(sleigh: System, keywords: dict[str, Any], said: str, tmp_path: Path) -> None:
    # With and without files alike: what a file is called by leaves nothing out.
    for out in (None, tmp_path):
        with pytest.raises(TypeError, match=said):
            chetaev.ensemble(sleigh, **{"parameters": {"a": [0.1, 0.2]}, "t_end": 1, "out": out, **keywords})


def test_files_are_called_by_what_is_asked(sleigh: System, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    count = 0
    for asked, files in [
        # The same in other words is the same.
        ([{"t_end": 1}, {"t_end": "1"}, {"t_end": np.int64(1)}, {"t_end": 1, "tolerance": None}], 1),
        ([{"t_end": 0.3}, {"t_end": np.nextafter(0.3, 1)}], 2),
        ([{"t_end": 1, "tolerance": 1e-9}, {"t_end": 1, "tolerance": np.nextafter(1e-9, 1)}], 2),
    ]:
        for own in asked:
            chetaev.ensemble(sleigh, parameters={"a": [0.1]}, out=tmp_path, **own)
        count += files
        assert len(list(tmp_path.iterdir())) == count


@pytest.mark.parametrize("damage", ["cut", "empty", "zeros", "flipped", "footer"])
def test_a_chunk_that_cannot_be_read_to_its_end_is_computed_again(sleigh: System, damage: str, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    asked: Any = {"parameters": VARIED, "t_end": 1, "chunk": 6, "out": tmp_path}
    alone = chetaev.ensemble(sleigh, **asked)
    for path in tmp_path.iterdir():
        own = path.read_bytes()
        places = range(4, len(own) // 2, 97) if damage == "flipped" else [0]
        for place in places:
            broken = {
                "cut": own[: len(own) // 3],
                "empty": b"",
                "zeros": own[:100] + bytes(300) + own[400:],
                "flipped": own[:place] + bytes([own[place] ^ 255]) + own[place + 1 :],
                "footer": own[:-200] + bytes(192) + own[-8:],
            }[damage]
            path.write_bytes(broken)
            same(alone, chetaev.ensemble(sleigh, **asked))


def test_names_of_a_statement_in_sympy_are_names_of_columns() -> None:
    import sympy as sp
    from sympy.physics.mechanics import dynamicsymbols

    x, k = dynamicsymbols("x"), sp.Symbol("lambda")
    with pytest.warns(chetaev.ModelWarning, match="called `x_lambda`"):
        system = System.from_sympy(x.diff() ** 2 / 2 - k * x**2 / 2, [x], parameters={k: 1}, initial={x: 1})
    squares = np.array([1.0, 4.0])
    for key in (k, "lambda", "x_lambda"):
        # x = cos(sqrt(k) t)
        found = chetaev.ensemble(system, parameters={key: squares}, initial={x.diff(): 0}, t_end=1)
        np.testing.assert_allclose(found["end_x"], np.cos(np.sqrt(squares)), rtol=1e-8)
        found = system.sweep(vary={key: squares}, t_end=1)
        np.testing.assert_allclose(found["end_x"], np.cos(np.sqrt(squares)), rtol=1e-8)
        assert system.sensitivity([key], [0.0, 1.0])["d x/d x_lambda"][1] == pytest.approx(-np.sin(1) / 2, rel=1e-7)


def test_an_ensemble_of_nothing_is_told_by_its_name(sleigh: System, tmp_path: Path) -> None:
    for out in (None, tmp_path):
        with pytest.raises(chetaev.OptionError, match="`a` is empty: one value for each trajectory is needed"):
            chetaev.ensemble(sleigh, parameters={"a": []}, out=out, t_end=1)
    with pytest.raises(chetaev.OptionError, match="`a` is empty"):
        sleigh.sweep(rows={"a": np.array([])}, t_end=1)


class Client:
    """A client of Dask by its module, of which the first result is waited for when Ctrl-C comes."""

    def __init__(self) -> None:
        self.submitted: list[Any] = []
        self.cancelled: list[list[Any]] = []

    def submit(self, *_: Any, key: str) -> Any:
        class Pending:
            def result(self) -> Any:
                raise KeyboardInterrupt

            def cancel(self) -> None:
                raise AssertionError("one by one")

        self.submitted.append(Pending())
        return self.submitted[-1]

    def cancel(self, futures: list[Any]) -> None:
        self.cancelled.append(list(futures))


Client.__module__ = "distributed.client"


def test_what_a_client_has_not_begun_is_given_up_at_once(sleigh: System) -> None:
    client = Client()
    with pytest.raises(chetaev.Interrupted):
        chetaev.ensemble(sleigh, parameters=VARIED, t_end=1, executor=client, chunk=1)
    assert len(client.submitted) == 12
    assert client.cancelled == [client.submitted]


def test_what_was_handed_over_when_ctrl_c_came_is_given_up(sleigh: System) -> None:
    class Interrupting(Client):
        def submit(self, *_: Any, key: str) -> Any:
            if len(self.submitted) == 3:
                raise KeyboardInterrupt
            return super().submit(key=key)

    Interrupting.__module__ = "distributed.client"
    client = Interrupting()
    with pytest.raises(chetaev.Interrupted):
        chetaev.ensemble(sleigh, parameters=VARIED, t_end=1, executor=client, chunk=1)
    assert client.cancelled == [client.submitted] and len(client.submitted) == 3


@pytest.mark.parametrize("part", [b"vary_a", b"end_x", b"drift_energy"])
def test_a_name_of_which_a_bit_has_turned_is_computed_again(sleigh: System, part: bytes, tmp_path: Path) -> None:
    """`vary_a` and vary_` differ in one bit; both are names of columns."""
    pytest.importorskip("pyarrow")
    asked: Any = {"parameters": VARIED, "t_end": 1, "chunk": 6, "out": tmp_path}
    alone = chetaev.ensemble(sleigh, **asked)
    for path in tmp_path.iterdir():
        own = path.read_bytes()
        # Everywhere: columns are named in the schema, in the footer and in the schema of Arrow.
        broken = own.replace(part, part[:-1] + bytes([part[-1] ^ 1]))
        assert broken != own
        path.write_bytes(broken)
        same(alone, chetaev.ensemble(sleigh, **asked))
        assert path.read_bytes() != broken


ASKED = ["--vary", "a=0.1:0.5:40", "--t-end", "3"]
VARY: Any = {"vary": {"a": "0.1:0.5:40"}, "t_end": 3}


def test_a_folder_is_kept_as_the_command_keeps_it(sleigh: System, command: Any, gallery: Path, tmp_path: Path) -> None:
    """Either goes on with what the other has left, and the files are the same."""
    path = str(gallery / "chaplygin-sleigh" / "model.toml")
    told = command("sweep", path, *ASKED, "--out", str(tmp_path / "theirs"))
    ours = sleigh.sweep(**VARY, out=tmp_path / "ours")
    assert ours.to_dict() == told | {"archive": str(tmp_path / "ours" / "sweep.npz")}
    names = {own.name for own in (tmp_path / "theirs").iterdir()}
    assert names == {"sweep.json", "sweep.lock", "sweep.npz", "sweep.sha256", "failures.csv"}
    for name in names:
        assert (tmp_path / "ours" / name).read_bytes() == (tmp_path / "theirs" / name).read_bytes(), name
    archive = tmp_path / "theirs" / "sweep.npz"
    before = archive.stat().st_mtime_ns
    again = sleigh.sweep(**VARY, out=tmp_path / "theirs")
    same(again, ours)
    assert again.to_dict()["taken_over"] == 40 and archive.stat().st_mtime_ns == before
    assert "is complete" in said_of("sweep", path, *ASKED, "--out", str(tmp_path / "ours"))


def said_of(*arguments: str) -> str:
    """Everything that the command says."""
    done = subprocess.run([str(program()), *arguments], capture_output=True, text=True, check=True)
    return done.stdout + done.stderr


def test_a_folder_with_another_sweep_is_left_alone(sleigh: System, tmp_path: Path) -> None:
    found = sleigh.sweep(vary={"a": [0.1, 0.2]}, t_end=1, out=tmp_path)
    before = (tmp_path / "sweep.npz").read_bytes()
    with pytest.raises(chetaev.OptionError, match="holds another sweep: what differs: variations.*with out=…"):
        sleigh.sweep(vary={"a": [0.1, 0.3]}, t_end=1, out=tmp_path)
    with pytest.raises(FileExistsError, match="a sweep is kept there"):
        found.save(tmp_path)
    assert (tmp_path / "sweep.npz").read_bytes() == before


def test_a_sweep_that_ended_at_a_failure_goes_on(tmp_path: Path) -> None:
    """1/2 x^2 x'^2 falls to x = 0, where it ends early; x' > 0 does not."""
    system = System("cone", coordinates=["x"], kinetic="1/2 x^2 x'^2", initial={"x": 1})
    asked: Any = {"initial": {"x'": [1, -1, 2, -2]}, "t_end": 3}
    whole = system.sweep(**asked)
    assert sorted(whole.failures) == [1, 3]
    first = system.sweep(**asked, out=tmp_path, stop_on_failure=True, threads=1)
    assert first.failures and first.to_dict()["archive"] is None
    assert not (tmp_path / "sweep.npz").exists()
    again = system.sweep(**asked, out=tmp_path)
    same(whole, again)
    assert again.failures == whole.failures and again.to_dict()["taken_over"] == len(first)


def test_a_sweep_that_ctrl_c_ended_goes_on(sleigh: System, tmp_path: Path) -> None:
    script = f"""
        import os, signal, threading
        import chetaev
        signal.signal(signal.SIGINT, signal.default_int_handler)
        sleigh = chetaev.System.from_gallery("chaplygin-sleigh")
        threading.Timer(1.0, os.kill, (os.getpid(), signal.SIGINT)).start()
        try:
            sleigh.sweep(vary={{"a": "0.1:0.5:200000"}}, t_end=20, threads=1, out={str(tmp_path)!r})
        except chetaev.Interrupted as stopped:
            found = stopped.result
            assert found["vary_a"].tolist() == sorted(found["vary_a"]) and len(found["end_x"]) == len(found)
            print(len(found))
    """
    done = subprocess.run([sys.executable, "-c", textwrap.dedent(script)], capture_output=True, text=True, check=True)
    assert 0 < int(done.stdout) < 200_000, done
    assert {own.name for own in tmp_path.iterdir()} >= {"sweep.json", "sweep.data", "sweep.journal"}
