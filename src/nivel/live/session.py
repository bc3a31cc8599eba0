"""A live machine as the server sees it: the solver's process, its memory, commands, the operator, the recording."""

import multiprocessing
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from multiprocessing.shared_memory import SharedMemory
from typing import Final

from nivel.analysis.plan.plan import Plan
from nivel.errors import Fault, ModelError
from nivel.integrate.loop.paced import COMMAND, DONE, HEARD, LOST, MODE, SAVED, SPEED, Live
from nivel.live import shared
from nivel.live.light import Counts, Judge, Light
from nivel.live.preparation import HAND_INPUTS, HAND_PULL, Pace, grip
from nivel.live.recorder import History, Recorder
from nivel.live.recording import Journal, Take, takes_of
from nivel.live.shared import Sizes, bytes_of, copy_of, live_in, soils_in
from nivel.live.solver import Told, main
from nivel.live.timing import Timing, timing_of
from nivel.machine.core.vectors import Array
from nivel.machine.signals.input import Input

LOOK: Final = 1.0  # s between two looks at how far the run can be trusted
POLL: Final = 0.004  # s between two looks for a new frame
OBEYED: Final = 5.0  # s that a command may take
SPEEDS: Final = (0.01, 1.0)  # of simulated over real time
COMMANDS: Final = {
    "run": shared.RUN,
    "pause": shared.PAUSE,
    "step": shared.STEP,
    "reset": shared.RESET,
    "save": shared.SAVE,
    "restore": shared.RESTORE,
}
LEFT: Final = "nivel live was killed; what it recorded is in {path}: `nivel replay {path}` plays it"
GOING_ON: Final = ("run", "step", "save")  # what only a run that is not over can do
MODES: Final = {
    shared.STARTING: "starting",
    shared.RUNNING: "running",
    shared.PAUSED: "paused",
    shared.ENDED: "ended",
    shared.FAILED: "failed",
    shared.GONE: "gone",
}


