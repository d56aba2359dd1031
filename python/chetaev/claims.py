"""What does not belong to one system: the catalogue of claims, and records."""

from __future__ import annotations

import json
import os
from typing import Any

from . import chetaev_native as native
from .results import Explanation, Study, Verification


def explain(claim: str | None = None) -> Explanation:
    """What a claim or a formulation states and how it is decided; all claims when left out.

    Parameters
    ----------
    claim : str, optional
        An id such as ``energy.integral`` or ``formulation.equivalent#maggi``.
    """
    text, data = native.explain(claim)
    return Explanation(json.loads(data), text)


def verify(record: str | os.PathLike[str] | Study | dict[str, Any], *, budget: float = 120.0) -> Verification:
    """Replays the verdicts of a record by other random choices.

    Parameters
    ----------
    record : path, Study or dict
        A ``study.json``, a study, or what its ``to_dict()`` gave.
    budget : float
        Work allowed for each of the two replays, in seconds of a usual machine.
    """
    if isinstance(record, (Study, dict)):
        text = json.dumps(record.to_dict() if isinstance(record, Study) else record)
    else:
        with open(record, encoding="utf-8-sig") as file:
            text = file.read()
    data, agrees = native.verify(text, budget)
    return Verification(json.loads(data), agrees)
