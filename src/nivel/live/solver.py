"""The solver's process: it prepares the machine, ticks, and does what it is told between two ticks."""

import contextlib
import multiprocessing
import os
import signal
import threading
import time
from multiprocessing.connection import Connection
from multiprocessing.shared_memory import SharedMemory
from typing import Any, Final

from nivel.analysis.plan.plan import Plan
from nivel.errors import ModelError, NivelError
from nivel.integrate.loop import paced
from nivel.integrate.loop.run import ACCEPTED, MOVING, REJECTED, STOPPED
from nivel.integrate.loop.run import STEP as STEP_CLOCK
from nivel.judge.during.failure import failure
from nivel.judge.during.stop import Stop
from nivel.kernels.core import status as codes
from nivel.lazy import Struct, asdict, field, nivel
from nivel.live import shared
from nivel.live.preparation import LiveRun, Pace, prepared_run
from nivel.live.shared import Snapshot, arrays_in, live_in, put_back, soils_in, taken
from nivel.live.timing import ENTRIES, become_urgent, give_clocks, shares
from nivel.native import library

ROUND: Final = 0.5  # s that the compiled loop goes on before Python has a turn
ENDING: Final = (signal.SIGINT, signal.SIGTERM, *([signal.SIGHUP] if hasattr(signal, "SIGHUP") else []))
FIRST: Final = 20  # ticks that are done for nothing
REST: Final = 0.004  # s between two looks at the commands while nothing moves


class Told(Struct, frozen=False):
    """What the solver says over its pipe. kind : ready, said, failed, refused, parts, counts."""

    kind: str
    text: str = ""
    facts: dict[str, Any] = field(default_factory=dict)


def main(pipe: Connection, plan: Plan, pace: Pace, urgent: bool, left: str) -> None:
    """The life of the process: prepare, say what is needed, get the memory, tick.

    Signals that end a program, which all processes of a terminal get, are for the server, which then ends this one. left : what is said
    where the server ends without a word.
    """
    for number in ENDING:
        signal.signal(number, signal.SIG_IGN)
    threading.Thread(target=_end_with_the_server, args=(left,), daemon=True).start()
    try:
        live_run = prepared_run(plan, pace)
    except NivelError as error:
        faults = [asdict(each) for each in error.faults] if isinstance(error, ModelError) else []
        pipe.send(Told("refused", str(error), {"faults": faults}))
        return
    pipe.send(Told("ready", facts=_facts(live_run)))
    try:
        memory = SharedMemory(pipe.recv())
    except (EOFError, FileNotFoundError):
        return
    for soil, (heights, carried) in zip(
        live_run.soils, soils_in(memory.buf, live_run.sizes, live_run.grounds), strict=True
    ):
        soil.move(h=heights, volume=carried)
    with contextlib.suppress(BrokenPipeError):
        Solver(live_run, live_in(memory.buf, live_run.sizes), pipe).live(urgent)
    # the arrays still look at the memory, which goes with the process
    os._exit(0)


def _end_with_the_server(left: str) -> None:
    """Wait until the server is gone, however it went, and end this process."""
    server = multiprocessing.parent_process()
    if server is None:
        return
    server.join()
    if left:
        with contextlib.suppress(OSError):
            os.write(2, f"{left}\n".encode())
    os._exit(1)


def _facts(live_run: LiveRun) -> dict[str, Any]:
    """What the server has to know of the machine as it was assembled."""
    system = live_run.prepared.motion.system
    attributes = nivel.analysis.preparation.attributes.run_attributes(
        live_run.plan.machine, "", live_run.prepared, live_run.plan.settings
    )
    return {
        "sizes": tuple(live_run.sizes),
        "grounds": live_run.grounds,
        "layout": system.layout,
        "attributes": attributes,
    }


