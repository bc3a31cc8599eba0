"""A hand: a spring with a damper from a point of the body that is chosen to a point in space."""

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.facts import Coupled, add_outputs, of_force
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element, several
from nivel.kernels.algebra.analytic import real
from nivel.kernels.algebra.spatial import dot
from nivel.kernels.algebra.vectors import minus, plus, times, turned
from nivel.kernels.forces.wrench import add_force_at, velocity_at
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.record import record_at
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import NotNegativeNumber
from nivel.machine.core.element import ForceElement
from nivel.machine.core.record import Problem
from nivel.machine.given import Field, OneNumber
from nivel.machine.laws.time_function import OneFunction, ThreeFunctions, varying
from nivel.machine.units.quantity import ANY, Quantity, listed
from nivel.native.function import stage

Varied = Annotated[OneFunction, varying(ANY)]
Place = Annotated[OneFunction, varying("length")]
Frequency = Annotated[OneNumber, Quantity("frequency", positive=True)]


class Hand(ForceElement):
    """A force m pull (ω² (towards - p) - 2 ζ ω ṗ) at the point p of the chosen body of mass m, ω = 2π `frequency`: as strong as lets the
    body alone swing with this frequency and damping ratio.

    `nivel live` adds one, by which bodies are picked up with the mouse.
    """

    outputs: ClassVar[tuple[str, ...]] = of_force()
    stiff: ClassVar[bool] = False

    type: Literal["hand"] = "hand"
    pull: Varied = Field("1 while it holds, 0 while it does not, and between")
    body_number: Varied = Field(
        "which body: its number in the order of the file, from 0; none where there is no such one"
    )
    point: Annotated[ThreeFunctions[Place], BeforeValidator(listed)] = Field("of the body, in its frame")
    towards: Annotated[ThreeFunctions[Place], BeforeValidator(listed)] = Field("in space, global axes")
    frequency: Frequency = Field("of the chosen body alone", default=1.5)
    damping_ratio: NotNegativeNumber = Field(default=0.7)

    def problems(self) -> Iterator[Problem]:
        if isinstance(self.pull, int | float) and self.pull == 0:
            yield Problem(
                ("pull",), "a hand that never pulls does nothing; 1 holds, or an expression such as `grip.value`"
            )


class HandRow(Row):
    """Functions of a hand; SPRING and DAMPER are ω² and 2 ζ ω, per mass."""

    output: int
    pull: int
    body: int
    point: Sequence[int] = several(3)
    towards: Sequence[int] = several(3)
    spring: float
    damper: float


@stage
def place_of(machine, functions, t):
    """The vector whose components are three functions."""
    return (
        evaluate_function(machine, functions[0], t),
        evaluate_function(machine, functions[1], t),
        evaluate_function(machine, functions[2], t),
    )


@element
def apply(machine, index, n, t):
    """m pull (ω² (towards - p) - 2 ζ ω ṗ) at p = R + A u; its power counts as work from outside."""
    record = record_at(machine)
    bodies, out, first = record.bodies, record.outputs.value, index[HandRow.OUTPUT]
    out[first] = out[first + 1] = 0.0
    pull = evaluate_function(machine, index[HandRow.PULL], t)
    chosen = np.floor(real(evaluate_function(machine, index[HandRow.BODY], t)) + 0.5)
    if real(pull) == 0.0 or not 0.0 <= chosen < bodies.mass.shape[0]:
        return
    b = np.int64(chosen)
    p = plus(bodies.R[b], turned(bodies.A[b], place_of(machine, index[HandRow.POINT :], t)))
    wish, v = minus(place_of(machine, index[HandRow.TOWARDS :], t), p), velocity_at(bodies, b, p)
    force = minus(times(n[HandRow.SPRING], wish), times(n[HandRow.DAMPER], v))
    force = times(pull * bodies.mass[b], force)
    power = add_force_at(bodies, b, p, force)
    out[first], out[first + 1] = np.sqrt(dot(force, force)), power
    record.control.power[0] += power


def add(builder: SystemBuilder, hand: Hand) -> None:
    """A hand, which may hold any body."""
    omega = 2.0 * math.pi * hand.frequency
    builder.note(Coupled(frozenset(range(len(builder.machine.bodies)))))
    row = HandRow(
        output=add_outputs(builder, hand),
        pull=builder.function(hand.pull),
        body=builder.function(hand.body_number),
        point=[builder.function(each) for each in hand.point],
        towards=[builder.function(each) for each in hand.towards],
        spring=omega**2,
        damper=2.0 * hand.damping_ratio * omega,
    )
    builder.add(apply, row)


KINDS = (Kind(Hand, add, (apply,)),)
