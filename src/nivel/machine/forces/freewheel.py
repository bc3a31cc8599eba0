"""A freewheel: a clutch that lets its coordinate run ahead, and never lets it fall behind."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from nivel.machine.core.checked import Problem, superfluous
from nivel.machine.core.coefficient import CoordinateDamping, PositiveCoordinateStiffness, PositiveEffort
from nivel.machine.core.element import OUTPUTS, Acts, Holds, Inequalities
from nivel.machine.forces.drive_line import DriveLine
from nivel.machine.given import Field, Maybe
from nivel.machine.uses.coordinate_reference import CoordinateReference


class Freewheel(DriveLine):
    """The coordinate may run faster than ratio · against, not slower: then it is taken along, rigidly or by a spring."""

    outputs: ClassVar[tuple[str, ...]] = (*OUTPUTS, "slip", "run")  # run: with a stiffness
    stiff: ClassVar[bool] = False

    inequalities: ClassVar[Inequalities] = (
        Holds(
            "slip",
            lambda own, of: of["magnitude"],
            lambda own, of: of.all(own.capacity),
            lambda own, of: of.all(own.capacity),
            lambda own, of: of["slip"],
            one_way=True,
            applies=lambda own: own.is_rigid,
        ),
        Acts(
            ("runs ahead", "takes along"),
            "run",
            lambda own, of: of["run"] - of.difference(own),
            lambda own, of: of["magnitude"],
            applies=lambda own: not own.is_rigid,
        ),
    )

    type: Literal["freewheel"] = "freewheel"
    against: Maybe[CoordinateReference] = Field(  # type: ignore[assignment]
        default=None,
        description="coordinate that takes the first one along; without it: a backstop, it never goes backwards",
    )
    capacity: Maybe[PositiveEffort] = Field(default=None, description="effort beyond which it slips", absent="none")
    stiffness: Maybe[PositiveCoordinateStiffness] = Field(
        default=None, description="of what takes the coordinate along", absent="rigid"
    )
    damping: CoordinateDamping = Field(default=0.0, description="beside the stiffness")

    @property
    def is_rigid(self) -> bool:
        """Whether what it takes along is held without any spring."""
        return self.stiffness is None

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        if self.damping and self.stiffness is None:
            yield superfluous("damping", "belongs to a `stiffness`, and none is given")
