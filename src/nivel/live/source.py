"""A live machine for the page: frames with gauges, the operator among the pages, commands."""

import threading
import time
from collections.abc import Callable
from typing import Final, Literal, Protocol

import numpy as np

from nivel.lazy import nivel
from nivel.live.picture import Picture
from nivel.live.session import COMMANDS, Session
from nivel.machine.core.vectors import Array
from nivel.view.package import moves_message
from nivel.view.records import Command, Drive, Hold, Note, Status, Take
from nivel.view.sources import Source

PATIENCE: Final = 2.0  # s that an operator may be silent before another one may take over
ONLY_WATCH: Final = "a program operates the machine by datagrams; this page can only watch"
NO_INPUTS: Final = "the inputs of this machine come by datagrams, not from a page"


class Program(Protocol):
    """What operates a machine from outside its pages."""

    @property
    def is_driving(self) -> bool:
        """Whether it does so now."""
        ...


class LiveSource(Source):
    """A session that pages look at; one of them at a time operates it."""

    def __init__(self, session: Session, program: Program | None = None) -> None:
        """program : something other than a page that operates the machine; pages cannot move its inputs, and only watch while it drives."""
        super().__init__()
        self.forgiving = True
        self._session = session
        self._lock = threading.Lock()
        self._program = program
        self._driver: object | None = None
        self._heard = 0.0
        attributes, layout = session.facts["attributes"], session.facts["layout"]
        while session.newest is None:
            time.sleep(0.005)
        self._picture = Picture(attributes, layout, session.newest, session.inputs, session.plan.machine.sensors)
        session.on_frame = self._tell

    def _tell(self) -> None:
        """There is a new frame, for whoever shows this source now."""
        self.on_change()

    def package(self) -> bytes:
        return self._picture.package

    def frame(self) -> tuple[float, Array] | None:
        newest = self._session.newest
        if newest is None:
            return None
        picture = self._picture
        values = self._session.live.value[: len(self._session.inputs)]
        return float(newest[0]), np.concatenate([picture.row(newest), newest[picture.columns], values])

    def samples(self, after: int) -> tuple[int, Array]:
        last, found = self._session.history.after(after)
        return last, np.array([self._picture.sample(frame) for frame in found])

    def moves(self) -> Callable[[], list[bytes]]:
        session = self._session
        trackers = [nivel.results.terrain.Tracker(start, cell) for start, _, cell in session.facts["grounds"]]
        return lambda: [
            moves_message(k, *tracker.moves(heights), carried)
            for k, (tracker, (heights, carried)) in enumerate(zip(trackers, session.soils, strict=True))
        ]

    # --- operators ---

    def hear(self, page: object, said: Drive | Hold | Take | Command) -> Note | None:
        match said:
            case Take(on=on):
                return self._take(page, on != 0)
            case Drive(values=values):
                if page is self._driver:
                    self._heard = time.monotonic()
                    self._session.operate(values)
                return None
            case Hold(body=body, point=point, towards=towards, on=on):
                if page is self._driver and len(point) == len(towards) == 3:
                    if on:
                        self._session.hold(body, point, (np.array(towards) + self._picture.origin).tolist())
                    else:
                        self._session.let_go()
                return None
            case Command(word=word, number=number):
                return self._command(page, word, number)

    def _take(self, page: object, on: bool) -> Note | None:
        with self._lock:
            silent = time.monotonic() - self._heard > PATIENCE
            if on and self._program is not None:
                return Note("note", self._watches or NO_INPUTS)
            if on and self._driver not in (None, page) and not silent:
                return Note("note", "another person operates the machine")
            if on:
                self._driver, self._heard = page, time.monotonic()
            elif page is self._driver:
                self._driver = None
                self._session.let_go()
        return None

    @property
    def _watches(self) -> str:
        """Why no page may do anything to the machine now, or empty."""
        return ONLY_WATCH if self._program is not None and self._program.is_driving else ""

    def _command(self, page: object, word: str, number: float) -> Note | None:
        if self._watches:
            return Note("note", self._watches)
        if page is not self._driver and self._program is None:
            return Note("note", "take the controls first")
        if word == "speed":
            self._session.set_speed(number)
            return None
        problem = self._session.command(word) if word in COMMANDS else "there is no such command"
        return Note("note", problem) if problem else None

    def leave(self, page: object) -> None:
        with self._lock:
            if page is self._driver:
                self._driver = None
                self._session.let_go()

    def _driver_for(self, page: object) -> Literal["you", "other", "nobody", "program"]:
        if self._program is not None:
            return "program"
        return "nobody" if self._driver is None else "you" if page is self._driver else "other"

    def status(self, page: object, dropped: int) -> Status | None:
        session = self._session
        timing, newest = session.timing, session.newest
        return Status(
            type="status",
            mode=session.mode,
            time=0.0 if newest is None else float(newest[0]),
            speed=session.speed,
            driver=self._driver_for(page),
            watches=self._watches,
            operated=session.is_operated,
            computing=1e6 * timing.computing[2],
            late=1e6 * timing.lateness[2],
            tick=1e6 * timing.tick,
            overruns=timing.overruns,
            own=timing.own,
            dropped=dropped,
            text=session.problem,
            light=session.light.verdict,
            reasons=list(session.light.reasons),
        )
