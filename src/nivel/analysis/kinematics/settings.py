"""Settings of `nivel kinematics`, checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Any

from nivel.errors import Fault, ModelError
from nivel.machine.machine_record import MachineRecord
from nivel.machine.units.quantity import expression_fault, read_quantity, shown
from nivel.machine.units.tree import ExpressionError
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, UnknownCoordinateError, resolve

POSITIONS, MOST = 361, 10_000_000


@dataclass(frozen=True)
class KinematicsSettings:
    """duration [s], positions : so many, both ends included. drive : joint coordinate that is driven besides what the machine drives,
    evenly, from `start` to `end` [rad or m]; None: where it is at the start; and one turn further. coordinates : auto, absolute, relative.
    """

    duration: float
    positions: int
    drive: str = ""
    start: float | None = None
    end: float | None = None
    coordinates: str = "auto"

    @property
    def step(self) -> float:
        """[s] from position to position."""
        return self.duration / (self.positions - 1)

    def as_dict(self) -> dict[str, object]:
        """For the result's `settings`."""
        return {"analysis": "kinematics", **asdict(self), "step": self.step}


def kinematics_settings(machine: MachineRecord, given: Mapping[str, Any]) -> KinematicsSettings:
    """Settings from options; None stands for what was not given. Raises ModelError with everything that is wrong."""
    faults: list[Fault] = []

    def fault(name: str, message: str) -> None:
        faults.append(Fault("", 0, 0, f"kinematics.{name}", message))

    def quantity(name: str, kind: str) -> float | None:
        value = given.get(name)
        if value is None:
            return None
        try:
            return read_quantity(value, kind, {})
        except ExpressionError as problem:
            fault(name, expression_fault(problem, value).message())
            return None

    drive = _driven(machine, given.get("drive"), fault)
    kind = COORDINATE_KINDS[drive.partition(".")[2]] if drive else "angle"
    for name in ("start", "end"):
        if given.get(name) is not None and given.get("drive") is None:
            fault(name, "belongs to a coordinate that is driven: name it with `drive`")
    start, end = (quantity(name, kind) for name in ("start", "end"))
    if drive and kind == "length" and end is None and not faults:
        fault("end", f"`{drive}` is a length: say to which one it is driven")
    duration = quantity("duration", "time")
    if duration is None:
        duration = 1.0 if drive else machine.simulation.duration
    if not duration > 0.0:
        fault("duration", f"a time greater than zero was expected, got {shown(given.get('duration'))}")
    positions = _whole(given.get("positions"))
    if positions is None or not 2 <= positions <= MOST:
        fault("positions", f"a whole number from 2 to {MOST} was expected, got {shown(given.get('positions'))}")
    coordinates = given.get("coordinates") or "auto"
    if coordinates not in ("auto", "absolute", "relative"):
        fault("coordinates", f"'{coordinates}' is not one of auto, absolute, relative")
    if faults:
        raise ModelError(faults)
    return KinematicsSettings(duration, positions or POSITIONS, drive, start, end, coordinates)


def _driven(machine: MachineRecord, name: Any, fault: Any) -> str:
    """The full name of the coordinate to be driven; empty for none."""
    if name is None:
        return ""
    try:
        joint, coordinate = resolve(str(name), machine.joints)
    except UnknownCoordinateError as error:
        fault("drive", str(error))
        return ""
    return f"{joint}.{coordinate}"


def _whole(value: Any) -> int | None:
    try:
        return POSITIONS if value is None else int(value)
    except ValueError:
        return None
