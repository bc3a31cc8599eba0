"""Sinks that take the frames of a running simulation."""

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from nivel.lazy import dataclass
from nivel.system.layout import FrameLayout


@dataclass(frozen=True)
class Header:
    """What is known before the first frame.

    attributes : `machine`, `machine_record` (JSON), `machine_source`, `scene` (JSON), `settings` (JSON),
        `coordinate_units` (JSON), `nivel_version`, `result_format`, `outcome` ("running").
    """

    layout: FrameLayout
    attributes: dict[str, str | float | int]


class Sink(Protocol):
    """Anything that accepts the frames of a run, in the order of time."""

    def begin(self, header: Header) -> None:
        """Called once, before the first frame."""
        ...

    def take(self, frames: NDArray[np.float64]) -> None:
        """Frames (n, width), n ≥ 1, laid out as `header.layout` says; the array is reused after the call."""
        ...
