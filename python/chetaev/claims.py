"""What does not belong to one system: the catalogue of claims, and records."""

from __future__ import annotations

import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from typing import Any

from . import chetaev_native as native
from .asked import seconds
from .errors import OptionError
from .results import Explanation, Result, Verification


def explain(claim: str | None = None) -> Explanation:
    """What a claim or a formulation states and how it is decided; all claims when left out.

    Parameters
    ----------
    claim : str, optional
        An id such as ``energy.integral`` or ``formulation.equivalent#maggi``.

    Returns
    -------
    Explanation
        Its text, and the data of ``chetaev explain --json``.
    """
    text, data = native.explain(claim)
    return Explanation(json.loads(data), text)


def verify(
    record: str | os.PathLike[str] | Result | dict[str, Any], *, budget: float = 120.0, independent: bool = False
) -> Verification:
    """Replays the verdicts of a record by other random choices, or has them examined by a program that shares nothing with this one.

    Parameters
    ----------
    record : path, Study, FunctionalStudy or dict
        A ``study.json``, or a study that was written by ``out=``, whose files are held against their checksums; another study, or what its
        ``to_dict()`` gave.
    budget : float
        Work allowed for each of the two replays, in seconds of a usual machine.
    independent : bool
        Lets the checker examine the record instead: a program in Python that knows the theory and the record, and nothing of what
        decided. It runs as a process of its own, and needs Python 3.11.

    Returns
    -------
    Verification
        What is said of each verdict; ``agrees`` says whether nothing disagrees.

    Examples
    --------
    >>> import chetaev
    >>> sleigh = chetaev.System.from_gallery("chaplygin-sleigh")
    >>> chetaev.verify(sleigh.study(claims="energy.integral", t_end=1)).agrees
    True
    """
    folder: str | None = None
    if isinstance(record, Result):
        text, folder = json.dumps(record.to_dict()), record._folder
    elif isinstance(record, dict):
        text = json.dumps(record)
    else:
        folder = os.path.dirname(os.fspath(record))
        with open(record, encoding="utf-8-sig") as file:
            text = file.read()
    if independent:
        said, agrees = _examined(text)
        return Verification(json.loads(said), agrees)
    beside = None if folder is None else _checksums(folder)
    said, agrees = native.verify(text, seconds("budget", budget), None, beside)
    return Verification(json.loads(said), agrees)


def _checksums(folder: str) -> Callable[[str], str | None]:
    """The SHA-256 of files of a folder by their names, ``None`` where one cannot be read."""

    def checksum(name: str) -> str | None:
        try:
            with open(os.path.join(folder, name), "rb") as file:
                return hashlib.sha256(file.read()).hexdigest()
        except OSError:
            return None

    return checksum


def _examined(record: str) -> tuple[str, bool]:
    """What the checker says of a record, and whether it rejects nothing."""
    if sys.version_info < (3, 11):
        raise OptionError("independent: the checker needs Python 3.11 or later")
    with tempfile.TemporaryDirectory(prefix="chetaev-checker-") as folder:
        for name, text in [*native.checker(), ("study.json", record)]:
            path = os.path.join(folder, name)
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "w", encoding="utf-8") as file:
                file.write(text)
        program, read = os.path.join(folder, "check_study.py"), os.path.join(folder, "study.json")
        command = [sys.executable, "-I", "-B", program, read, "--json"]
        done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", check=False)
    if done.returncode not in (0, 1):
        raise OptionError(done.stderr.strip() or "the checker cannot be run")
    return done.stdout, done.returncode == 0
