"""A node without mass where springs meet: it is where their energy V(p) = Σ ½ k_i (|p - r_i| - f_i)² is least, next to where it was.

With e = p - r_i, l = |e|, u = e/l and the tension T = k (l - f): ∂V/∂p = Σ T u = 0, H = Σ k u uᵀ + (T/l) (1 - u uᵀ). Newton's method on
values, with H shifted where it is not positive definite or a step does not lower V (Levenberg 1944), then one step with slopes. The forces
on the ends are those of the node held: its own motion adds nothing to them, as V is stationary.
"""

from collections.abc import Iterator, Sequence
from typing import Annotated, ClassVar, Final, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.facts import Output, add_outputs, of_force
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element, several
from nivel.kernels.algebra.analytic import real
from nivel.kernels.forces.wrench import add_marker_force
from nivel.kernels.record.record import record_at
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import NotNegativeLength, Truth
from nivel.machine.core.element import BetweenMany
from nivel.machine.core.record import Problem
from nivel.machine.given import Field, ManyNumbers, OneNumber
from nivel.machine.units.quantity import Position, Quantity, listed
from nivel.native.function import leaf, stage

MOST_SPRINGS: Final = 8
PositiveStiffness = Annotated[OneNumber, Quantity("stiffness", positive=True)]


class SpringNode(BetweenMany):
    """Springs from points of bodies to one node without mass, which is where they balance."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force("tension of the first spring"),
        *(Output(axis, "m", f"global {axis} of the node") for axis in "xyz"),
        *(Output(f"tension_{k + 1}", "N", f"tension of spring {k + 1}") for k in range(MOST_SPRINGS)),
    )

    where = "the springs are held"

    type: Literal["spring-node"] = "spring-node"
    node: Position = Field("where about it is at the start: global; it is found from there")
    stiffness: Annotated[ManyNumbers[PositiveStiffness], BeforeValidator(listed)] = Field("of each spring")
    free_length: Annotated[ManyNumbers[NotNegativeLength], BeforeValidator(listed)] = Field(
        "of each spring, at which it has no force"
    )
    only_pulls: Truth = Field("the springs never push, as ropes", default=False)

    def problems(self) -> Iterator[Problem]:
        count = len(self.stiffness)
        if not 3 <= count <= MOST_SPRINGS:
            yield Problem(
                ("stiffness",),
                f"3 to {MOST_SPRINGS} springs that meet were expected, got {count}; two are a `spring-series`",
            )
        if len(self.free_length) != count:
            yield Problem(
                ("free_length",), f"one length for each of the {count} springs is needed, got {len(self.free_length)}"
            )
        yield from super().problems()
        if self.markers is None and (self.bodies is None or self.points is None):
            return
        name = "points" if self.markers is None else "markers"
        held = len(getattr(self, name))
        if self.markers is None and len(self.bodies or ()) != held:
            message = f"one body for each point is needed; there are {len(self.bodies or ())} bodies, {held} points"
            yield Problem(("bodies",), message)
        if held != count:
            yield Problem((name,), f"one of the {name} for each of the {count} springs is needed, got {held}")
        elif self.points is not None and self.markers is None:
            for k, point in enumerate(self.points):
                if point == self.node:
                    yield Problem(
                        ("points", k), "this point is where the node is; the spring between them has no direction"
                    )


STIFFNESS, FREE = range(2)  # of each spring
SPRING = 2
STEPS = 200
# shares of the size and of the stiffness: a step that is round-off, a pivot that is none, the first shift
SETTLED, NO_PIVOT, SHIFT = 1e-14, 1e-12, 1e-3


class NodeRow(Row):
    """COUNT springs, with the marker, STIFFNESS and FREE length of each. PLACE : of the node at the start. SIZE : a length of the springs.
    STIFF : sum of the stiffnesses."""

    output: int
    count: int
    first: Sequence[int] = several()
    only_pulls: float
    place: Sequence[float] = several(3)
    size: float
    stiff: float
    springs: Sequence[float] = several()


@stage
def energy_at(machine, k, x, y, z):
    """V, its gradient and H (xx, xy, xz, yy, yz, zz) with the node of element k at this place, as numbers."""
    record = record_at(machine)
    index, numbers, markers = record.elements.columns[k], record.elements.number[k], record.markers
    V, gx, gy, gz, xx, xy, xz, yy, yz, zz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(np.int64(index[NodeRow.COUNT])):
        r, at = markers.r[index[NodeRow.FIRST + i]], NodeRow.SPRINGS + SPRING * i
        stiffness, free = real(numbers[at + STIFFNESS]), real(numbers[at + FREE])
        ex, ey, ez = x - real(r[0]), y - real(r[1]), z - real(r[2])
        length = np.sqrt(ex * ex + ey * ey + ez * ez)
        if length == 0.0 or (real(numbers[NodeRow.ONLY_PULLS]) > 0.0 and length < free):
            continue
        T = stiffness * (length - free)
        ux, uy, uz, across = ex / length, ey / length, ez / length, T / length
        along = stiffness - across
        V += 0.5 * T * (length - free)
        gx, gy, gz = gx + T * ux, gy + T * uy, gz + T * uz
        xx, yy, zz = xx + along * ux * ux + across, yy + along * uy * uy + across, zz + along * uz * uz + across
        xy, xz, yz = xy + along * ux * uy, xz + along * ux * uz, yz + along * uy * uz
    return V, gx, gy, gz, xx, xy, xz, yy, yz, zz


@leaf
def step_to_balance(H, shift, floor, gx, gy, gz):
    """-(H + shift)⁻¹ g by L D Lᵀ; whether all pivots are above the floor."""
    a, d, f = H[0] + shift, H[3] + shift, H[5] + shift
    if not a > floor:
        return False, gx, gy, gz
    l1, l2 = H[1] / a, H[2] / a
    d, e = d - l1 * H[1], H[4] - l1 * H[2]
    if not d > floor:
        return False, gx, gy, gz
    l3 = e / d
    f = f - l2 * H[2] - l3 * e
    if not f > floor:
        return False, gx, gy, gz
    y = gy - l1 * gx
    z = (gz - l2 * gx - l3 * y) / f
    y = y / d - l3 * z
    x = gx / a - l1 * y - l2 * z
    return True, -x, -y, -z


@leaf
def step_from_saddle(H, floor, gx, gy, gz):
    """-H⁻¹ g by cofactors, where H is not positive definite; whether no direction is without stiffness."""
    a, b, c, d, e, f = H
    xx, xy, xz, yy, yz, zz = d * f - e * e, c * e - b * f, b * e - c * d, a * f - c * c, b * c - a * e, a * d - b * b
    whole = a * xx + b * xy + c * xz
    if not abs(whole) > floor * max(abs(xx), abs(yy), abs(zz)):
        return False, gx, gy, gz
    x = (xx * gx + xy * gy + xz * gz) / whole
    y = (xy * gx + yy * gy + yz * gz) / whole
    z = (xz * gx + yz * gy + zz * gz) / whole
    return True, -x, -y, -z


@stage
def balance(machine, k):
    """Where the springs of element k balance, from where they last did: (x, y, z) as numbers."""
    record = record_at(machine)
    numbers, memory = record.elements.number[k], record.elements.memory[k]
    x, y = real(numbers[NodeRow.PLACE]) + memory[0], real(numbers[NodeRow.PLACE + 1]) + memory[1]
    z = real(numbers[NodeRow.PLACE + 2]) + memory[2]
    stiff, size = real(numbers[NodeRow.STIFF]), real(numbers[NodeRow.SIZE])
    V, gx, gy, gz, xx, xy, xz, yy, yz, zz = energy_at(machine, k, x, y, z)
    shift = 0.0
    for _ in range(STEPS):
        found, dx, dy, dz = step_to_balance((xx, xy, xz, yy, yz, zz), shift, NO_PIVOT * stiff, gx, gy, gz)
        if found:
            W, hx, hy, hz, xx2, xy2, xz2, yy2, yz2, zz2 = energy_at(machine, k, x + dx, y + dy, z + dz)
            way = dx * dx + dy * dy + dz * dz
            # of two energies that differ by round-off alone the smaller gradient tells
            lower = W < V - 1e-12 * V or hx * hx + hy * hy + hz * hz <= gx * gx + gy * gy + gz * gz
            if lower and W <= V + 1e-12 * V:
                x, y, z = x + dx, y + dy, z + dz
                V, gx, gy, gz, xx, xy, xz, yy, yz, zz = W, hx, hy, hz, xx2, xy2, xz2, yy2, yz2, zz2
                shift = 0.25 * shift if shift > NO_PIVOT * stiff else 0.0
                if way <= SETTLED * SETTLED * size * size:
                    break
                continue
            if way <= SETTLED * SETTLED * size * size:
                break
        shift = max(4.0 * shift, SHIFT * stiff)
    return x, y, z


@stage
def refined(machine, k, x, y, z):
    """The same place with its slopes: one step of Newton's method with the gradient as it depends on the ends."""
    record = record_at(machine)
    index, numbers, markers = record.elements.columns[k], record.elements.number[k], record.markers
    _, _, _, _, xx, xy, xz, yy, yz, zz = energy_at(machine, k, x, y, z)
    zero = 0.0 * markers.r[index[NodeRow.FIRST], 0]
    gx, gy, gz = zero, zero, zero
    for i in range(np.int64(index[NodeRow.COUNT])):
        T, ux, uy, uz = pull(markers.r[index[NodeRow.FIRST + i]], numbers, i, x, y, z)
        gx, gy, gz = gx + T * ux, gy + T * uy, gz + T * uz
    stiff = real(numbers[NodeRow.STIFF])
    found, dx, dy, dz = step_to_balance((xx, xy, xz, yy, yz, zz), 0.0, NO_PIVOT * stiff, gx, gy, gz)
    if not found:
        # symmetry holds it where its springs push, as in a plane
        found, dx, dy, dz = step_from_saddle((xx, xy, xz, yy, yz, zz), NO_PIVOT * stiff, gx, gy, gz)
    if not found:
        # a direction without stiffness: the node stays in it
        found, dx, dy, dz = step_to_balance((xx, xy, xz, yy, yz, zz), SHIFT * stiff, 0.0, gx, gy, gz)
    if not found:
        return x + 0.0 * gx, y + 0.0 * gy, z + 0.0 * gz
    return x + dx, y + dy, z + dz


