"""Elastic parts of drive lines between two joint coordinates: shafts with play; belts, chains and springs of freewheels.

A belt has two strands that never push, and a slip between given ends. With the way e of one rim against the other, the slip x and
z = e - x, y = k z + d ż, the strands pull with T₁ = max(0, T₀ + y) while they are taut, T₀ + k z > 0, and T₂ = max(0, T₀ - y) while
T₀ - k z > 0; the effort T₁ - T₂ is left. z and y/k stay between LOW and HIGH: at an end the belt slips. x is that of the last accepted
state, and z what is left of e - x between the ends (the return mapping of plasticity: exact where e turns back at no time within a step;
where steps are chosen one ends there). Of Euler and Eytelwein, T₁ = m T₂ with m = exp(μ φ), the end is k z = T₀ (m - 1)/(m + 1).
"""

import math
from collections.abc import Iterator
from math import exp, pi
from typing import Annotated, ClassVar, Literal

import numpy as np

from nivel.elements.facts import Output, add_outputs, is_angle, of_effort, of_force, of_value
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element
from nivel.kernels.algebra.analytic import maximum, minimum, real
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.record import record_at
from nivel.known import SystemBuilder
from nivel.machine.core import coefficient
from nivel.machine.core.element import Acts, ForceElement, Holds, Inequalities
from nivel.machine.core.record import Problem, superfluous
from nivel.machine.given import Field, Maybe, OneNumber, TwoNumbers
from nivel.machine.units.quantity import PositiveLength, Quantity, Scalar
from nivel.machine.uses.coordinate_reference import CoordinateReference
from nivel.native.function import leaf, stage


class DriveLine(ForceElement):
    """What acts on the difference coordinate - ratio · against: an effort on the coordinate, and -ratio times it on the other one."""

    coordinate: CoordinateReference
    against: CoordinateReference = Field("the other joint coordinate")
    ratio: Scalar = Field("rate of `coordinate` per rate of `against` at which nothing slips or twists", default=1.0)

    def problems(self) -> Iterator[Problem]:
        if self.ratio == 0.0:
            yield Problem(
                ("ratio",), "`ratio` is zero: the other coordinate has no part in it; a `brake` has one coordinate"
            )


class Shaft(DriveLine):
    """Effort stiffness · twist + damping · rate, with twist = coordinate - ratio · against - free_value; none within the play."""

    outputs: ClassVar[tuple[str, ...]] = (*of_effort("effort that resists"), *of_value("twist"))

    inequalities: ClassVar[Inequalities] = tuple(
        Acts(
            ("is within its play", "is on a flank"),
            "twist",
            lambda own, of, way=way: way * of["twist"] - 0.5 * own.backlash,
            lambda own, of, way=way: of.part("magnitude", way),
            lambda own, of, way=way: way * of["rate"],
            applies=lambda own: own.backlash > 0.0,
        )
        for way in (1.0, -1.0)
    )

    type: Literal["shaft"] = "shaft"
    stiffness: coefficient.PositiveCoordinateStiffness
    damping: coefficient.CoordinateDamping = Field(default=0.0)
    free_value: coefficient.CoordinateValue = Field("of the difference, where the effort is zero", default=0.0)
    backlash: coefficient.NotNegativeValue = Field("play, from flank to flank", default=0.0)


PositiveStiffness = Annotated[OneNumber, Quantity("stiffness", positive=True)]


