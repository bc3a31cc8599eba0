"""Memory of a run: every array from which it goes on, to the last bit, when they are put back."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.analysis.assembly.equations import MotionEquations
from nivel.integrate.loop.run import Run


def remembered(run: Run, motion: MotionEquations) -> list[NDArray[Any]]:
    """Every array of the run and of the record but the buffer of frames and the addresses of machine code."""
    twin = () if motion.twin is None else _arrays(motion.twin.record)
    own = [array for name, array in run._asdict().items() if name != "frames"]
    every = [*own, *_arrays(motion.system.record), *twin]
    return [array for array in every if array.size and array.dtype != np.uint64]


def _arrays(record: Any) -> list[NDArray[Any]]:
    """All arrays of a record of records."""
    return [record] if isinstance(record, np.ndarray) else [array for field in record for array in _arrays(field)]
