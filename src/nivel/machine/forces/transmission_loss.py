"""Losses of a transmission: the effort that a gear, a belt, a rack or a screw takes away by friction, by its efficiencies."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import Share
from nivel.machine.core.element import OUTPUTS, ForceElement, Holds, Inequalities
from nivel.machine.core.record import Name
from nivel.machine.given import Field, Maybe, OneNumber
from nivel.machine.units.quantity import Quantity
from nivel.machine.uses.coordinate_reference import CoordinateReference

Efficiency = Annotated[OneNumber, Quantity("number")]


class TransmissionLoss(ForceElement):
    """Dry friction at the coordinate that drives a coupling or a screw joint, loaded by the effort that it gives to the rest of it."""

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "transmitted")
    stiff: ClassVar[bool] = False

    inequalities: ClassVar[Inequalities] = (
        Holds(
            "coordinate",
            lambda own, of: of["magnitude"],
            lambda own, of: max(own.shares) * abs(of["transmitted"]),
            lambda own, of: min(own.shares) * abs(of["transmitted"]),
            lambda own, of: of.rate(own.coordinate),
        ),
    )

    type: Literal["transmission-loss"] = "transmission-loss"
    coupling: Name = Field(description="coupling, or joint of type screw")
    coordinate: CoordinateReference = Field(description="that drives, one of the coupling's or the joint's")
    efficiency: Share = Field(description="power out by power in, where the coordinate drives")
    backward_efficiency: Maybe[Efficiency] = Field(
        default=None,
        description="the same where the coordinate is driven; zero or less: self-locking",
        absent="2 - 1/efficiency",
    )

    @property
    def shares(self) -> tuple[float, float]:
        """Effort that is lost by the effort that is transmitted, where the coordinate drives and where it is driven."""
        forward = 1.0 / self.efficiency - 1.0
        return forward, forward if self.backward_efficiency is None else 1.0 - self.backward_efficiency

    def problems(self) -> Iterator[Problem]:
        if self.backward_efficiency is not None and self.backward_efficiency > 1.0:
            yield Problem(
                ("backward_efficiency",), f"a number of 1 or less was expected, got {self.backward_efficiency:g}"
            )
