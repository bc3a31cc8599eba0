"""Couplings in words: a linear equation between joint coordinates, as of gears, belts and racks.

Every coupling holds Σ factor · coordinate at the value that it has as the machine is placed.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, ClassVar, Literal

from nivel.machine.core.checked import Checked, Problem, superfluous
from nivel.machine.core.coefficient import PositiveNumber, Truth
from nivel.machine.core.record import Name
from nivel.machine.given import Field, ManyNames, ManyNumbers, Maybe, TwoNames, TwoNumbers
from nivel.machine.units.quantity import Length, PositiveLength, Scalar
from nivel.machine.uses.coordinate_reference import CoordinateReference, Kind

Terms = tuple[tuple[str, float], ...]
_TWO = Field(description="two joint coordinates, or joints that have only one")


class Gear(Checked):
    """Two wheels that mesh: n₁ angle₁ + n₂ angle₂ is held; of an internal gear n₁ angle₁ - n₂ angle₂."""

    collection: ClassVar[str] = "couplings"

    name: Name
    type: Literal["gear"] = "gear"
    joints: Annotated[TwoNames[CoordinateReference], _TWO]
    teeth: Maybe[TwoNumbers[PositiveNumber]] = Field(default=None, description="numbers of teeth n₁, n₂")
    ratio: Maybe[PositiveNumber] = Field(default=None, description="n₂/n₁, in place of `teeth`")
    internal: Truth = Field(default=False, description="one wheel runs inside the other: both turn the same way")

    @property
    def terms(self) -> Terms:
        """(coordinate as written, factor), … whose sum is held."""
        first, second = self.teeth or (1.0, self.ratio or 1.0)
        return (self.joints[0], first), (self.joints[1], -second if self.internal else second)

    @property
    def kinds(self) -> tuple[Kind | None, ...]:
        """What kind of coordinate each term needs."""
        return "angle", "angle"

    def problems(self) -> Iterator[Problem]:
        if self.teeth is None and self.ratio is None:
            yield Problem((), "`teeth` is missing: a gear needs `teeth: [n1, n2]` or a `ratio` (n2/n1)")
        if self.teeth is not None and self.ratio is not None:
            yield superfluous("ratio", "must not be given with `teeth`, from which it follows")
        for at, count in enumerate(self.teeth or ()):
            if count != round(count):
                yield Problem(
                    ("teeth", at), f"a whole number of teeth was expected, got `{count:g}`; or give a `ratio`"
                )


class Belt(Checked):
    """Two pulleys and a belt that does not slip: r₁ angle₁ - r₂ angle₂ is held; crossed r₁ angle₁ + r₂ angle₂."""

    collection: ClassVar[str] = "couplings"

    name: Name
    type: Literal["belt"] = "belt"
    joints: Annotated[TwoNames[CoordinateReference], _TWO]
    radii: TwoNumbers[PositiveLength] = Field(description="of the pulleys r₁, r₂")
    crossed: Truth = Field(default=False, description="the belt crosses itself: the pulleys turn opposite ways")

    @property
    def terms(self) -> Terms:
        """(coordinate as written, factor), … whose sum is held."""
        first, second = self.radii
        return (self.joints[0], first), (self.joints[1], second if self.crossed else -second)

    @property
    def kinds(self) -> tuple[Kind | None, ...]:
        """What kind of coordinate each term needs."""
        return "angle", "angle"


class Rack(Checked):
    """A pinion and a rack: displacement - r · angle is held."""

    collection: ClassVar[str] = "couplings"

    name: Name
    type: Literal["rack"] = "rack"
    joints: TwoNames[CoordinateReference] = Field(description="the pinion's angle, the rack's way")
    radius: Length = Field(description="of the pinion; negative: the rack moves the other way")

    @property
    def terms(self) -> Terms:
        """(coordinate as written, factor), … whose sum is held."""
        return (self.joints[1], 1.0), (self.joints[0], -self.radius)

    @property
    def kinds(self) -> tuple[Kind | None, ...]:
        """What kind of coordinate each term needs."""
        return "length", "angle"

    def problems(self) -> Iterator[Problem]:
        if self.radius == 0:
            yield Problem(("radius",), "`radius` is zero: such a pinion moves no rack")


class LinearCoupling(Checked):
    """Σ factor · coordinate is held."""

    collection: ClassVar[str] = "couplings"

    name: Name
    type: Literal["linear"] = "linear"
    coordinates: ManyNames[CoordinateReference] = Field(description="two or more different joint coordinates")
    factors: ManyNumbers[Scalar] = Field(description="one for each coordinate [m or rad], none zero")

    @property
    def terms(self) -> Terms:
        """(coordinate as written, factor), … whose sum is held."""
        return tuple(zip(self.coordinates, self.factors, strict=True))

    @property
    def kinds(self) -> tuple[Kind | None, ...]:
        """What kind of coordinate each term needs."""
        return (None,) * len(self.coordinates)

    def problems(self) -> Iterator[Problem]:
        if len(self.coordinates) < 2:
            yield Problem(("coordinates",), f"two or more coordinates were expected, got {len(self.coordinates)}")
        if len(self.factors) != len(self.coordinates):
            counts = f"{len(self.factors)} and {len(self.coordinates)}"
            yield Problem(("factors",), f"a coupling needs as many factors as coordinates; got {counts}")
        for at, factor in enumerate(self.factors):
            if factor == 0:
                yield Problem(("factors", at), "the factor is zero; leave the coordinate out")


Coupling = Annotated[Gear | Belt | Rack | LinearCoupling, Field(discriminator="type")]