class BeltDrive(ForceElement):
    """Two elastic strands between two pulleys, which never push: a belt that slips (Euler, Eytelwein), a toothed belt, or a chain."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force("pull on the rims"),
        Output("slip_rate", "m/s", "speed of the slip"),
        Output("slip", "m"),
        Output("first_tension", "N", "tension of the strand that the first pulley pulls as it turns up"),
        Output("second_tension", "N", "tension of the other strand"),
    )

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
    coordinate: CoordinateReference = Field("angle of the first pulley")
    against: CoordinateReference = Field("angle of the second one")
    radii: TwoNumbers[PositiveLength] = Field("of the pulleys, or of the pitch circles")
    crossed: coefficient.Truth = Field("the belt crosses itself: the pulleys turn opposite ways", default=False)
    stiffness: PositiveStiffness = Field("of each strand")
    damping: coefficient.Damping = Field("of each strand", default=0.0)
    pretension: coefficient.NotNegativeForce = Field("of each strand, without torque", default=0.0)
    slack: coefficient.NotNegativeLength = Field("of each strand, as of a chain that sags", default=0.0)
    friction: Maybe[coefficient.PositiveNumber] = Field(
        "coefficient of friction on the pulleys", default=None, absent="none: teeth, it does not slip"
    )
    wrap: coefficient.PositiveAngle = Field("angle over which it touches the pulley on which it slips", default=pi)

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


class ShaftRow(Row):
    """A shaft. FREE : value of the coordinate in the middle of the play. PLAY : half of it."""

    output: int
    coordinate: int
    stiffness: float
    damping: float
    free: float
    play: float


@leaf
def flank(depth, rate, stiffness, damping, remembered, followed):
    """(force, elastic force, 1 where it is remembered that the flank touches) at overlap `depth` and its `rate`; it never pulls.

    followed : the flank touches or is apart as in the last accepted state, see `nivel.elements.contacts.impact`.
    """
    nothing = 0.0 * depth
    if real(depth) <= 0.0 and not (followed == 1 and remembered > 0.0):
        return nothing, nothing, 0.0
    kept = 1.0 if real(depth) > 0.0 else 0.0
    if followed == 1 and remembered == 0.0:
        return nothing, nothing, kept
    elastic = stiffness * depth
    force = elastic + damping * rate
    # With a damper it has ceased to push before it parts: what is followed beyond that is none, as before it.
    if real(force) < 0.0 and (real(depth) > 0.0 or real(damping) > 0.0):
        force = nothing
    return force, elastic, kept


@stage
def with_play(elements, k, twist, rate, stiffness, damping, play, followed):
    """(effort, elastic effort, stored energy) of element `k`: k c + d ċ, or with half a `play` on both sides of no twist, where it
    remembers a touch of each flank."""
    if play == 0.0:
        elastic = stiffness * twist
        return elastic + damping * rate, elastic, 0.5 * elastic * twist
    memory, proposal, depth = elements.memory[k], elements.proposal[k], elements.depth[k]
    depth[0], depth[1] = -play - twist, twist - play
    if followed == 1:
        elements.depth_rate[k, 0], elements.depth_rate[k, 1] = -rate, rate
    down, low, proposal[0] = flank(depth[0], -rate, stiffness, damping, memory[0], followed)
    up, high, proposal[1] = flank(depth[1], rate, stiffness, damping, memory[1], followed)
    return up - down, high - low, 0.5 * (low * depth[0] + high * depth[1])


@element
def twist_shaft(machine, k, index, n, t):
    """Effort against the twist."""
    record = record_at(machine)
    elements, coordinates, control, out = record.elements, record.coordinates, record.control, record.outputs.value
    q, first, play = index[ShaftRow.COORDINATE], index[ShaftRow.OUTPUT], n[ShaftRow.PLAY]
    twist, rate = coordinates.value[q] - n[ShaftRow.FREE], coordinates.rate[q]
    stiffness, damping, followed = n[ShaftRow.STIFFNESS], n[ShaftRow.DAMPING], record.watched.followed[0]
    effort, elastic, stored = with_play(elements, k, twist, rate, stiffness, damping, play, followed)
    control.stored[0] += stored
    control.power[1] += (effort - elastic) * rate
    out[first], out[first + 1] = effort, add_coordinate_force(machine, q, -effort)
    out[first + 2], out[first + 3] = twist, rate


class BeltRow(Row):
    """Two strands. TENSIONS : 1 where the tensions of both are reported, and the effort is that which resists."""

    output: int
    coordinate: int
    tensions: int
    stiffness: float
    damping: float
    pretension: float
    low: float
    high: float


# Places in the memory: the slip, and what is watched where steps are chosen: whether the upper and the lower end is reached, and whether
# each strand pulls.
SLIP, AT_HIGH, AT_LOW, PULLS, PULLS_BACK = 0, 1, 2, 3, 4
KEPT = 5
# z within this share of an end is there, or nearer than this [m or rad]
AT_END, AT_ZERO = 1e-9, 1e-15


@leaf
def near(end):
    """How far from an end it counts as reached."""
    return AT_END * np.abs(end) + AT_ZERO


@leaf
def watch(elements, k, place, value):
    """Note that `value` is watched, and on which side it is."""
    elements.depth[k, place] = value
    elements.proposal[k, place] = 1.0 if real(value) > 0.0 else 0.0


@leaf
def tension(elastic, whole, damping, remembered, held):
    """Tension of a strand, of its spring and `whole`: none where it is slack, and it never pushes. held : it is taut or slack as in the
    last accepted state, so that steps can end where that changes."""
    if held and (remembered == 0.0 or real(damping) == 0.0):
        return whole if remembered > 0.0 else 0.0 * whole
    return maximum(whole, 0.0) if held or real(elastic) > 0.0 else 0.0 * whole


@element
def pull_belt(machine, k, index, n, t):
    """Effort, slip and their power."""
    record = record_at(machine)
    elements, coordinates, control, value = record.elements, record.coordinates, record.control, record.outputs.value
    q, out = index[BeltRow.COORDINATE], index[BeltRow.OUTPUT]
    way, rate = coordinates.value[q], coordinates.rate[q]
    stiffness, pretension, low, high = n[BeltRow.STIFFNESS], n[BeltRow.PRETENSION], n[BeltRow.LOW], n[BeltRow.HIGH]
    strained = way - elements.memory[k, SLIP]
    z, stretching, slipping = strained, rate, 0.0 * rate
    lag = n[BeltRow.DAMPING] / stiffness * rate
    beyond, below = strained + lag - high, low - strained - lag
    # what has slipped stands at the end itself, where the rate says whether it goes on
    if high < np.inf and real(strained) > high - (near(high) if real(rate) > 0.0 else 0.0):
        z, stretching, slipping, beyond = high + 0.0 * rate, 0.0 * rate, rate, rate
    elif low > -np.inf and real(strained) < low + (near(low) if real(rate) < 0.0 else 0.0):
        z, stretching, slipping, below = low + 0.0 * rate, 0.0 * rate, rate, -rate
    elements.proposal[k, SLIP] = way - z
    watch(elements, k, AT_HIGH, beyond)
    watch(elements, k, AT_LOW, below)
    y = stiffness * z + n[BeltRow.DAMPING] * stretching
    y = minimum(maximum(y, stiffness * low), stiffness * high)
    first, second = maximum(pretension + stiffness * z, 0.0), maximum(pretension - stiffness * z, 0.0)
    held, damping = record.watched.followed[0] == 1 and high == np.inf, n[BeltRow.DAMPING]
    pull = tension(pretension + stiffness * z, pretension + y, damping, elements.memory[k, PULLS], held)
    back = tension(pretension - stiffness * z, pretension - y, damping, elements.memory[k, PULLS_BACK], held)
    watch(elements, k, PULLS, pretension + stiffness * z)
    watch(elements, k, PULLS_BACK, pretension - stiffness * z)
    if held:
        elements.depth_rate[k, PULLS], elements.depth_rate[k, PULLS_BACK] = stiffness * rate, -stiffness * rate
    effort = pull - back
    control.stored[0] += 0.5 * (first * first + second * second) / stiffness
    control.power[1] += effort * rate - (first - second) * stretching
    value[out], value[out + 1] = -effort, add_coordinate_force(machine, q, -effort)
    value[out + 2], value[out + 3] = slipping, way - z
    if index[BeltRow.TENSIONS] == 1:
        value[out], value[out + 4], value[out + 5] = effort, pull, back


def difference(builder: SystemBuilder, force: DriveLine) -> tuple[int, bool]:
    """The coordinate on which the element acts, and whether its first part is an angle."""
    first = builder.coordinate(force.coordinate)
    angle = is_angle(builder, first)
    if force.against is None:
        return first, angle
    second = builder.coordinate(str(force.against))
    return builder.coordinates.combined(((first, 1.0), (second, -force.ratio))), angle


def add_shaft(builder: SystemBuilder, force: Shaft) -> None:
    """A spring and damper, with two flanks where there is play."""
    coordinate, angle = difference(builder, force)
    first, play = add_outputs(builder, force, angle), 0.5 * force.backlash
    row = ShaftRow.of(force, output=first, coordinate=coordinate, free=force.free_value, play=play)
    builder.add(twist_shaft, row, *((2, (0, 1)) if force.backlash else (0, ())))


def add_belt_drive(builder: SystemBuilder, force: BeltDrive) -> None:
    """Two strands, and a slip where the pulleys are not toothed."""
    ends = [builder.coordinate(reference, "angle") for reference in (force.coordinate, force.against)]
    one, two = force.radii
    coordinate = builder.coordinates.combined(((ends[0], one), (ends[1], two if force.crossed else -two)))
    end, watched = math.inf, (PULLS, PULLS_BACK)
    if force.friction is not None:
        m = math.exp(force.friction * force.wrap)
        end = force.pretension * (m - 1.0) / (m + 1.0) / force.stiffness
        watched = AT_HIGH, AT_LOW
    first, pretension = add_outputs(builder, force), force.pretension - force.stiffness * force.slack
    row = BeltRow.of(force, output=first, coordinate=coordinate, tensions=1, pretension=pretension, low=-end, high=end)
    builder.add(pull_belt, row, KEPT, watched)


KINDS = (Kind(Shaft, add_shaft, (twist_shaft,)), Kind(BeltDrive, add_belt_drive, (pull_belt,)))
