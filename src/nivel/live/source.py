"""A live machine for the page: frames with gauges, the operator among the pages, commands."""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Mapping, Sequence
from typing import Any, Final, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from nivel.live.session import COMMANDS, Session
from nivel.machine.signals.input import Input
from nivel.machine.signals.sensor import Sensor
from nivel.system.layout import FrameLayout, Variable
from nivel.view import frames
from nivel.view.package import Block, to_bytes
from nivel.view.records import PROTOCOL, Command, Control, Drive, Gauge, Hold, Note, Package, Status, Take
from nivel.view.sources import Still, machine_stage
from nivel.words.wording import label_of

Array = NDArray[np.float64]
MOST_GAUGES: Final = 16
MOST_TRACED: Final = 3  # markers that leave their paths in the picture
PATIENCE: Final = 2.0  # s that an operator may be silent before another one may take over
SHOWN_FIRST: Final = ("sensor.", "state.")
ONLY_WATCH: Final = "a program operates the machine by datagrams; this page can only watch"
NO_INPUTS: Final = "the inputs of this machine come by datagrams, not from a page"


class Program(Protocol):
    """What operates a machine from outside its pages."""

    @property
    def is_driving(self) -> bool:
        """Whether it does so now."""
        ...


class LiveSource(Still):
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
        self._places = _Places(layout)
        self._gauges = gauges(layout)
        self._columns = [variable.columns.start for _, variable in self._gauges]
        self._package = self._packed(attributes)
        session.on_frame = self._tell

    def _packed(self, attributes: dict[str, Any]) -> bytes:
        scene, record, block = json.loads(attributes["scene"]), json.loads(attributes["machine_record"]), Block()
        while self._session.newest is None:
            time.sleep(0.005)
        stage = machine_stage(
            str(attributes["machine"]), _Pose(scene, self._places, self._session.newest), record, block
        )
        self._origin = np.array(stage.origin)
        controls = [control(each) for each in self._session.inputs]
        sensors = {each.name: each for each in self._session.plan.machine.sensors}
        shown = [gauge(name, variable.units, sensors) for name, variable in self._gauges]
        self._traced = traced([each.body for each in stage.markers])
        return to_bytes(Package(PROTOCOL, "live", [stage], controls, shown, self._traced), block)

    def _tell(self) -> None:
        """There is a new frame, for whoever shows this source now."""
        self.on_change()

    def package(self) -> bytes:
        return self._package

    def frame(self) -> tuple[float, Array] | None:
        newest = self._session.newest
        if newest is None:
            return None
        row = self._places.row(newest, self._origin)
        return float(newest[0]), np.concatenate(
            [row, newest[self._columns], self._session.live.value[: len(self._session.inputs)]]
        )

    def samples(self, after: int) -> tuple[int, Array]:
        last, found = self._session.history.after(after)
        return last, np.array([self._sample(frame) for frame in found])

    def _sample(self, frame: Array) -> Array:
        """Time, gauges, poses of the bodies that are traced, modal coordinates."""
        row = self._places.row(frame, self._origin)
        poses = [row[7 * body : 7 * body + 7] for body in self._traced]
        return np.concatenate([frame[:1], frame[self._columns], *poses, row[self._places.pose_width :]])

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
                        self._session.hold(body, point, (np.array(towards) + self._origin).tolist())
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


class _Places:
    """Where poses and modal coordinates stand in the frames of a run."""

    def __init__(self, layout: FrameLayout) -> None:
        columns = {variable.name: variable.columns for variable in layout.variables}
        self._position, self._orientation = columns["position"], columns["orientation"]
        self._modal = columns.get("modal_coordinate", slice(0, 0))
        self.pose_width = 7 * (self._position.stop - self._position.start) // 3  # numbers of all poses in a frame

    def pose(self, frame: Array) -> tuple[Array, Array]:
        """Position (B, 3) and Euler parameters (B, 4) of all bodies."""
        return frame[self._position].reshape(-1, 3), frame[self._orientation].reshape(-1, 4)

    def row(self, frame: Array, origin: Array) -> Array:
        """What the page draws."""
        position, orientation = self.pose(frame)
        return frames.rows(position[None] - origin, orientation[None], frame[self._modal][None])[0]


class _Pose:
    """A machine that does not move, for the first picture."""

    movements = ()

    def __init__(self, scene: dict[str, Any], places: _Places, frame: Array) -> None:
        self.scene = scene
        self._pose = places.pose(frame)

    def pose(self) -> tuple[Array, Array]:
        return self._pose

    def values(self) -> list[float]:
        return []

    def move(self, name: str, value: float) -> str:
        return ""

    def reset(self) -> None:
        pass


def gauges(layout: FrameLayout) -> list[tuple[str, Variable]]:
    """Single numbers that are worth to be watched: sensors, else states, else joint coordinates."""
    single = [each for each in layout.variables if each.columns.stop == each.columns.start + 1]
    for kind in SHOWN_FIRST:
        chosen = [(each.name.partition(".")[2], each) for each in single if each.name.startswith(kind)]
        if chosen:
            return chosen[:MOST_GAUGES]
    whole = next(each for each in layout.variables if each.name == "joint_coordinate")
    names = layout.coordinates["joint_coordinate"]
    return [
        (name, Variable(name, ("time",), "", name, slice(whole.columns.start + k, whole.columns.start + k + 1)))
        for k, name in enumerate(names)
    ][:MOST_GAUGES]


def gauge(name: str, unit: str, sensors: Mapping[str, Sensor]) -> Gauge:
    """A number as the page shows it; a sensor's with what its machine file says of it."""
    its, _, part = name.partition(".")
    sensor = sensors.get(its)
    if sensor is None:
        return Gauge(name, label_of(name), unit, None, None, None)
    label = sensor.label or label_of(its)
    if part and part != sensor.form:  # the scale is not of the rate of a distance, nor of a component
        return Gauge(name, f"{label}, {part}", unit, None, None, None)
    low, high = sensor.range or (None, None)
    return Gauge(name, label, unit, low, high, sensor.limit)


def traced(bodies: Sequence[int]) -> list[int]:
    """The bodies of few markers; of many none."""
    return sorted(set(bodies)) if len(bodies) <= MOST_TRACED else []


def control(given: Input) -> Control:
    """An input as the page shows it."""
    keys, pad = given.keys, given.gamepad
    return Control(
        name=given.name,
        label=given.label or label_of(given.name),
        unit=given.units,
        description=given.description,
        low=given.range[0],
        high=given.range[1],
        rest=given.rest_value,
        hold=given.hold,
        look=given.control,
        stick=given.stick or "",
        raises=keys.raise_ or "" if keys else "",
        lowers=keys.lower or "" if keys else "",
        axis=-1 if pad is None or pad.axis is None else pad.axis,
        button=-1 if pad is None or pad.button is None else pad.button,
        reverse=pad.reverse if pad else False,
        dead_zone=pad.dead_zone if pad else 0.0,
        exponent=pad.exponent if pad else 1.0,
    )
