"""Markers and joints that name an interface of a flexible body instead of a place."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from difflib import get_close_matches

import numpy as np

from nivel.errors import Fault, ModelError, located
from nivel.flexible.body.body import Interface
from nivel.machine.core.marker import Marker
from nivel.machine.core.placement import marker_frame
from nivel.machine.joints.joint import Joint
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.interface_uses import markers_of
from nivel.system.flexible import reduced_body
from nivel.system.tables import Array

# [m] two interfaces nearer than this, as placed, are one place of a joint
SAME = 1e-9


def refuse_unknown_interfaces(machine: MachineRecord) -> None:
    """Raises ModelError naming every marker and joint at an interface that is not there."""
    faults: list[Fault] = []
    for place, marker in markers_of(machine):
        section, at = str(place[0]), int(place[1])
        if marker.interface is not None:
            with _gathered(faults, f"{section}.{getattr(machine, section)[at].name}"):
                interface_of(machine, marker.body, marker.interface)
    for joint in machine.joints:
        if joint.interface is not None:
            with _gathered(faults, f"joints.{joint.name}.interface"):
                joint_point(machine, joint)
    if faults:
        raise ModelError(faults)


@contextmanager
def _gathered(faults: list[Fault], place: str) -> Iterator[None]:
    """Faults that come up inside are added, with their place where they have none."""
    try:
        with located(place):
            yield
    except ModelError as error:
        faults += error.faults


def marker_place(machine: MachineRecord, marker: Marker) -> tuple[str, Array, Array]:
    """Body, point (3,) [m] and axes (3, 3) of a marker in the frame of its body; its interface exists."""
    position, axes = marker_frame(marker)
    if marker.interface is not None:
        position = interface_of(machine, marker.body, marker.interface).position
    return marker.body, position, axes


def interface_of(machine: MachineRecord, body: str, name: str) -> Interface:
    """The interface `name` of a flexible body. Raises ModelError where there is none."""
    reduced = reduced_body(machine.body_named[body])
    names = [each.name for each in reduced.interfaces]
    if name not in names:
        near = get_close_matches(name, names, n=1)
        hint = f"did you mean `{near[0]}`?" if near else f"there are {', '.join(names) or 'none'}"
        raise ModelError(Fault("", 0, 0, "", f"the flexible body `{body}` has no interface `{name}`; {hint}"))
    return reduced.interface(name)


def joint_point(machine: MachineRecord, joint: Joint) -> Array:
    """(3,) [m] the global point of a joint placed by one, as its bodies are placed: given, or that of the interface it names.

    Raises ModelError where none of its bodies has this interface, or both at different places.
    """
    if joint.interface is None:
        return np.array(joint.point, dtype=float)
    assert joint.bodies is not None  # the record was checked
    faults: list[Fault] = []
    points = []
    for body in joint.bodies:
        if body in machine.body_named and machine.body_named[body].flexible is not None:
            with _gathered(faults, ""):
                interface = interface_of(machine, body, joint.interface)
                position, axes = machine.placed[body]
                points.append(position + axes @ interface.position)
    if not points:
        raise ModelError(faults)
    if np.linalg.norm(points[0] - points[-1]) > SAME * (1.0 + np.abs(points).max()):
        message = (
            f"both bodies have an interface `{joint.interface}`, at different places: give the joint by two `markers`"
        )
        raise ModelError(Fault("", 0, 0, "", message))
    return points[0]
