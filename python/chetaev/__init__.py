"""Analytical mechanics with nonholonomic constraints: equations in every form, proved verdicts, motions with their drift.

>>> import chetaev
>>> sleigh = chetaev.System.from_gallery("chaplygin-sleigh")
>>> sleigh.coordinates
['x', 'y', 'phi']
>>> study = sleigh.study(claims="energy.integral")
>>> study["energy.integral"].verdict
'proved'
"""

from __future__ import annotations

# First of all, as it says whether the native part may be loaded.
from . import _interpreter  # noqa: F401, I001
from . import errors, gallery
from .chetaev_native import VERSION as __version__
from .claims import explain, verify
from .errors import (
    ChetaevError,
    Interrupted,
    ModelError,
    ModelWarning,
    NotDerivedError,
    OptionError,
)
from .functional import Functional
from .sweeps import Sweep, ensemble
from .system import System

__all__ = [
    "ChetaevError",
    "Functional",
    "Interrupted",
    "ModelError",
    "ModelWarning",
    "NotDerivedError",
    "OptionError",
    "Sweep",
    "System",
    "__version__",
    "ensemble",
    "errors",
    "explain",
    "gallery",
    "verify",
]
