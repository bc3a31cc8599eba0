"""Settings of the analyses beside the run: linearisation, inverse dynamics, kinematics and statics."""

from collections.abc import Iterator, Mapping
from os import PathLike
from typing import Annotated, Any, Final

from pydantic import BeforeValidator

from nivel.errors import Fault, gathered, refuse
from nivel.machine.core.record import Checked, Problem, Record
from nivel.machine.given import Field, Given, Maybe, OneNumber
from nivel.machine.machine_record import MachineRecord
from nivel.machine.settings.run import SHORTEST, SimulationSettings
from nivel.machine.settings.values import (
    FEWEST_POSITIONS,
    POSITIONS,
    Between,
    Modes,
    Names,
    OfStatics,
    Positions,
    Time,
    Way,
    settings_of,
)
from nivel.machine.units.quantity import Duration, expression_fault, fault, read_quantity, shown
from nivel.machine.units.tree import ExpressionError
from nivel.machine.uses.coordinate_reference import COORDINATE_KINDS, Kind, UnknownCoordinateError, resolve

START, EQUILIBRIUM, ROTATION = "start", "equilibrium", "rotation"
AT: Final = {START: "its start", EQUILIBRIUM: "its equilibrium at t = 0", ROTATION: "its steady rotation"}


def _state(value: Any) -> str | float:
    """A word, or a time [s]."""
    if isinstance(value, str) and value.strip() in AT:
        return value.strip()
    try:
        time = read_quantity(value, "time", {})
    except ExpressionError as problem:
        said = expression_fault(problem, value).message()
        raise fault(f"`start`, `equilibrium`, `rotation` or a time was expected: {said}") from None
    if time < 0.0:
        raise fault(f"a time of zero or more was expected, got {shown(value)}")
    return time


class LineariseSettings(Record):
    """Settings of a linear model."""

    about: Annotated[float | str, BeforeValidator(_state)] = Field(
        "state to linearise about: start, equilibrium, rotation (steady, strained by it), or a time up to which the machine is "
        "simulated, e.g. '2 s'",
        default=START,
        option="--about STATE",
        absent="the start of the machine",
    )
    inputs: Names | None = Field(
        "inputs, e.g. hinge.angle", default=None, absent="motors, drivers, commands of circuits"
    )
    outputs: Names | None = Field("outputs", default=None, absent="sensors, or joint coordinates and pressures")
    coordinates: OfStatics = Field("coordinates of the equations", default="auto", absent="those of the machine")
    verify: bool = Field(
        "vibrations with other elements of beams, to estimate their error", default=True, option="--no-verify"
    )

    @property
    def time(self) -> float:
        """Of the run before [s]; 0 without one."""
        return self.about if isinstance(self.about, float) else 0.0

    @property
    def words(self) -> str:
        """The state in words."""
        return AT.get(str(self.about), f"t = {self.time:.6g} s of its run")

    def as_dict(self) -> dict[str, object]:
        """For the `settings` of results."""
        about = "time" if isinstance(self.about, float) else self.about
        return {"analysis": "linearise", **self.model_dump(), "about": about, "time": self.time}


class InverseSettings(Checked):
    """Settings of inverse dynamics. Of more actuators than needed the least Σ (weight · effort)² is taken within the limits."""

    actuators: Names | None = Field(
        "joint coordinates, or motors, which then do not act themselves",
        default=None,
        absent="the motors, or the coordinates that the drivers prescribe",
    )
    motion: Any = Field(
        "result of a run or of kinematics",
        default=None,
        option="--motion RESULT.nc",
        absent="the motion that the drivers prescribe",
    )
    trajectory: str | PathLike[str] | None = Field(
        "table of joint coordinates over time, in place of a motion", default=None, option="--trajectory FILE.csv"
    )
    limits: Mapping[str, Any] = Field(
        "greatest effort of an actuator", default={}, option="--limit NAME=VALUE", absent="those of the motors"
    )
    weights: Mapping[str, Any] = Field(
        "weight of an effort, if there are more actuators than needed",
        default={},
        option="--weight NAME=NUMBER",
        absent="one over the limit, or 1",
    )
    hold: Names = Field("drivers that keep what they prescribe", default=(), option="--hold DRIVERS")
    positions: Maybe[Positions] = Field(
        "number of positions of the drivers' motion or of a trajectory", default=None, absent=FEWEST_POSITIONS
    )

    def problems(self) -> Iterator[Problem]:
        """Two motions."""
        if self.motion is not None and self.trajectory is not None:
            yield Problem(("trajectory",), "stands in place of `motion`; give one of them")


