"""The picture of a live machine on a page: its package, and what of a frame of the run goes into one of the page."""

import json
from collections.abc import Mapping, Sequence
from typing import Any, Final

import numpy as np

from nivel.machine.core.vectors import Array
from nivel.machine.signals.input import Input
from nivel.machine.signals.sensor import Sensor
from nivel.system.layout import FrameLayout, Variable
from nivel.view import package
from nivel.view.package import Block, to_bytes
from nivel.view.records import PROTOCOL, Control, Gauge, Package, Parameter
from nivel.view.sources import machine_stage
from nivel.words.wording import label_of

MOST_GAUGES: Final = 16
MOST_TRACED: Final = 3  # markers that leave their paths in the picture
SHOWN_FIRST: Final = ("sensor.", "state.")


class Picture:
    """The picture of a live machine. package : all that a page needs at first. origin : the point of the global frame from which positions
    are counted [m]. columns : of the gauges in a frame of the run. traced : bodies that are sampled, see `Package.traced`."""

    def __init__(
        self,
        attributes: Mapping[str, Any],
        layout: FrameLayout,
        frame: Array,
        inputs: Sequence[Input],
        sensors: Sequence[Sensor],
        parameters: Sequence[Parameter] = (),
    ) -> None:
        """attributes, layout : of the run, as a result has them. frame : the first one. inputs, parameters : that the page changes."""
        scene, record, block = json.loads(attributes["scene"]), json.loads(attributes["machine_record"]), Block()
        self.places = Places(layout)
        stage = machine_stage(str(attributes["machine"]), scene, record, block, self.places.pose(frame))
        self.origin = np.array(stage.origin)
        self.traced = traced([each.body for each in stage.markers])
        by_name, watched = {each.name: each for each in sensors}, gauges(layout)
        self.columns = [variable.columns.start for _, variable in watched]
        shown = [gauge(name, variable.units, by_name) for name, variable in watched]
        controls = [control(each) for each in inputs]
        self.package = to_bytes(Package(PROTOCOL, "live", [stage], controls, shown, self.traced, [*parameters]), block)

    def row(self, frame: Array) -> Array:
        """What the page draws."""
        return self.places.row(frame, self.origin)

    def sample(self, frame: Array) -> Array:
        """Time, gauges, poses of the bodies that are traced, modal coordinates."""
        row = self.row(frame)
        poses = [row[7 * body : 7 * body + 7] for body in self.traced]
        return np.concatenate([frame[:1], frame[self.columns], *poses, row[self.places.pose_width :]])


class Places:
    """Where poses and modal coordinates stand in the frames of a run."""

    def __init__(self, layout: FrameLayout) -> None:
        columns = {variable.name: variable.columns for variable in layout.variables}
        self.position, self.orientation = columns["position"], columns["orientation"]
        self.modal = columns.get("modal_coordinate", slice(0, 0))
        self.pose_width = 7 * (self.position.stop - self.position.start) // 3  # numbers of all poses in a frame

    def pose(self, frame: Array) -> tuple[Array, Array]:
        """Position (B, 3) and Euler parameters (B, 4) of all bodies."""
        return frame[self.position].reshape(-1, 3), frame[self.orientation].reshape(-1, 4)

    def row(self, frame: Array, origin: Array) -> Array:
        """What the page draws."""
        position, orientation = self.pose(frame)
        return package.rows(position[None] - origin, orientation[None], frame[self.modal][None])[0]


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
