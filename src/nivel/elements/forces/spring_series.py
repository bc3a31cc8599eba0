"""Springs and dampers in series without mass between them: one tension T in all parts, whose lengths add up.

A part with a damper has its length x_i as a state, c_i ẋ_i = T - k_i (x_i - f_i); one without has the length f_i + T/k_i. With L, the
distance of the ends, and sums over the parts without dampers (e) and with dampers (d),

    T = (L - Σ_d x_i - Σ_e f_i) / Σ_e 1/k_i

and where all parts have dampers, the last one has the length that is left, and T = (L̇ + Σ k_i (x_i - f_i)/c_i) / Σ 1/c_i. A spring and a
damper are Maxwell's element (1867).
"""

from collections.abc import Iterator, Sequence
from typing import Annotated, ClassVar, Final, Literal

import numpy as np
from pydantic import BeforeValidator

from nivel.elements.facts import Output, StateFact, add_outputs, of_force, of_value
from nivel.elements.kind import Kind
from nivel.elements.rows import Row, element, several
from nivel.kernels.algebra.analytic import real
from nivel.kernels.bodies.coordinate import DISTANCE
from nivel.kernels.forces.wrench import add_coordinate_force
from nivel.kernels.record.record import NONE, record_at
from nivel.known import SystemBuilder
from nivel.machine.core.coefficient import Damping, NotNegativeLength, Stiffness, Truth
from nivel.machine.core.element import Between
from nivel.machine.core.record import Problem
from nivel.machine.given import Field, ManyNumbers, Maybe
from nivel.machine.units.quantity import listed
from nivel.native.function import stage

MOST_PARTS: Final = 6


class SpringSeries(Between):
    """Parts in series along the line between two points: spring and damper side by side in each, one tension in all of them."""

    outputs: ClassVar[tuple[str, ...]] = (
        *of_force("tension"),
        *of_value("length"),
        *(Output(f"length_{k + 1}", "m", f"length of part {k + 1}") for k in range(MOST_PARTS)),
    )

    type: Literal["spring-series"] = "spring-series"
    stiffness: Annotated[ManyNumbers[Stiffness], BeforeValidator(listed)] = Field(
        "of each part, from the first point to the second; 0: a damper alone"
    )
    damping: Annotated[Maybe[ManyNumbers[Damping]], BeforeValidator(listed)] = Field(
        "of each part", default=None, absent="none"
    )
    free_length: Annotated[ManyNumbers[NotNegativeLength], BeforeValidator(listed)] = Field(
        "of each part, at which its spring has no force; of a part with a damper also its length at the start"
    )
    only_pulls: Truth = Field("it is slack where it would push, as with a rope in it", default=False)

    @property
    def dampings(self) -> tuple[float, ...]:
        """Of each part."""
        return self.damping or (0.0,) * len(self.stiffness)

    def problems(self) -> Iterator[Problem]:
        yield from super().problems()
        yield from self.problems_of_line()
        count = len(self.stiffness)
        if not 2 <= count <= MOST_PARTS:
            yield Problem(
                ("stiffness",),
                f"2 to {MOST_PARTS} parts in series were expected, got {count}; one part is a spring-damper",
            )
        for name in ("damping", "free_length"):
            given = getattr(self, name)
            if given is not None and len(given) != count:
                yield Problem((name,), f"one number for each of the {count} parts is needed, got {len(given)}")
                return
        for k, (stiffness, damping) in enumerate(zip(self.stiffness, self.dampings, strict=True)):
            if not stiffness and not damping:
                yield Problem(
                    ("stiffness", k), f"part {k + 1} has neither stiffness nor damping: nothing is held through it"
                )
        if self.only_pulls and all(self.dampings):
            yield Problem(
                ("only_pulls",),
                "every part has a damper; what may be slack needs one part with stiffness alone, as a rope is",
            )


STIFFNESS, DAMPING, FREE = range(3)  # of each part
PART = 3


class SeriesRow(Row):
    """COUNT parts, with STIFFNESS, DAMPING and FREE length of each; the state of each, or NONE."""

    output: int
    coordinate: int
    count: int
    states: Sequence[int] = several()
    only_pulls: float
    parts: Sequence[float] = several()


