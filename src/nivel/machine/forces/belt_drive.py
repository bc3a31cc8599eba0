"""Elastic belts and chains on two pulleys or sprockets."""

from __future__ import annotations

from collections.abc import Iterator
from math import exp, pi
from typing import Annotated, ClassVar, Literal

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import Damping, NotNegativeForce, NotNegativeLength, PositiveNumber, Truth
from nivel.machine.core.element import OUTPUTS, Acts, ForceElement, Holds, Inequalities
from nivel.machine.given import Field, Maybe, OneNumber, TwoNumbers
from nivel.machine.units.quantity import PositiveLength, Quantity
from nivel.machine.uses.coordinate_reference import CoordinateReference

PositiveStiffness = Annotated[OneNumber, Quantity("stiffness", positive=True)]
PositiveAngle = Annotated[OneNumber, Quantity("angle", positive=True)]


class BeltDrive(ForceElement):
    """Two elastic strands between two pulleys, which never push: a belt that slips (Euler, Eytelwein), a toothed belt, or a chain."""

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "slip_rate", "slip", "first_tension", "second_tension")

    inequalities: ClassVar[Inequalities] = (
        # Euler, Eytelwein: the larger tension is at most exp(μ φ) times the other
        Holds(
            "slip_rate",
            lambda own, of: of["magnitude"],
            lambda own, of: own.rise * (of["first_tension"] + of["second_tension"] - abs(of["magnitude"])) / 2.0,
            lambda own, of: own.rise * (of["first_tension"] + of["second_tension"] - abs(of["magnitude"])) / 2.0,
            lambda own, of: of["slip_rate"],
            applies=lambda own: own.friction is not None,
        ),
        *(
            Acts(
                (f"has a slack {strand} strand", f"has a taut {strand} strand"),
                "slip",
                lambda own, of, way=way: way * of.way(own) - own.slack + own.pretension / own.stiffness,
                lambda own, of, strand=strand: of[f"{strand}_tension"],
                applies=lambda own: own.friction is None,
            )
            for strand, way in (("first", 1.0), ("second", -1.0))
        ),
    )

    type: Literal["belt-drive"] = "belt-drive"
    coordinate: CoordinateReference = Field(description="angle of the first pulley")
    against: CoordinateReference = Field(description="angle of the second one")
    radii: TwoNumbers[PositiveLength] = Field(description="of the pulleys, or of the pitch circles")
    crossed: Truth = Field(default=False, description="the belt crosses itself: the pulleys turn opposite ways")
    stiffness: PositiveStiffness = Field(description="of each strand")
    damping: Damping = Field(default=0.0, description="of each strand")
    pretension: NotNegativeForce = Field(default=0.0, description="of each strand, without torque")
    slack: NotNegativeLength = Field(default=0.0, description="of each strand, as of a chain that sags")
    friction: Maybe[PositiveNumber] = Field(
        default=None, description="coefficient of friction on the pulleys", absent="none: teeth, it does not slip"
    )
    wrap: PositiveAngle = Field(default=pi, description="angle over which it touches the pulley on which it slips")

    @property
    def rise(self) -> float:
        """exp(μ φ) - 1, by which one tension may be more than the other as a share of this."""
        return exp((self.friction or 0.0) * self.wrap) - 1.0

    def problems(self) -> Iterator[Problem]:
        if self.slack and self.pretension:
            yield superfluous("slack", "goes without `pretension`: what sags is not tight")
        if self.friction is not None and not self.pretension:
            yield Problem((), "`pretension` is missing: a belt that is not tight has no friction")
        if self.friction is None and self.wrap != pi:
            yield superfluous("wrap", "belongs to a `friction`, and none is given")
        if self.wrap >= 2.0 * pi:
            yield Problem(
                ("wrap",), f"`wrap` {self.wrap:g} rad is a whole turn or more; in degrees it is `{self.wrap:g} deg`"
            )
