"""Many trajectories of one model: over ranges, over rows of values, on all cores or on a cluster."""

from __future__ import annotations

import csv
import errno
import hashlib
import io
import json
import os
import warnings
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from . import notebook
from .asked import mapping, whole
from .errors import Interrupted, OptionError
from .keywords import in_python
from .results import Result, writable, write
from .texts import exact

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from pandas import DataFrame

    from . import chetaev_native as native
    from .system import System

    Arrays = dict[str, NDArray[np.generic]]

#: Trajectories whose end was reached, that ended early, that did not begin; an event k has the number 10 + k.
_FINISHED, _EARLY, _NOT_STARTED, _EVENTS = 0, 1, 2, 10

#: The file that says which sweep a folder keeps.
_RECORD = "sweep.json"


class Sweep(Result):
    """Trajectories of one model, a row for each. ``sweep["vary_a"]``, ``sweep["end_x"]``, ``sweep["stop"]`` are arrays.

    Attributes
    ----------
    names : list of str
        ``vary_NAME``; ``stop`` (0 the end was reached, 1 ended early, 2 did not begin, 10 + k event k); ``t_start``, ``t``, ``t_stop``;
        ``steps``, ``rejected``; ``start_NAME``, ``end_NAME`` (x' is ``x_d``); ``drift_NAME``; ``count_EVENT``, ``first_EVENT``; with samples
        ``sample_t`` and ``sample_NAME`` of shape (trajectories, samples).
    failures : dict from int to str
        Why a trajectory ended early or did not begin, by its number.
    """

    def __init__(
        self, arrays: Arrays, failures: Mapping[int, str], events: Sequence[str], archive: str | None = None, taken_over: int = 0
    ) -> None:
        import numpy as np

        self._arrays = dict(arrays)
        self.names = list(arrays)
        self.failures = {number: in_python(reason) for number, reason in failures.items()}
        stops, numbers = np.unique(self._arrays["stop"], return_counts=True)
        counts = {int(stop): int(number) for stop, number in zip(stops, numbers)}
        data = {
            "trajectories": len(self),
            "taken_over": taken_over,
            "finished": counts.get(_FINISHED, 0),
            "events": {name: counts.get(_EVENTS + k, 0) for k, name in enumerate(events)},
            "ended_early": counts.get(_EARLY, 0),
            "not_started": counts.get(_NOT_STARTED, 0),
            "archive": archive,
            "columns": self.names,
        }
        super().__init__(data, _in_words(data))

    def __getitem__(self, name: str) -> NDArray[Any]:
        try:
            return self._arrays[name]
        except KeyError:
            raise KeyError(f"there is no column `{name}`; there are {', '.join(self.names)}") from None

    def __len__(self) -> int:
        return len(self._arrays["stop"])

    def _html(self) -> str:
        shown = {name: own for name, own in self._arrays.items() if own.ndim == 1 and not name.startswith(("count_", "first_"))}
        counts = [(own.strip(),) for own in str(self).splitlines()]
        failed = notebook.table(["trajectory", "why it ended early or did not begin"], sorted(self.failures.items())[:50])
        table = notebook.table([], counts) + notebook.unfolding("first and last trajectories", notebook.columns(shown))
        return table + (notebook.unfolding(f"{len(self.failures)} failures", failed) if self.failures else "")

    def keys(self) -> list[str]:
        """Names of the columns; with this, ``dict(sweep)`` works.

        Returns
        -------
        list of str
            The same as ``names``.
        """
        return list(self.names)

    def to_pandas(self) -> DataFrame:
        """A ``pandas.DataFrame``, a row for each trajectory; samples are left out.

        Returns
        -------
        pandas.DataFrame
        """
        import pandas as pd

        return pd.DataFrame({name: own for name, own in self._arrays.items() if own.ndim == 1})

    def to_polars(self) -> Any:
        """A ``polars.DataFrame``, a row for each trajectory; samples are left out.

        Returns
        -------
        polars.DataFrame
        """
        import polars as pl  # pyright: ignore[reportMissingImports]

        return pl.DataFrame({name: own for name, own in self._arrays.items() if own.ndim == 1})

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over the trajectories, and over the samples where there are some.

        Returns
        -------
        xarray.Dataset
        """
        import xarray as xr

        axes = ("trajectory", "sample")
        return xr.Dataset({name: (axes[: own.ndim], own) for name, own in self._arrays.items()})

    def to_arrow(self) -> Any:
        """A ``pyarrow.Table``, a row for each trajectory; samples are lists.

        Returns
        -------
        pyarrow.Table
        """
        return _table(self._arrays, self.failures)

    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any:
        return self.to_arrow().__arrow_c_stream__(requested_schema)

    def save(self, folder: str | os.PathLike[str]) -> None:
        """Writes ``sweep.npz`` and ``failures.csv``.

        Parameters
        ----------
        folder : path
            A folder, which is made where there is none.

        Raises
        ------
        FileExistsError
            Where the folder keeps a sweep, as ``sweep(out=…)`` and the command leave it.
        """
        import numpy as np

        if os.path.exists(os.path.join(folder, _RECORD)):
            raise FileExistsError(errno.EEXIST, "a sweep is kept there, and goes on there: choose another folder", os.fspath(folder))
        archive = io.BytesIO()
        np.savez(archive, **self._arrays)  # type: ignore[arg-type, unused-ignore]
        write(os.path.join(folder, "sweep.npz"), archive.getvalue())
        text = io.StringIO()
        rows = csv.writer(text, lineterminator="\n")
        rows.writerow(["trajectory", "reason"])
        rows.writerows(sorted(self.failures.items()))
        write(os.path.join(folder, "failures.csv"), text.getvalue().encode())


def _in_words(data: Mapping[str, Any]) -> str:
    kinds = [("finished", "the end of the time span was reached"), ("ended_early", "ended early"), ("not_started", "did not begin")]
    lines = [f"{data['trajectories']} trajectories"]
    lines += [f"{data[key]:>9}  {words}" for key, words in kinds if data[key]]
    lines += [f"{number:>9}  event {name}" for name, number in data["events"].items() if number]
    return "\n".join(lines)


def ranges(given: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    """Ranges as the texts of the command line: texts as they are, lists and arrays value by value."""
    found = []
    for name, own in mapping("ranges", given).items():
        values = [own] if isinstance(own, str) or not isinstance(own, Iterable) else list(_whole_values(name, own))
        found.append((name, ",".join(exact(value) for value in values)))
    return found


def table_text(rows: Any) -> str | None:
    """Rows as the text of a file of values: of a file by its path, of a mapping to arrays, of a data frame."""
    if rows is None:
        return None
    if isinstance(rows, (str, os.PathLike)):
        with open(rows, encoding="utf-8") as file:
            return file.read()
    columns = columns_of({name: rows[name] for name in _names(rows)})
    lines = [",".join(f'"{name}"' for name in columns)]
    lines += [",".join(map(repr, values)) for values in zip(*(own.tolist() for own in columns.values()))]
    return "\n".join(lines) + "\n"


def _names(rows: Any) -> list[str]:
    """Names of the columns of a table of pyarrow, a frame of pandas or polars, a structured array, a mapping or a dataset."""
    for found in (getattr(rows, "column_names", None), getattr(rows, "columns", None), getattr(getattr(rows, "dtype", None), "names", None)):
        if found is not None:
            return list(found)
    if not hasattr(rows, "keys"):
        raise TypeError(f"rows: a path, a mapping from names to arrays, or a table with named columns is needed, not {type(rows).__name__}")
    return list(rows.keys())


def _whole_values(name: str, own: Any) -> Any:
    """Values of which none is masked."""
    import numpy as np

    if isinstance(own, np.ma.MaskedArray) and bool(np.any(np.ma.getmaskarray(own))):
        raise TypeError(f"`{name}` is a masked array: there is no value where it is masked; fill or compress it first")
    return own


def _reals(name: str, own: Any) -> NDArray[np.float64]:
    """Numbers of which none is lost: neither what is masked nor an imaginary part."""
    import numpy as np

    found = np.asarray(_whole_values(name, own))
    if np.iscomplexobj(found):
        raise TypeError(f"`{name}` is complex, and values are real")
    try:
        if found.dtype.kind in "mM":
            raise TypeError(f"{found.dtype} counts from a day of choice")
        return np.atleast_1d(found.astype(np.float64))
    except (TypeError, ValueError) as problem:
        raise type(problem)(f"`{name}`: numbers are needed, and {problem}") from None


def columns_of(given: Mapping[str, ArrayLike]) -> dict[str, NDArray[np.float64]]:
    """Columns of one length; numbers are repeated."""
    import numpy as np

    found = {name: _reals(name, own) for name, own in given.items()}
    for name, own in found.items():
        if own.size == 0:
            raise OptionError(f"`{name}` is empty: one value for each trajectory is needed")
    wide = np.broadcast_arrays(*found.values())
    for name, own in zip(given, wide):
        if own.ndim != 1:
            raise ValueError(f"`{name}` has {own.ndim} dimensions: one value for each trajectory is needed")
    return dict(zip(given, wide))


def computed(
    prepared: native.Sweep,
    span: tuple[int, int],
    threads: int | None,
    stop_on_failure: bool,
    tell: Any,
) -> tuple[Sweep, bool]:
    """Trajectories with the numbers of a span, and whether Ctrl-C ended them."""
    _, arrays, failures, interrupted = prepared.compute(*span, threads, stop_on_failure, tell)
    return Sweep(dict(zip(prepared.columns, arrays)), dict(failures), prepared.events), interrupted


def kept(
    prepared: native.Sweep, folder: str | os.PathLike[str], threads: int | None, stop_on_failure: bool, tell: Any
) -> tuple[Sweep, bool]:
    """The sweep that a folder keeps, with what is missing computed, and whether Ctrl-C ended that: then, and after a failure, what is there."""
    import numpy as np

    taken, note, part, interrupted = prepared.keep(os.fspath(folder), threads, stop_on_failure, tell)
    if note is not None:
        warnings.warn(note, UserWarning, stacklevel=3)
    if part is not None:
        _, arrays, failures = part
        return Sweep(dict(zip(prepared.columns, arrays)), dict(failures), prepared.events, None, taken), interrupted
    archive = os.path.join(os.fspath(folder), "sweep.npz")
    with np.load(archive) as columns, open(os.path.join(folder, "failures.csv"), encoding="utf-8", newline="") as file:
        reasons = {int(own["trajectory"]): own["reason"] for own in csv.DictReader(file)}
        return Sweep(dict(columns), reasons, prepared.events, archive, taken), interrupted


def ensemble(
    system: System,
    *,
    initial: Mapping[str, ArrayLike] | None = None,
    parameters: Mapping[str, ArrayLike] | None = None,
    samples: int = 0,
    threads: int | None = None,
    executor: Any = None,
    chunk: int = 1000,
    out: str | os.PathLike[str] | None = None,
    progress: bool = False,
    **motion: Any,
) -> Sweep:
    """Trajectories from arrays of initial values and parameters, on all cores or by an executor.

    Parameters
    ----------
    system : System
        The system.
    initial, parameters : mapping from names to arrays of shape (trajectories,)
        What differs from trajectory to trajectory; a number holds for all. For a system from SymPy its symbols and functions are names too.
    samples : int
        States kept along each trajectory, a million at most, at equal intervals with both ends.
    threads : int, optional
        Threads of this process, as many as the machine runs at once when left out; with an executor each task has one.
    executor : concurrent.futures.Executor or distributed.Client, optional
        Who computes the chunks. Systems pickle, and results have the same bits whoever computes. Where a process of a ``ProcessPoolExecutor`` dies,
        the chunks that are missing are computed in a fresh pool like it, at most three times.
    chunk : int
        Trajectories in one task and in one file.
    out : path, optional
        A folder for one Parquet file a chunk (this needs pyarrow), written by rename under a name that follows from what is computed: a
        computation that was interrupted or killed goes on with the chunks that are missing, or whose files cannot be read to their ends.
    **motion
        ``t_end``, ``tolerance``, ``method`` and the other keywords of a motion, as :meth:`System.simulate` has them; no others.
    progress : bool
        Whether a progress bar is shown, where tqdm is installed.

    Returns
    -------
    Sweep
        A row for each trajectory.

    Raises
    ------
    TypeError
        For a keyword that is none of a motion.
    Interrupted
        By Ctrl-C; its ``result`` has the trajectories that had ended, and is ``None`` where no chunk had.

    Examples
    --------
    >>> import chetaev, numpy as np
    >>> sleigh = chetaev.System.from_gallery("chaplygin-sleigh")
    >>> found = chetaev.ensemble(sleigh, parameters={"a": np.linspace(0.1, 0.5, 9)}, t_end=5)
    >>> found["end_x"].shape
    (9,)
    """
    from .system import _ROWS, System

    if not isinstance(system, System):
        raise TypeError(f"system: a System is needed, not {system!r}")
    own, start = system._by_names("parameters", parameters), system._by_names("initial", initial)
    twice = set(own) & set(start)
    if twice:
        raise ValueError(f"`{min(twice)}` stands among the parameters and among the initial values")
    columns = columns_of({**own, **start})
    _known(motion)
    samples = whole("samples", samples, 0, _ROWS)
    if executor is not None and not hasattr(executor, "submit"):
        raise TypeError(f"executor: one of concurrent.futures, or a client of Dask, is needed, not {type(executor).__name__}")
    if not columns:
        raise ValueError("nothing varies: give arrays in `initial` or `parameters`")
    if executor is None and out is None:
        return system.sweep(rows=columns, samples=samples, threads=threads, progress=progress, **motion)
    chunk = whole("chunk", chunk, 1)
    writable(out)
    count = len(next(iter(columns.values())))
    tasks = [
        _Task(system, {name: values[first : first + chunk] for name, values in columns.items()}, samples, motion, out, executor is None, threads)
        for first in range(0, count, chunk)
    ]
    return _joined(_ended(tasks, executor, progress))


def _known(motion: Mapping[str, Any]) -> None:
    """Whether keywords are those of a motion: others would be no part of what a chunk is called by."""
    import inspect

    from .system import System

    own = set(inspect.signature(System.simulate).parameters) - {"self", "initial", "out", "progress"}
    for name in motion:
        if name not in own:
            raise TypeError(f"`{name}` is no keyword of ensemble, nor of a motion: {', '.join(sorted(own))}")


class _Task:
    """A chunk: what is computed, and where it is kept."""

    def __init__(
        self, system: System, columns: dict[str, NDArray[np.float64]], samples: int, motion: dict[str, Any],
        out: str | os.PathLike[str] | None, here: bool, threads: int | None,
    ) -> None:
        self.system, self.columns, self.samples, self.motion = system, columns, samples, motion
        self.is_here, self.threads = here, threads if here else 1
        self.key = self._key()
        self.path = None if out is None else os.path.join(os.path.abspath(out), f"{self.key}.parquet")

    def _key(self) -> str:
        """What is the same for equal computations, and for no others."""
        from . import __version__
        from .system import _asked

        # Exact texts and numbers.
        asked = _asked(**self.motion)
        said = json.dumps([__version__, self.system._native.texts(), self.samples, asked, list(self.columns)], sort_keys=True)
        digest = hashlib.sha256(said.encode())
        for own in self.columns.values():
            digest.update(own.tobytes())
        return digest.hexdigest()[:32]

    def __call__(self) -> tuple[Any, dict[int, str], list[str]]:
        """Arrays, failures, names of events; of a chunk that another process keeps in a file its path."""
        chunk = None if self.path is None else _kept(self.path)
        if chunk is None:
            found = self.system.sweep(rows=self.columns, samples=self.samples, threads=self.threads, **self.motion)
            chunk = found._arrays, found.failures, list(found.to_dict()["events"])
            if self.path is not None:
                _keep(self.path, *chunk)
        return chunk if self.path is None or self.is_here else (self.path, {}, [])


def _keep(path: str, arrays: Arrays, failures: Mapping[int, str], events: Sequence[str]) -> None:
    """Writes a chunk, with checksums of its pages and of all that is read of it."""
    import pyarrow.parquet as parquet

    sink = io.BytesIO()
    own = {"events": json.dumps(list(events)), "sha256": _checksum(arrays, failures, events)}
    table = _table(arrays, failures).replace_schema_metadata(own)
    parquet.write_table(table, sink, write_page_checksum=True)
    write(path, sink.getvalue())


def _kept(path: str) -> tuple[Arrays, dict[int, str], list[str]] | None:
    """A chunk that is kept in a file; ``None`` where there is none, or where a broken disk has left one that cannot be read to its end."""
    import pyarrow as pa

    try:
        return _read(path)
    except (OSError, ValueError, KeyError, pa.ArrowException):
        return None


def _call(task: _Task) -> tuple[Any, dict[int, str], list[str]]:
    return task()


#: A chunk that ends its process each time is given up after so many fresh pools.
_POOLS = 3


class _Pools:
    """An executor, and fresh ones like it where a process of a pool dies and takes the pool with it."""

    def __init__(self, executor: Any, tasks: list[_Task]) -> None:
        self.executor: Any = executor
        self.tasks = tasks
        self._fresh: list[Any] = []
        self.waiting: list[Any] = []

    def start(self) -> None:
        """Hands all tasks over."""
        for task in self.tasks:
            self.waiting.append(self._submitted(task))

    @property
    def _is_dask(self) -> bool:
        return type(self.executor).__module__.partition(".")[0] == "distributed"

    def _submitted(self, task: _Task) -> Any:
        from concurrent.futures import BrokenExecutor, Future

        try:
            return self._submission(task)
        except BrokenExecutor as problem:
            # A pool that has broken by now takes nothing more.
            broken: Future[Any] = Future()
            broken.set_exception(problem)
            return broken

    def _submission(self, task: _Task) -> Any:
        if self.executor is None:
            return task
        if self._is_dask:
            return self.executor.submit(_call, task, key=f"chetaev-{task.key}")
        return self.executor.submit(_call, task)

    def result(self, number: int) -> tuple[Any, dict[int, str], list[str]]:
        """What a task gave."""
        from concurrent.futures import BrokenExecutor, ProcessPoolExecutor

        if self.executor is None:
            return self.tasks[number]()
        while True:
            try:
                found: tuple[Any, dict[int, str], list[str]] = self.waiting[number].result()
                return found
            except BrokenExecutor:
                if not isinstance(self.executor, ProcessPoolExecutor) or len(self._fresh) >= _POOLS:
                    raise
                own: Any = self.executor
                self.executor = ProcessPoolExecutor(own._max_workers, mp_context=own._mp_context)
                self._fresh.append(self.executor)
                for later in range(number, len(self.tasks)):
                    # Those that had ended before stay.
                    if self.waiting[later].exception() is not None:
                        self.waiting[later] = self._submitted(self.tasks[later])

    def close(self) -> None:
        """Gives up what has not begun; a client of Dask in one message, as each takes its time."""
        if self._is_dask:
            self.executor.cancel(self.waiting)
        elif self.executor is not None:
            for own in self.waiting:
                own.cancel()
        for pool in self._fresh:
            pool.shutdown(wait=False, cancel_futures=True)


def _ended(tasks: list[_Task], executor: Any, progress: bool) -> list[tuple[Any, dict[int, str], list[str]]]:
    """What the tasks gave, in their order."""
    from .system import _Progress

    pools = _Pools(executor, tasks)
    found = []
    with _Progress(progress) as tell:
        try:
            pools.start()
            for number in range(len(tasks)):
                found.append(pools.result(number))
                if tell is not None:
                    tell("computing trajectories", (number + 1) / len(tasks))
        except KeyboardInterrupt as problem:
            if isinstance(problem, Interrupted):
                found.append((problem.result._arrays, problem.result.failures, list(problem.result.to_dict()["events"])))
            raise Interrupted(_joined(found) if found else None) from None
        finally:
            pools.close()
    return found


def _joined(parts: list[tuple[Any, dict[int, str], list[str]]]) -> Sweep:
    import numpy as np

    read = [_read(path) if isinstance(path, str) else (path, failures, events) for path, failures, events in parts]
    failures: dict[int, str] = {}
    before = 0
    for arrays, own, _ in read:
        failures.update({before + number: reason for number, reason in own.items()})
        before += len(arrays["stop"])
    arrays = {name: np.concatenate([own[name] for own, _, _ in read]) for name in read[0][0]}
    return Sweep(arrays, failures, read[0][2])


def _table(arrays: Arrays, failures: Mapping[int, str]) -> Any:
    import pyarrow as pa

    def column(own: NDArray[Any]) -> Any:
        if own.ndim == 1:
            return pa.array(own)
        return pa.FixedSizeListArray.from_arrays(pa.array(own.ravel()), own.shape[1])

    count = len(arrays["stop"])
    reasons = pa.array([failures.get(number) for number in range(count)], type=pa.string())
    return pa.table({**{name: column(own) for name, own in arrays.items()}, "reason": reasons})


def _read(path: str) -> tuple[Arrays, dict[int, str], list[str]]:
    import numpy as np
    import pyarrow as pa
    import pyarrow.parquet as parquet

    table = parquet.read_table(path, page_checksum_verification=True)
    arrays: Arrays = {}
    for name in table.column_names:
        own = table[name].combine_chunks()
        if pa.types.is_fixed_size_list(own.type):
            flat = np.array(own.flatten())
            arrays[name] = flat.reshape(len(own), own.type.list_size)
        elif name != "reason":
            arrays[name] = np.array(own)
    reasons = table["reason"].to_pylist()
    failures = {number: reason for number, reason in enumerate(reasons) if reason is not None}
    told = table.schema.metadata or {}
    events = json.loads(told.get(b"events", b"[]"))
    if told.get(b"sha256", b"").decode() != _checksum(arrays, failures, events):
        raise ValueError(f"{path} holds other trajectories than were written")
    return arrays, failures, events


def _checksum(arrays: Arrays, failures: Mapping[int, str], events: Sequence[str]) -> str:
    """What is the same for equal chunks, and for no others: names and kinds of the columns, numbers, reasons."""
    kinds = [(name, own.dtype.str, own.shape) for name, own in arrays.items()]
    digest = hashlib.sha256(json.dumps([kinds, sorted(failures.items()), list(events)]).encode())
    for own in arrays.values():
        digest.update(own.tobytes())
    return digest.hexdigest()
