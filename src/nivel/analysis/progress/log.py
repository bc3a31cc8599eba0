"""A log of a long computation: plain lines for a file or a pipe, where no bar can be drawn."""

import re
import sys
import time
from collections.abc import Callable
from typing import Any, Final, TextIO

from nivel.lazy import Struct, rich

STEPS: Final = 10  # of a stage: after each it is worth a line again
SOONEST: Final = 1.0  # s between two lines about one stage
LATEST: Final = 10.0  # s after which a stage that goes on is worth a line, however little of it is done
_COUNTED: Final = re.compile(r"\b(\d+) of (\d+)\b")


Progress = Callable[[float], None]
Stage = Callable[[str, float | None], None]


class Listener(Struct):
    """`stage` hears what begins and how long it is (None: unknown), `progress` how far it is; for a run both are times [s]."""

    stage: Stage | None = None
    progress: Progress | None = None

    def say(self, text: str, total: float | None = None) -> None:
        """Tell what begins now."""
        if self.stage is not None:
            self.stage(text, total)


class Log:
    """Writes a line where a stage begins, and further ones about a long stage. The lines hold no control characters.

    Stages that are counted, as `compiled 3 of 40`, are one stage, of which a tenth of the lines is written.
    """

    def __init__(self, stream: TextIO | None = None, clock: Callable[[], float] = time.monotonic) -> None:
        """stream : default standard error."""
        self._stream, self._clock = stream, clock
        self._begin = self._said = clock()
        self._text, self._total = "", 0.0
        self._share = 0.0  # of the present stage that was told
        self._is_counted = False

    @property
    def listener(self) -> Listener:
        """What a computation tells."""
        return Listener(self.stage, self.progress)

    def stage(self, text: str, total: float | None = None) -> None:
        """A stage begins, or goes on where its text is counted."""
        counted = _COUNTED.search(text)
        if counted is not None:
            share = int(counted[1]) / max(int(counted[2]), 1)
            if int(counted[1]) == 1 or self._is_due(share):
                self._write(text, share)
        elif text != self._text:
            self._write(text, 0.0)
        self._text, self._total, self._is_counted = text, total or 0.0, counted is not None

    def progress(self, reached: float) -> None:
        """So much of the total of the stage is done."""
        if self._total > 0.0:
            share = min(max(reached / self._total, 0.0), 1.0)
            if self._is_due(0.0 if self._is_counted else share):
                self._write(f"{self._text}: {100.0 * share:.0f} %", self._share if self._is_counted else share)

    def end(self) -> None:
        """Nothing more follows."""
        self._write(f"ended after {self._clock() - self._begin:.1f} s", 0.0)

    def _is_due(self, share: float) -> bool:
        waited = self._clock() - self._said
        return waited >= LATEST or (waited >= SOONEST and _steps(share) > _steps(self._share))

    def _write(self, text: str, share: float) -> None:
        self._said, self._share = self._clock(), share
        print(text, file=self._stream or sys.stderr, flush=True)


def _steps(share: float) -> int:
    """How many steps of a stage are done."""
    return int(STEPS * share + 1e-9)


def bar_of(*columns: Any) -> "rich.progress.Progress":
    """A bar in a terminal, gone when it ends: what is being done, how far, and these columns."""
    first = (rich.progress.TextColumn("{task.description}"), rich.progress.BarColumn())
    return rich.progress.Progress(*first, *columns, console=rich.console.Console(stderr=True), transient=True)
