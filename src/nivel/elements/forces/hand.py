"""A hand: a spring with a damper from a point of the body that is chosen to a point in space."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.kind import Kind
from nivel.elements.output import add_outputs, of_force
from nivel.elements.rows import Row, several
from nivel.elements.states import Coupled
from nivel.kernels.algebra.analytic import real
from nivel.kernels.core.status import OK
from nivel.kernels.record.function import evaluate_function
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.known import SystemBuilder
from nivel.machine.core.checked import Problem
from nivel.machine.core.coefficient import NotNegativeNumber
from nivel.machine.core.element import ForceElement
from nivel.machine.given import Field, OneNumber
from nivel.machine.laws.time_function import OneFunction, ThreeFunctions, varying
from nivel.machine.units.quantity import ANY, Quantity, listed

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
    pull: Varied = Field(description="1 while it holds, 0 while it does not, and between")
    body_number: Varied = Field(
        description="which body: its number in the order of the file, from 0; none where there is no such one"
    )
    point: Annotated[ThreeFunctions[Place], BeforeValidator(listed)] = Field(description="of the body, in its frame")
    towards: Annotated[ThreeFunctions[Place], BeforeValidator(listed)] = Field(description="in space, global axes")
    frequency: Frequency = Field(default=1.5, description="of the chosen body alone")
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


@family
def apply(machine, number, t):
    """m pull (ω² (towards - p) - 2 ζ ω ṗ) at p = R + A u; its power counts as work from outside."""
    record = record_at(machine)
    bodies, elements, out = record.bodies, record.elements, record.outputs.value
    for k in range(elements.span[number, 0], elements.span[number, 1]):
        index, n = elements.columns[k], elements.number[k]
        first = index[HandRow.OUTPUT]
        out[first] = out[first + 1] = 0.0
        pull = evaluate_function(machine, index[HandRow.PULL], t)
        chosen = np.floor(real(evaluate_function(machine, index[HandRow.BODY], t)) + 0.5)
        if real(pull) == 0.0 or not 0.0 <= chosen < bodies.mass.shape[0]:
            continue
        b = np.int64(chosen)
        A, R, V, w = bodies.A[b], bodies.R[b], bodies.Rdot[b], bodies.omega[b]
        x = evaluate_function(machine, index[HandRow.POINT], t)
        y = evaluate_function(machine, index[HandRow.POINT + 1], t)
        z = evaluate_function(machine, index[HandRow.POINT + 2], t)
        u0 = A[0, 0] * x + A[0, 1] * y + A[0, 2] * z
        u1 = A[1, 0] * x + A[1, 1] * y + A[1, 2] * z
        u2 = A[2, 0] * x + A[2, 1] * y + A[2, 2] * z
        v0, v1, v2 = V[0] + w[1] * u2 - w[2] * u1, V[1] + w[2] * u0 - w[0] * u2, V[2] + w[0] * u1 - w[1] * u0
        x = evaluate_function(machine, index[HandRow.TOWARDS], t) - R[0] - u0
        y = evaluate_function(machine, index[HandRow.TOWARDS + 1], t) - R[1] - u1
        z = evaluate_function(machine, index[HandRow.TOWARDS + 2], t) - R[2] - u2
        strength = pull * bodies.mass[b]
        f0 = strength * (n[HandRow.SPRING] * x - n[HandRow.DAMPER] * v0)
        f1 = strength * (n[HandRow.SPRING] * y - n[HandRow.DAMPER] * v1)
        f2 = strength * (n[HandRow.SPRING] * z - n[HandRow.DAMPER] * v2)
        F = bodies.wrench[b]
        F[0] += f0
        F[1] += f1
        F[2] += f2
        F[3] += u1 * f2 - u2 * f1
        F[4] += u2 * f0 - u0 * f2
        F[5] += u0 * f1 - u1 * f0
        power = f0 * v0 + f1 * v1 + f2 * v2
        out[first], out[first + 1] = np.sqrt(f0 * f0 + f1 * f1 + f2 * f2), power
        record.control.power[0] += power
    return OK


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