class KinematicsSettings(Record):
    """Settings of kinematics."""

    drive: str = Field(
        "joint coordinate that is driven at constant speed, e.g. hinge.angle", default="", option="--drive COORDINATE"
    )
    start: Maybe[Way] = Field(
        "first value of this coordinate, e.g. '10 deg'",
        default=None,
        option="--from VALUE",
        absent="its value in the assembled machine",
    )
    end: Maybe[Way] = Field("last value of this coordinate", default=None, option="--to VALUE", absent="one turn more")
    duration: Duration = Field("duration of the motion", default=1.0, absent="that of the machine, 1 s with --drive")
    positions: Maybe[Positions] = Field(
        "number of positions, both ends included", default=None, absent=FEWEST_POSITIONS
    )
    coordinates: OfStatics = Field("coordinates of the equations", default="auto")

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
    with gathered(faults):
        settings = settings_of(KinematicsSettings, "kinematics", asked)
    refuse(faults)
    return settings


MOST_STEPS = 1_000_000
STEPS = 20


class StaticsSettings(Checked):
    """Settings of statics. Duration 0: the equilibrium at t = 0 alone."""

    duration: Time = Field(
        "last time of the loads and drivers; 0: only t = 0", default=1.0, absent="that of the machine"
    )
    step: Maybe[Duration] = Field("time between two states", default=None, absent="a twentieth of the duration")
    arc_length: bool = Field("path of equilibria through limit points, where time turns back", default=False)
    tolerance: Annotated[OneNumber, Between("1e-14", "1e-2")] = Field(
        "largest last correction of Newton's method, in lengths of the machine and in radians", default=1e-10
    )
    most_iterations: Annotated[Given[int, int, int | str], Between("2", "1000")] = Field(
        "limit of Newton iterations for a state", default=25
    )
    line_search: bool = Field("shortening of Newton steps that come no nearer", default=True, option="--no-line-search")
    modes: Modes = Field("number of natural frequencies and modes about every state", default=0)
    buckling: Modes = Field("number of linearised buckling loads, from the first and the last state", default=0)
    coordinates: OfStatics = Field("coordinates of the equations", default="auto", absent="those of the machine")
    verify: bool = Field(
        "states with other elements of beams, to estimate their error", default=True, option="--no-verify"
    )

    @property
    def interval(self) -> float:
        """Time between states [s]."""
        return self.step or self.duration / STEPS or 1.0

    def as_dict(self) -> dict[str, object]:
        """For the result's `settings`."""
        return {"analysis": "statics", **self.model_dump(), "step": self.interval}

    def problems(self) -> Iterator[Problem]:
        """Steps that do not go with the duration, and what needs loads that grow."""
        duration, step = self.duration, self.interval
        if 0.0 < duration < SHORTEST:
            message = f"{duration:g} s is shorter than {SHORTEST:g} s; use 0 for the equilibrium at t = 0 alone"
            yield Problem(("duration",), message)
        if duration and step > duration:
            yield Problem(("step",), f"{step:g} s is longer than the duration of {duration:g} s")
        if duration / step > MOST_STEPS:
            message = f"{step:g} s makes more than {MOST_STEPS} steps in {duration:g} s; use a larger one"
            yield Problem(("step",), message)
        for name in ("buckling", "arc_length"):
            if getattr(self, name) and not duration:
                yield Problem((name,), "needs loads that grow with time: a duration above zero")


SETTINGS: Final[dict[str, type[Record]]] = {
    "run": SimulationSettings,
    "statics": StaticsSettings,
    "kinematics": KinematicsSettings,
    "linearise": LineariseSettings,
    "inverse": InverseSettings,
}
