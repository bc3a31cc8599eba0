"""First-order states and outputs of elements as facts: all that the rest of nivel knows of a pressure, a bristle or a controller's memory,
and what can be read of an element, with its units and meaning.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

from nivel.kernels.bodies.coordinate import LAST_ANGLE
from nivel.known import ForceElement, SystemBuilder
from nivel.lazy import Struct


class StateFact(Struct):
    """One first-order state x of an element.

    name : signal where it has a dot. variable : of the result, default `state.NAME`; units, long_name : of that, SI. start : at t = 0.
    scale : what errors of x are measured by, at least; the largest |x| of the run counts where it is larger and x is `relative`. sampled :
    x has no rate, it changes at given times or events only. integral : nothing depends on x, so that no step and no iteration waits for
    it; on what its rate depends need not be said. follows : x is what a motion has stretched, so that at rest it is what the way to there
    makes of it.
    """

    name: str
    units: str
    long_name: str
    start: float
    scale: float
    sampled: bool = False
    variable: str = ""
    relative: bool = True
    integral: bool = False
    follows: bool = False

    @property
    def result(self) -> str:
        """Name of the result variable."""
        return self.variable or f"state.{self.name}"


class Coupled(NamedTuple):
    """What one element acts on or depends on: bodies, the ground included, and numbers of states."""

    bodies: frozenset[int]
    states: frozenset[int] = frozenset()


class Output(str):
    """Name of an output. units : where a length or a force is meant, and after `|` where an angle or a torque is."""

    units: tuple[str, str]
    meaning: str

    def __new__(cls, name: str, units: str, meaning: str = "") -> Output:
        made = super().__new__(cls, name)
        linear, _, angular = units.partition("|")
        made.units, made.meaning = (linear, angular or linear), meaning or name
        return made


POWER = Output("power", "W", "power into the machine")


def of_effort(meaning: str) -> tuple[Output, Output]:
    """What all forces begin with that act on a coordinate: a torque on an angle, a force on a length."""
    return Output("magnitude", "N|N m", meaning), POWER


def of_force(meaning: str = "magnitude", units: str = "N") -> tuple[Output, Output]:
    """What all other forces begin with."""
    return Output("magnitude", units, meaning), POWER


def of_value(name: str, meaning: str = "") -> tuple[Output, Output]:
    """A coordinate and its rate."""
    return Output(name, "m|rad", meaning), Output("rate", "m/s|rad/s", f"rate of the {meaning or name}")


def is_angle(builder: SystemBuilder, coordinate: int) -> bool:
    """Whether a coordinate is an angle [rad] and not a length [m]."""
    return builder.coordinates.what[coordinate][0] <= LAST_ANGLE


def add_outputs(builder: SystemBuilder, force: ForceElement, angle: bool = False, without: Collection[str] = ()) -> int:
    """Index of the first output of a force. angle : it acts on an angle. without : outputs that this one does not have."""
    outputs = [each for each in force.outputs if isinstance(each, Output) and each not in without]
    return builder.outputs.add(
        *((f"force.{force.name}.{each}", each.units[angle], f"{each.meaning} of {force.name}") for each in outputs)
    )
