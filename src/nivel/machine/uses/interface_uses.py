"""Markers and joints at interfaces, which flexible bodies alone have."""

from collections.abc import Iterator

from nivel.known import MachineRecord
from nivel.machine.core.marker import Marker
from nivel.machine.core.record import Place, Problem


def problems_of_interfaces(machine: MachineRecord) -> Iterator[Problem]:
    """Interfaces that are asked for on bodies that are not flexible."""
    flexible = {body.name for body in machine.bodies if body.flexible is not None}
    for place, marker in markers_of(machine):
        if marker.interface is not None and marker.body not in flexible:
            yield Problem(
                (*place, "interface"), f"`{marker.body}` is not flexible and has no interfaces: give a `position`"
            )
    for at, joint in enumerate(machine.joints):
        if joint.interface is not None and not flexible & set(joint.bodies or ()):
            yield Problem(
                ("joints", at, "interface"), "neither of the bodies is flexible and has interfaces: give a `point`"
            )


def markers_of(machine: MachineRecord) -> Iterator[tuple[Place, Marker]]:
    """Every marker of the machine, also those written out inside an element."""
    for at, marker in enumerate(machine.markers):
        yield ("markers", at), marker
    keys = {
        "joints": ("markers",),
        "forces": ("markers", "wheel", "plane"),
        "hydraulics": ("markers",),
        "sensors": ("distance", "angle"),
    }
    for section, names in keys.items():
        for at, element in enumerate(getattr(machine, section)):
            for key in names:
                ends = getattr(element, key, None)
                if isinstance(ends, Marker):
                    yield (section, at, key), ends
                elif isinstance(ends, tuple):
                    yield from (((section, at, key, k), end) for k, end in enumerate(ends) if isinstance(end, Marker))
