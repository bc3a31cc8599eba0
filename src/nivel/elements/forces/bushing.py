"""Bushings: linear elastic connections of two markers in all six directions.

The deflection x = (A_iᵀ d, ψ) has the displacement of the second point and the rotation vector ψ of the second frame, both in the axes of
the first. The force is -(∂x/∂·)ᵀ (K x + D ẋ) with the exact derivative, so the elastic part has the potential ½ xᵀ K x at rotations of
any size below a whole turn.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, ClassVar, Literal

import numpy as np

from nivel.elements.facts import Output, add_outputs, of_force
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element, several
from nivel.kernels.algebra.relative_rotation import rotation_vector, tangent_product
from nivel.kernels.algebra.spatial import cross, dot
from nivel.kernels.algebra.vectors import minus, opposite, plus, seen, turned
from nivel.kernels.forces.wrench import add_marker_force, add_torque
from nivel.kernels.record.record import NONE, record_at
from nivel.machine.core.element import Between
from nivel.machine.core.record import Problem
from nivel.machine.given import Field
from nivel.machine.units.six_by_six import Array, Diagonal, Matrix, full_matrix, six_by_six, symmetry_and_sign

if TYPE_CHECKING:
    from nivel.system.builder import SystemBuilder

    Stiffness = Damping = Diagonal | Matrix
else:
    # kinds of the blocks: force by way, force by angle (and torque by way), torque by angle
    Stiffness = six_by_six(("stiffness", ("force per angle", "force"), "torsional stiffness"))
    Damping = six_by_six(("damping", ("force per angular velocity", "impulse"), "torsional damping"))


class Bushing(Between):
    """Forces and torques that resist the displacement and the turn of the second marker in the axes of the first."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force(),
        *(Output(f"force_{axis}", "N", f"force on the second body along {axis} of the first marker") for axis in "xyz"),
        *(
            Output(f"torque_{axis}", "N m", f"torque on the second body about {axis} of the first marker")
            for axis in "xyz"
        ),
    )
    turns: ClassVar[bool] = True

    type: Literal["bushing"] = "bushing"
    stiffness: Stiffness = Field("three in N/m, three in N*m/rad, along and about x, y, z of the first marker; or 6×6")
    damping: Damping = Field("three in N*s/m, three in N*m*s/rad; or 6×6", default=(0.0,) * 6)

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


class BushingRow(Row):
    """A bushing, or a spring between segments of a beam, which has no OUTPUT (NONE): matrices row by row, and work."""

    output: int
    first: int
    second: int
    stiffness: Sequence[float] = several(36)
    damping: Sequence[float] = several(36)
    x: Sequence[float] = several(6, default=(0.0,) * 6)
    rate: Sequence[float] = several(6, default=(0.0,) * 6)
    effort: Sequence[float] = several(6, default=(0.0,) * 6)


@element
def apply(machine, index, n, t):
    """Force and torque of a bushing on both bodies."""
    record = record_at(machine)
    bodies, markers, control, value = record.bodies, record.markers, record.control, record.outputs.value
    i, j, out = index[BushingRow.FIRST], index[BushingRow.SECOND], index[BushingRow.OUTPUT]
    x, rate = n[BushingRow.X : BushingRow.RATE], n[BushingRow.RATE : BushingRow.EFFORT]
    effort, A = n[BushingRow.EFFORT : BushingRow.EFFORT + 6], markers.A[i]
    first, second = markers.body[i], markers.body[j]
    d, w = minus(markers.r[j], markers.r[i]), bodies.omega[first]
    # ḋ seen from the first marker: ṙ_j - ṙ_i - ω_i × d
    e = minus(minus(markers.rdot[j], markers.rdot[i]), cross(w, d))
    x[0], x[1], x[2] = seen(A, d)
    rate[0], rate[1], rate[2] = seen(A, e)
    effort[0], effort[1], effort[2] = seen(A, minus(bodies.omega[second], w))
    rotation_vector(A, markers.A[j], x[3:6])
    tangent_product(x[3:6], effort[0:3], False, rate[3:6])
    stored, loss = 0.0, 0.0
    for a in range(6):
        elastic, damping = 0.0, 0.0
        for b in range(6):
            elastic += n[BushingRow.STIFFNESS + 6 * a + b] * x[b]
            damping += n[BushingRow.DAMPING + 6 * a + b] * rate[b]
        stored += 0.5 * elastic * x[a]
        loss += damping * rate[a]
        effort[a] = -elastic - damping
    control.stored[0] += stored
    control.power[1] += loss
    # the rotation vector's rates are no longer needed: their place takes the torque
    tangent_product(x[3:6], effort[3:6], True, rate[0:3])
    force, torque = turned(A, effort), turned(A, rate)
    power = add_marker_force(bodies, markers, j, force) + add_torque(bodies, second, torque)
    # the first body gets the counter-force at its own marker, and the moment of the offset d
    power += add_marker_force(bodies, markers, i, opposite(force))
    power += add_torque(bodies, first, opposite(plus(torque, cross(d, force))))
    if out != NONE:
        for a in range(3):
            value[out + 2 + a], value[out + 5 + a] = effort[a], rate[a]
        value[out], value[out + 1] = np.sqrt(dot(force, force)), power


def add_bushing(builder: SystemBuilder, force: Bushing) -> None:
    """An elastic connection in six directions."""
    first, second = builder.ends(force.ends)
    stiffness, damping = force.stiffness_matrix.ravel().tolist(), force.damping_matrix.ravel().tolist()
    output = add_outputs(builder, force)
    builder.add(apply, BushingRow(output=output, first=first, second=second, stiffness=stiffness, damping=damping))


KINDS = (Kind(Bushing, add_bushing, (apply,)),)
