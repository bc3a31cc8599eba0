"""Two runs side by side: the second one never begins a step where the first one has not been, and makes shorter ones."""

import math
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any, Final, Protocol

import numpy as np

from nivel.integrate.loop.run import ALLOWED, EVALUATIONS, FACTORISATIONS, HORIZON, PARTS, TAKEN, TIME, Run
from nivel.lazy import Struct, field
from nivel.system.system import Array

# A step of the second run is at most this share of the longest one that the first made at that time: of each part of the duration another
# one, which follows no rule that loads may follow.
SHORTEST, SPREAD, IRREGULAR = 0.5, 0.4, (math.sqrt(5.0) - 1.0) / 2.0
# [s] a waiting run looks this often whether it is to end
PATIENCE = 0.05
# evaluations of the rates that take as long as one factorisation with its derivatives, of machines of all sizes about
FACTORISATION = 10


def work(run: Run) -> int:
    """Work of a run so far, in evaluations of the rates: the same on every computer, busy or not."""
    return int(run.counter[EVALUATIONS]) + FACTORISATION * int(run.counter[FACTORISATIONS])


class Pacing(Protocol):
    """What accompanies a run from chunk to chunk."""

    def before(self, run: Run) -> bool:
        """Called before a chunk of steps. Whether the run is to go on."""
        ...

    def after(self, run: Run) -> None:
        """Called after a chunk of steps."""
        ...


class Leader(Struct, frozen=False):
    """Tells how far a run is, how long its steps were and what `work` it did. begun : set when its first step is about to begin.
    most : work after which it ends."""

    changed: threading.Condition = field(default_factory=threading.Condition)
    begun: threading.Event = field(default_factory=threading.Event)
    taken: Array = field(default_factory=lambda: np.zeros(PARTS))
    time: float = 0.0
    over: bool = False
    work: int = 0
    most: float = math.inf

    def before(self, run: Run) -> bool:
        self.begun.set()
        return self.work <= self.most

    def after(self, run: Run) -> None:
        with self.changed:
            self.taken, self.time, self.work = run.pace[TAKEN].copy(), float(run.clock[TIME]), work(run)
            self.changed.notify_all()

    def end(self) -> None:
        """The run is over: there is nothing to wait for any more."""
        with self.changed:
            self.over = True
            self.changed.notify_all()
        self.begun.set()


class Follower(Struct, frozen=False):
    """Bounds the steps of a run that chooses them by those of the run that leads, and keeps it behind. Without a leader it only asks
    whether the run is to stop.

    duration [s] : of both. stop : whether the run is to end. allowed : (PARTS,) [s] what its own settings allow, of the run
    where None. work : done so far.
    """

    leader: Leader | None
    duration: float
    stop: Callable[[], bool]
    allowed: Array | None = None
    work: int = 0

    def before(self, run: Run) -> bool:
        allowed = self.allowed = run.pace[ALLOWED].copy() if self.allowed is None else self.allowed
        if self.leader is not None and not self._wait(self.leader, run, allowed):
            return False
        return not self.stop()

    def after(self, run: Run) -> None:
        self.work = work(run)

    def _wait(self, leader: Leader, run: Run, allowed: Array) -> bool:
        """Wait until the leader has left the part in which this run is; whether it has."""
        while not self.stop():
            with leader.changed:
                parts = PARTS if leader.over else int(leader.time / self.duration * PARTS)
                # what a step may be long depends on the next part, too
                horizon = np.inf if leader.over else (parts - 1) / PARTS * self.duration
                if horizon > run.clock[TIME]:
                    known = leader.taken[:parts]
                    bound = np.where(known > 0.0, _shares(parts) * known, np.inf)
                    run.pace[ALLOWED, :parts] = np.minimum(allowed[:parts], bound)
                    run.clock[HORIZON] = horizon
                    return True
                leader.changed.wait(PATIENCE)
        return False


def _shares(parts: int) -> Array:
    """(parts,) deterministic and irregular numbers between SHORTEST and SHORTEST + SPREAD."""
    return SHORTEST + SPREAD * np.modf(IRREGULAR * np.arange(1, parts + 1))[0]


TERMINATED: Final = 128 + signal.SIGTERM  # exit code, as of shells


@contextmanager
def interruptible() -> Iterator[Callable[[], bool]]:
    """Yields a function that tells whether Ctrl-C (or SIGTERM) came. Outside the main thread nothing is caught."""
    came = False

    def remember(number: int, frame: FrameType | None) -> None:
        nonlocal came
        came = True
        outer = before[number]
        if number == signal.SIGTERM and callable(outer):
            outer(number, frame)

    if threading.current_thread() is not threading.main_thread():
        yield lambda: False
        return
    before: dict[int, Any] = {number: signal.signal(number, remember) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield lambda: came
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


@contextmanager
def terminable() -> Iterator[None]:
    """SIGTERM ends the program, by SystemExit, when the block is left and not inside it; a handler of the program is called instead.

    Outside the main thread, and where the program ignores SIGTERM, nothing is done.
    """
    came = False

    def remember(_number: int, _frame: FrameType | None) -> None:
        nonlocal came
        came = True

    if threading.current_thread() is not threading.main_thread() or signal.getsignal(signal.SIGTERM) is signal.SIG_IGN:
        yield
        return
    before = signal.signal(signal.SIGTERM, remember)
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)
        if came and callable(before):
            before(signal.SIGTERM, None)
        elif came:
            raise SystemExit(TERMINATED)