@stage
def tension_of(machine, index, n, length, rate):
    """Tension of an element; the length of its last part, where all have dampers, else 0."""
    states = record_at(machine).elements.state
    left, given, soft, loose = 1.0 * length, 1.0 * rate, 0.0 * length, 0.0 * length
    count = np.int64(index[SeriesRow.COUNT])
    for i in range(count):
        own = n[SeriesRow.PARTS + PART * i : SeriesRow.PARTS + PART * (i + 1)]
        if real(own[DAMPING]) == 0.0:
            left -= own[FREE]
            soft += 1.0 / own[STIFFNESS]
        else:
            loose += 1.0 / own[DAMPING]
            if index[SeriesRow.STATES + i] != NONE:
                x = states[index[SeriesRow.STATES + i]]
                left -= x
                given += own[STIFFNESS] * (x - own[FREE]) / own[DAMPING]
    if real(soft) > 0.0:
        tension = left / soft
        if real(n[SeriesRow.ONLY_PULLS]) > 0.0 and real(tension) < 0.0:
            tension = 0.0 * tension
        return tension, 0.0 * left
    last = n[SeriesRow.PARTS + PART * (count - 1) : SeriesRow.PARTS + PART * count]
    given += last[STIFFNESS] * (left - last[FREE]) / last[DAMPING]
    return given / loose, left


@element
def stretch(machine, index, n, t):
    """Tension, energies, and rates of the lengths of parts with dampers."""
    record = record_at(machine)
    elements, coordinates, control, out = record.elements, record.coordinates, record.control, record.outputs.value
    q, first = index[SeriesRow.COORDINATE], index[SeriesRow.OUTPUT]
    length, rate = coordinates.value[q], coordinates.rate[q]
    tension, last = tension_of(machine, index, n, length, rate)
    for i in range(np.int64(index[SeriesRow.COUNT])):
        own = n[SeriesRow.PARTS + PART * i : SeriesRow.PARTS + PART * (i + 1)]
        if real(own[DAMPING]) == 0.0:
            stretch = tension / own[STIFFNESS]
        else:
            x = last
            if index[SeriesRow.STATES + i] != NONE:
                x = elements.state[index[SeriesRow.STATES + i]]
            stretch = x - own[FREE]
            speed = (tension - own[STIFFNESS] * stretch) / own[DAMPING]
            if index[SeriesRow.STATES + i] != NONE:
                elements.state_rate[index[SeriesRow.STATES + i]] += speed
            control.power[1] += own[DAMPING] * speed * speed
        control.stored[0] += 0.5 * own[STIFFNESS] * stretch * stretch
        out[first + 4 + i] = own[FREE] + stretch
    out[first], out[first + 1] = tension, add_coordinate_force(machine, q, -tension)
    out[first + 2], out[first + 3] = length, rate


def add_spring_series(builder: SystemBuilder, force: SpringSeries) -> None:
    """Parts along a distance; those with dampers have their lengths as states, but the last one where all have dampers."""
    coordinate = builder.coordinates.use(builder.coordinates.add(DISTANCE, *builder.ends(force.ends)))
    parts = list(zip(force.stiffness, force.dampings, force.free_length, strict=True))
    first = add_outputs(builder, force, without=SpringSeries.outputs[-MOST_PARTS:][len(parts) :])
    followed = [k for k, damping in enumerate(force.dampings) if damping]
    if len(followed) == len(parts):
        followed.pop()
    scale, states = max(*force.free_length, 1e-3), []
    for k in range(len(parts)):
        fact = StateFact(
            f"{force.name}.length_{k + 1}", "m", f"length of part {k + 1} of {force.name}", parts[k][2], scale
        )
        states.append(builder.own_state(fact) if k in followed else NONE)
    row = SeriesRow(
        output=first,
        coordinate=coordinate,
        count=len(parts),
        states=states,
        only_pulls=float(force.only_pulls),
        parts=[number for part in parts for number in part],
    )
    builder.add(stretch, row)


KINDS = (Kind(SpringSeries, add_spring_series, (stretch,)),)
