"""Solids as a model file says them: parts that are added and cut, or a STEP file."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from nivel.machine.core.checked import Checked, Problem
from nivel.machine.core.coefficient import Truth
from nivel.machine.core.record import FileName, Name
from nivel.machine.given import Field
from nivel.machine.units.quantity import Position, PositiveLength


class _PartRecord(Checked):
    cut: Truth = Field(default=False, description="taken away from the parts before it instead of added")


class BoxPart(_PartRecord):
    """A block between two opposite corners."""

    type: Literal["box"] = "box"
    from_: Position = Field(key="from")
    to: Position

    def problems(self) -> Iterator[Problem]:
        if any(a == b for a, b in zip(self.from_, self.to, strict=True)):
            yield Problem(("to",), "the block has no thickness: `from` and `to` differ along all three axes")


class _RoundPart(_PartRecord):
    from_: Position = Field(key="from")
    to: Position
    radius: PositiveLength

    def problems(self) -> Iterator[Problem]:
        if self.from_ == self.to:
            yield Problem(("to",), "`from` and `to` are the same point")


class CylinderPart(_RoundPart):
    """A round bar between two points of its axis."""

    type: Literal["cylinder"] = "cylinder"


class ConePart(_RoundPart):
    """A round bar that tapers from `radius` to `end_radius`."""

    type: Literal["cone"] = "cone"
    end_radius: PositiveLength

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.radius == self.end_radius:
            yield Problem(("end_radius",), "equal radii make a `cylinder`")


class SpherePart(_PartRecord):
    """A ball."""

    type: Literal["sphere"] = "sphere"
    centre: Position
    radius: PositiveLength


Part = Annotated[BoxPart | CylinderPart | ConePart | SpherePart, Field(discriminator="type")]


class Solid(Checked):
    """A solid of one material, meshed with tetrahedra of ten nodes."""

    parts: tuple[Part, ...] = ()
    file: FileName | None = Field(default=None, description="a STEP file")
    material: Name
    element_size: PositiveLength
    tagged = {"parts": 2}  # noqa: RUF012

    def problems(self) -> Iterator[Problem]:
        if (self.file is None) == (not self.parts):
            yield Problem((), "either `parts` or a `file` was expected")
        if self.parts and self.parts[0].cut:
            yield Problem(("parts", 0, "cut"), "the first part has nothing to be cut from")