@leaf
def pull(r, numbers, i, x, y, z):
    """Tension of spring i from the point r to the node, and its direction; no tension where both are one."""
    at = NodeRow.SPRINGS + SPRING * i
    ex, ey, ez = x - r[0], y - r[1], z - r[2]
    square = ex * ex + ey * ey + ez * ez
    if real(square) == 0.0:
        return 0.0 * square, 0.0 * square, 0.0 * square, 0.0 * square
    length = np.sqrt(square)
    T = numbers[at + STIFFNESS] * (length - numbers[at + FREE])
    if real(numbers[NodeRow.ONLY_PULLS]) > 0.0 and real(T) < 0.0:
        T = 0.0 * T
    return T, ex / length, ey / length, ez / length


@element
def meet(machine, k, index, n, t):
    """Place of the node, and the tensions of its springs on the bodies."""
    record = record_at(machine)
    markers, control, out = record.markers, record.control, record.outputs.value
    first, proposal = index[NodeRow.OUTPUT], record.elements.proposal[k]
    x0, y0, z0 = balance(machine, k)
    x, y, z = refined(machine, k, x0, y0, z0)
    power = 0.0 * x
    for i in range(np.int64(index[NodeRow.COUNT])):
        m = index[NodeRow.FIRST + i]
        T, ux, uy, uz = pull(markers.r[m], n, i, x, y, z)
        power += add_marker_force(record.bodies, markers, m, (T * ux, T * uy, T * uz))
        control.stored[0] += 0.5 * T * T / n[NodeRow.SPRINGS + SPRING * i + STIFFNESS]
        out[first + 5 + i] = T
    out[first], out[first + 1] = out[first + 5], power
    out[first + 2], out[first + 3], out[first + 4] = x, y, z
    for i in range(3):
        proposal[i] = out[first + 2 + i] - n[NodeRow.PLACE + i]


def add_spring_node(builder: SystemBuilder, force: SpringNode) -> None:
    """Springs from markers to a node that is kept from state to state."""
    markers = [builder.end(end) for end in force.ends]
    first = add_outputs(builder, force, without=SpringNode.outputs[-MOST_SPRINGS:][len(markers) :])
    springs = np.column_stack([force.stiffness, force.free_length])
    row = NodeRow(
        output=first,
        count=len(markers),
        first=markers,
        only_pulls=float(force.only_pulls),
        place=force.node,
        size=max(*force.free_length, 1e-6),
        stiff=float(np.sum(force.stiffness)),
        springs=springs.ravel().tolist(),
    )
    builder.add(meet, row, memory=3)


KINDS = (Kind(SpringNode, add_spring_node, (meet,)),)
