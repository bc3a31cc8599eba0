"""Settings of kinematics: the coordinate that is driven, and the positions that are found."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from nivel.errors import Fault, ModelError, refuse
from nivel.machine.core.record import Record
from nivel.machine.given import Field, Maybe
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.values import FEWEST_POSITIONS, POSITIONS, OfStatics, Positions, Way, settings_of
from nivel.machine.units.quantity import Duration, expression_fault, read_quantity
from nivel.machine.units.tree import ExpressionError
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, Kind, UnknownCoordinateError, resolve


class KinematicsSettings(Record):
    """Settings of kinematics."""

    drive: str = Field(
        default="",
        description="joint coordinate that is driven at constant speed, e.g. hinge.angle",
        option="--drive COORDINATE",
    )
    start: Maybe[Way] = Field(
        default=None,
        description="first value of this coordinate, e.g. '10 deg'",
        option="--from VALUE",
        absent="its value in the assembled machine",
    )
    end: Maybe[Way] = Field(
        default=None, description="last value of this coordinate", option="--to VALUE", absent="one turn more"
    )
    duration: Duration = Field(
        default=1.0, description="duration of the motion", absent="that of the machine, 1 s with --drive"
    )
    positions: Maybe[Positions] = Field(
        default=None, description="number of positions, both ends included", absent=FEWEST_POSITIONS
    )
    coordinates: OfStatics = Field(default="auto", description="coordinates of the equations")

    @property
    def step(self) -> float:
        """[s] from position to position."""
        return self.duration / ((self.positions or POSITIONS) - 1)

    def as_dict(self) -> dict[str, object]:
        """For the result's `settings`."""
        return {"analysis": "kinematics", **self.model_dump(), "step": self.step}


def kinematics_settings(machine: MachineRecord, given: Mapping[str, Any]) -> KinematicsSettings:
    """Settings for a machine, with the full name of the coordinate; None stands for what was not given.

    Raises ModelError with everything that is wrong.
    """
    found: dict[str, str] = {}
    asked = {name: value for name, value in given.items() if value is not None}
    kind: Kind = "angle"
    ends = [name for name in ("start", "end") if name in asked]
    if "drive" in asked:
        try:
            joint, coordinate = resolve(str(asked["drive"]), machine.joints)
            asked["drive"], kind = f"{joint}.{coordinate}", COORDINATE_KINDS[coordinate]
        except UnknownCoordinateError as error:
            found["drive"] = str(error)
    else:
        found |= dict.fromkeys(ends, "belongs to a coordinate that is driven: name it with `drive`")
        asked.setdefault("duration", machine.simulation.duration)
    for name in ends:
        try:
            asked[name] = read_quantity(asked[name], kind, {})
        except ExpressionError as problem:
            found[name] = expression_fault(problem, asked.pop(name)).message()
    if kind == "length" and ends[-1:] != ["end"]:
        found["end"] = f"`{asked['drive']}` is a length: say to which one it is driven"
    faults = [Fault.at(f"kinematics.{name}", message) for name, message in found.items()]
    try:
        settings = settings_of(KinematicsSettings, "kinematics", asked)
    except ModelError as error:
        raise ModelError([*faults, *error.faults]) from None
    refuse(faults)
    return settings