class Solver:
    """A machine that lives in this process."""

    def __init__(self, live_run: LiveRun, live: paced.Live, pipe: Connection) -> None:
        self._its, self._live, self._pipe = live_run, live, pipe
        self._drive = live_run.begin(live)
        give_clocks(live)
        self._arrays = arrays_in([*live_run.records, (live.value,)])
        self._start = taken(self._arrays, 0)
        self._saved: Snapshot | None = None
        self._guards = live_run.prepared.guards_circuits
        self._counts: dict[str, float] = {}

    def live(self, urgent: bool) -> None:
        """Tick and obey until told to end."""
        control = self._live.control
        for sentence in become_urgent() if urgent else ["no real-time priority was asked for"]:
            self._pipe.send(Told("said", sentence))
        self._warm_up()
        self._its.show(self._live)
        control[paced.MODE] = shared.PAUSED
        control[paced.PACED] = 1
        while True:
            command = int(control[paced.COMMAND])
            if command == shared.QUIT:
                break
            if command:
                self._obey(command)
                control[paced.NEXT] = 0
                control[paced.COMMAND] = 0
            elif control[paced.MODE] == shared.RUNNING:
                self._drive_once(max(1, int(ROUND / self._its.pace.tick)))
            else:
                time.sleep(REST)
        self._pipe.send(Told("parts", facts=self._parts()))
        control[paced.MODE] = shared.GONE

    def _parts(self) -> dict[str, float]:
        """Share of the computing time by part, where that can be measured without compiling."""
        control = self._live.control
        control[paced.PACED] = 0
        if control[paced.MODE] not in (shared.RUNNING, shared.PAUSED) or library.missing(ENTRIES):
            return {}
        return shares(self._its, control, self._drive)

    def _warm_up(self) -> None:
        """Some ticks that leave no trace: the first ones, whose code and memory were never touched before, take longest."""
        control = self._live.control
        control[paced.TICKS] = FIRST
        self._drive()
        put_back(self._arrays, self._start)
        control[[paced.DONE, paced.SHOWN]] = 0

    def _drive_once(self, ticks: int) -> None:
        control = self._live.control
        control[paced.TICKS] = ticks
        status = self._drive()
        self._tell_counts()
        if status == codes.BUDGET_SPENT:
            return
        self._its.show(self._live)
        if status == codes.DONE:
            stopped = int(self._its.run.counter[STOPPED])
            events = self._its.prepared.motion.system.events
            control[paced.MODE] = shared.ENDED
            self._pipe.send(
                Told("said", f"the run has ended{f' at the event {events[stopped - 1]}' if stopped else ''}; reset it")
            )
        else:
            control[paced.MODE] = shared.FAILED
            self._pipe.send(Told("failed", self._why(status)))

    def _tell_counts(self) -> None:
        """Say what the steps counted since, where it has changed."""
        run, guard = self._its.run, self._its.prepared.motion.system.record.circuit.guard
        counts = {"kinetic_energy": float(run.pace[MOVING].max()), "guards": self._guards}
        if self._guards:
            counts |= {"divided": int(run.counter[REJECTED]), "guarded": int(guard[0]), "difference": float(guard[1])}
        if counts != self._counts:
            self._counts = counts
            self._pipe.send(Told("counts", facts=counts))

    def _why(self, status: int) -> str:
        run, prepared = self._its.run, self._its.prepared
        at = float(run.clock[ACCEPTED])
        message, advice = failure(Stop(prepared.motion, status, at, float(run.clock[STEP_CLOCK]), run.previous))
        return f"{message}. {advice}" if advice else message

    def _obey(self, command: int) -> None:
        control = self._live.control
        alive = control[paced.MODE] in (shared.RUNNING, shared.PAUSED)
        if command == shared.RUN and alive:
            control[paced.MODE] = shared.RUNNING
        elif command == shared.PAUSE and alive:
            control[paced.MODE] = shared.PAUSED
        elif command == shared.STEP and alive:
            control[paced.MODE] = shared.PAUSED
            self._drive_once(1)
            self._its.show(self._live)
        elif command == shared.SAVE and alive:
            self._saved = taken(self._arrays, int(control[paced.DONE]))
            control[paced.SAVED] = self._saved.ticks
        elif command == shared.RESET or (command == shared.RESTORE and self._saved is not None):
            self._go_to(self._start if command == shared.RESET or self._saved is None else self._saved)

    def _go_to(self, snapshot: Snapshot) -> None:
        control = self._live.control
        put_back(self._arrays, snapshot)
        control[paced.DONE] = snapshot.ticks
        if control[paced.MODE] != shared.RUNNING:
            control[paced.MODE] = shared.PAUSED
        self._its.show(self._live)