class Session:
    """A solver that runs in its own process. `on_frame` is called, from a thread, when there is a new frame; `on_gone` when the
    process has ended by itself."""

    def __init__(self, plan: Plan, pace: Pace, *, urgent: bool = True, journal: Journal | None = None) -> None:
        """journal : of what is recorded; None: nothing is."""
        self.plan, self.pace = plan, pace
        self.on_frame: Callable[[], None] = lambda: None
        self.on_gone: Callable[[], None] = lambda: None
        self.said: list[str] = []
        self.parts: Mapping[str, float] = {}  # share of the computing time by part, once it has ended
        self.problem = ""
        self.light = Light()
        self._looked, self.looks = 0.0, 0
        context = multiprocessing.get_context("spawn")
        self._pipe, theirs = context.Pipe()
        left = "" if journal is None else LEFT.format(path=journal.path)
        self._process = context.Process(target=main, args=(theirs, plan, pace, urgent, left), daemon=True)
        self._process.start()
        theirs.close()
        self._lock = threading.Lock()
        self._has_saved = False
        self._newest: Array | None = None
        self.history = History(pace)
        self._ending = self._closing = False
        try:
            self.facts = self._first_word().facts
            self._judge = Judge(self.facts["layout"], self.facts["attributes"])
            self._counts = Counts()
            sizes = Sizes(*self.facts["sizes"])
            self._memory = SharedMemory(create=True, size=bytes_of(sizes))
            try:
                self.live: Live = live_in(self._memory.buf, sizes)
                self.soils = soils_in(self._memory.buf, sizes, self.facts["grounds"])
                for array in self.live:
                    array[...] = 0
                # before the solver has the memory: it counts frames of its first ticks, which leave no trace
                self.recorder = Recorder(self.live, pace, journal)
                self._pipe.send(self._memory.name)
                self._await_start()
                self._hear()
            finally:
                self._memory.unlink()  # both have it now, and it goes with them, however they end
        except BaseException:
            self._process.kill()
            raise
        self._thread = threading.Thread(target=self._watch, daemon=True)
        self._thread.start()

    def _first_word(self) -> Told:
        try:
            told = self._pipe.recv()
        except EOFError:
            raise ModelError("the solver's process has ended before it was ready") from None
        if told.kind == "refused":
            raise ModelError([Fault(**each) for each in told.facts["faults"]] or told.text)
        return told

    def _await_start(self) -> None:
        while int(self.live.control[MODE]) == shared.STARTING:
            if not self._process.is_alive():
                raise ModelError("the solver's process has ended before it was ready")
            time.sleep(POLL)

    # --- what is seen of it ---

    @property
    def mode(self) -> str:
        """running, paused, ended, failed or gone."""
        return MODES[int(self.live.control[MODE])] if self._process.is_alive() else "gone"

    @property
    def newest(self) -> Array | None:
        """The newest frame (width,)."""
        return self._newest

    @property
    def timing(self) -> Timing:
        """Of all ticks so far."""
        return timing_of(self.live)

    @property
    def is_operated(self) -> bool:
        """Whether inputs follow an operator."""
        return int(self.live.control[LOST]) == 0

    @property
    def speed(self) -> float:
        """Simulated over real time."""
        return float(self.live.clock[SPEED])

    def _watch(self) -> None:
        """Gather ticks and frames, hear what the solver says."""
        while not self._closing:
            with self._lock:
                frames = self.recorder.gather()
                if len(frames):
                    self._judge.take(frames)
            if len(frames):
                self.history.add(frames)
                self._newest = frames[-1]
                self.on_frame()
            try:
                self._hear()
            except (EOFError, OSError):
                if not self._ending:
                    self.problem = self.problem or "the solver's process was ended from outside"
                    self.on_frame()
                    self.on_gone()
                return
            # after what the solver has said: of a motion that stands still the light knows all that was counted
            with self._lock:
                if time.monotonic() - self._looked > LOOK:
                    self._look()
            time.sleep(POLL)

    def _look(self) -> None:
        """Find the light. `looks` counts them, and each time it grows the light has been found."""
        steps = int(self.live.control[DONE]) * self.pace.substeps
        failed = self.problem if self.mode in ("failed", "gone") and not self._ending else ""
        self.light = self._judge.light(self.timing, self._counts, steps, failed)
        self._looked, self.looks = time.monotonic(), self.looks + 1

    @property
    def takes(self) -> list[Take]:
        """All motions from the start on that were recorded."""
        with self._lock:
            return takes_of(self.recorder.parts, self.pace)

    def _hear(self) -> None:
        """What the solver has said since. Raises EOFError, OSError where it is gone."""
        while self._pipe.poll():
            told = self._pipe.recv()
            if told.kind == "parts":
                self.parts = told.facts
                continue
            if told.kind == "counts":
                self._counts = Counts(**told.facts)
                continue
            self.said.append(told.text)
            if told.kind == "failed" or self.mode == "ended":
                self.problem = told.text
            self.on_frame()

    # --- what it is told ---

    @property
    def inputs(self) -> tuple[Input, ...]:
        """Those of the machine; the hand has further ones."""
        return self.plan.machine.inputs[:-HAND_INPUTS]

    def operate(self, values: Sequence[float]) -> None:
        """The operator wants these values, in the order of `inputs`."""
        if len(values) == len(self.inputs):
            self.live.target[: len(values)] = values
            self.live.control[HEARD] = time.clock_gettime_ns(time.CLOCK_MONOTONIC)

    def hold(self, body: int, point: Sequence[float], towards: Sequence[float]) -> None:
        """The hand pulls a point of a body, in its frame, towards a point in space [m]; said again and again, as `operate`."""
        if 0 <= body < len(self.plan.machine.bodies):
            own = slice(-HAND_INPUTS, None)
            self.live.target[own] = grip(self.live.value[own].tolist(), body, point, towards)

    def let_go(self) -> None:
        """The hand pulls no more."""
        self.live.target[HAND_PULL - HAND_INPUTS] = 0.0

    def set_speed(self, speed: float) -> None:
        """Simulated over real time, at most 1."""
        self.live.clock[SPEED] = min(max(speed, SPEEDS[0]), SPEEDS[1])

    def command(self, word: str) -> str:
        """Do one of COMMANDS; returns why it was not done, or an empty text."""
        if word == "restore" and not self._has_saved:
            return "no state has been saved"
        if word in GOING_ON and self.mode in ("ended", "failed"):
            return "the run is over: go back to the start, or restore a state"
        goes_back = word in ("reset", "restore")
        running = goes_back and self.mode == "running"
        with self._lock:
            # it waits at the place to which it goes back until that place's frame is known as the first one
            if running and not self._do(shared.PAUSE):
                return "the solver does not answer"
            self.history.add(self.recorder.gather())
            if not self._do(COMMANDS[word]):
                return "the solver does not answer"
            if word == "save":
                self._has_saved = True
                self.history.add(self.recorder.gather())
                self.recorder.save(int(self.live.control[SAVED]))
            if goes_back:
                self.problem = ""
                self._judge.begin_again()
                self.light, self._looked = Light(), time.monotonic()
                self.recorder.begin_again(at_start=word == "reset")
            if running and not self._do(shared.RUN):
                return "the solver does not answer"
        return ""

    def _do(self, code: int) -> bool:
        control = self.live.control
        control[COMMAND] = code
        end = time.monotonic() + OBEYED
        while int(control[COMMAND]) != 0:
            if time.monotonic() > end or not self._process.is_alive():
                control[COMMAND] = 0
                return False
            time.sleep(0.0005)
        return True

    def close(self) -> None:
        """End the process; the recording stays."""
        if self._closing:
            return
        self._ending = True
        self.live.control[COMMAND] = shared.QUIT
        self._process.join(OBEYED)
        if self._process.is_alive():
            self._process.kill()
            self._process.join()
        self._closing = True
        self._thread.join(OBEYED)
        self._judge.take(self.recorder.gather())
        self._look()
        # what looks at the memory after it is gone reads a copy
        self.live = copy_of(self.live)
        self.soils = [(heights.copy(), carried.copy()) for heights, carried in self.soils]
        self.recorder.detach(self.live)
        self._memory.close()

    def values(self) -> Mapping[str, float]:
        """The inputs as they are now."""
        return dict(zip((each.name for each in self.inputs), self.live.value.tolist(), strict=False))
