"""Arrays by their numbers of axes: what annotations say where the number is fixed.

Python does not evaluate annotations, so that nothing imports NumPy for them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

    Vector = np.ndarray[tuple[int], np.dtype[np.float64]]
    Matrix = np.ndarray[tuple[int, int], np.dtype[np.float64]]
    #: A matrix for each of many times.
    Matrices = np.ndarray[tuple[int, int, int], np.dtype[np.float64]]
    Numbers = np.ndarray[tuple[int], np.dtype[np.uint64]]
    ComplexVector = np.ndarray[tuple[int], np.dtype[np.complex128]]
