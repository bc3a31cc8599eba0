"""A bushing: an elastic and damped mounting in all six directions."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, ClassVar, Literal

from nivel.machine.beams.six_by_six import Array, Diagonal, Matrix, full_matrix, six_by_six, symmetry_and_sign
from nivel.machine.core.checked import Problem
from nivel.machine.forces.between import Between
from nivel.machine.forces.element import OUTPUTS
from nivel.machine.given import Field

# kinds of the blocks: force by way, force by angle (and torque by way), torque by angle
if TYPE_CHECKING:
    Stiffness = Damping = Diagonal | Matrix
else:
    Stiffness = six_by_six(("stiffness", ("force per angle", "force"), "torsional stiffness"))
    Damping = six_by_six(("damping", ("force per angular velocity", "impulse"), "torsional damping"))


class Bushing(Between):
    """Forces and torques that resist the displacement and the turn of the second marker in the axes of the first."""

    outputs: ClassVar[tuple[str, ...]] = (
        *OUTPUTS,
        *(f"force_{axis}" for axis in "xyz"),
        *(f"torque_{axis}" for axis in "xyz"),
    )

    turns: ClassVar[bool] = True

    type: Literal["bushing"] = "bushing"
    stiffness: Stiffness = Field(
        description="three in N/m, three in N*m/rad, along and about x, y, z of the first marker; or 6×6"
    )
    damping: Damping = Field(default=(0.0,) * 6, description="three in N*s/m, three in N*m*s/rad; or 6×6")

    @property
    def stiffness_matrix(self) -> Array:
        """(6, 6) [N/m, N/rad; N, N m/rad], axes of the first marker."""
        return full_matrix(self.stiffness)

    @property
    def damping_matrix(self) -> Array:
        """(6, 6) [N s/m, N s/rad; N s, N m s/rad], axes of the first marker."""
        return full_matrix(self.damping)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        for name, matrix, what in (
            ("stiffness", self.stiffness_matrix, "stores"),
            ("damping", self.damping_matrix, "loses"),
        ):
            for message in symmetry_and_sign(name, matrix, what):
                yield Problem((name,), message)
