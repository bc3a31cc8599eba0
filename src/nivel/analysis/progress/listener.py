"""Listeners to the progress of a long computation."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

Progress = Callable[[float], None]
Stage = Callable[[str, float | None], None]


@dataclass(frozen=True)
class Listener:
    """`stage` hears what begins and how long it is (None: unknown), `progress` how far it is; for a run both are times [s]."""

    stage: Stage | None = None
    progress: Progress | None = None

    def say(self, text: str, total: float | None = None) -> None:
        """Tell what begins now."""
        if self.stage is not None:
            self.stage(text, total)
