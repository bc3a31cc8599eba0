"""States of elements against their own inequalities: open or closed, slack or taut, held or sliding; and first-order states.

Each kind of element declares its inequalities in its record (`nivel.machine.core.element`). They are looked at in all frames of a run
and of its second run: frames of steps that were chosen lie inside these, where an element keeps the side that it had at their begin.
"""

from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nivel.judge.after.report import FRAMES, Check, Need
from nivel.judge.after.subject import Run
from nivel.known import Contact
from nivel.lazy import Struct, nivel, replace
from nivel.machine.core.element import Acts, Holds
from nivel.machine.core.vectors import Array
from nivel.machine.machine_record import MachineRecord
from nivel.machine.uses.coordinate_reference import UnknownCoordinateError, resolve
from nivel.results.motion import peak
from nivel.results.result import Result
from nivel.results.trust import Item, Threshold, number
from nivel.system.tables import OVER_HEIGHTS, rows_of

SHOWN = 5  # elements of which each has a line
# An overlap or an effort below this share of its largest value is none, and an overlap below this share of the size of the machine.
ROUNDING, PLACE = 1e-9, 1e-12
# Efforts of friction are found to this share of the largest limit; efforts below NOTHING [N or N m] are none.
FOUND, NOTHING = 1e-5, 1e-12
# Share of the size of the machine, or angle [rad], by which what holds may slide.
SLID = 1e-4
# An overlap that steps have not seen is so many times those at their ends.
DEEPER = 2.0


class Contradiction(Struct):
    """A state of `element` that contradicts its inequality at `time` [s], in words, and in how many frames. second : they are those of the
    second run."""

    element: str
    time: float
    said: str
    count: int
    second: bool = False


class Numbers:
    """The numbers of one element in a result: outputs by name, coordinates and pressures by what its record says. KeyError where the
    result does not have one."""

    def __init__(self, result: Result, machine: MachineRecord, element: Any) -> None:
        self._result, self._machine, self._element = result, machine, element
        self._section = "force" if element.collection == "forces" else element.collection

    def _read(self, name: str) -> Array:
        if name not in self._result:
            raise KeyError(name)
        return np.asarray(self._result.array(name), dtype=float)

    def __getitem__(self, output: str) -> Array:
        return self._read(f"{self._section}.{self._element.name}.{output}")

    def units(self, like: str) -> str:
        """Of an output, or a field of the record that refers to a coordinate or is a pressure; without the time of a rate."""
        if like == "coordinate":
            joint, coordinate = self._resolved(self._element.coordinate)
            return self._result.units(f"{joint}.{coordinate}")
        if like not in (*getattr(self._element, "outputs", ()), *getattr(self._element, "late", ())):
            return "Pa"
        return self._result.units(f"{self._section}.{self._element.name}.{like}").removesuffix("/s")

    def all(self, value: float | None) -> Array:
        """A number at all times, infinite where there is none."""
        return np.full(len(self._result.time), np.inf if value is None else value)

    def part(self, output: str, way: float) -> Array:
        """The part of an output that has the sign `way`, as a magnitude."""
        return np.maximum(way * self[output], 0.0)

    def value(self, reference: str) -> Array:
        """Of a joint coordinate [rad or m]."""
        return self._coordinate(reference, "")

    def rate(self, reference: str) -> Array:
        """Of a joint coordinate [rad/s or m/s]."""
        return self._coordinate(reference, ".rate")

    def _coordinate(self, reference: str, rate: str) -> Array:
        joint, coordinate = self._resolved(reference)
        return self._read(f"{joint}.{coordinate}{rate}")

    def _resolved(self, reference: str) -> tuple[str, str]:
        try:
            return resolve(reference, self._machine.joints)
        except UnknownCoordinateError as fault:
            raise KeyError(reference) from fault

    def difference(self, own: Any) -> Array:
        """coordinate - ratio · against."""
        return self.value(own.coordinate) - (own.ratio * self.value(own.against) if own.against is not None else 0.0)

    def way(self, own: Any) -> Array:
        """[m] of one rim against the other, of two pulleys."""
        one, two = own.radii
        return one * self.value(own.coordinate) + (two if own.crossed else -two) * self.value(own.against)

    def pressure(self, port: str) -> Array:
        """[Pa] of the node at a port; that of a cylinder is before its cushion where it has one."""
        node, _, chamber = self._element.ports[port].partition(".")
        if not chamber:
            return self._read(f"hydraulics.{node}.pressure")
        before = f"hydraulics.{node}.pressure_port_{chamber}"
        return self._read(before if before in self._result else f"hydraulics.{node}.pressure_{chamber}")


class Frames(Struct):
    """An element in the frames of a result."""

    run: Run
    result: Result
    element: Any

    @cached_property
    def numbers(self) -> Numbers:
        return Numbers(self.result, self.run.machine, self.element)

    def _units(self, like: str) -> str:
        """A second run does not keep those of coordinates."""
        return Numbers(self.run.result, self.run.machine, self.element).units(like)

    def contradictions(self) -> Iterator[Contradiction]:
        """The largest of each kind."""
        for rule in self.element.inequalities:
            if rule.applies(self.element):
                try:
                    yield from self._acting(rule) if isinstance(rule, Acts) else self._holding(rule)
                except KeyError:
                    continue  # the result was asked to leave it out

    def _acting(self, rule: Acts) -> Iterator[Contradiction]:
        own, of = self.element, self.numbers
        overlap, effort = rule.overlap(own, of), np.abs(rule.effort(own, of))
        units, size = self._units(rule.like), self.run.scales.size
        least = ROUNDING * _largest(overlap) + PLACE * (size if units == "m" else 1.0)
        acts = effort > ROUNDING * _largest(effort) + NOTHING
        is_open, is_closed = rule.sides
        yield from self._told((overlap < -least) & acts, -overlap, f"{is_open} by {{}} {units} and acts")
        if rule.always(own):
            grows = _rises(overlap) if rule.rate is None else rule.rate(own, of) > 0.0
            idle = (overlap > least) & (effort == 0.0) & grows
            yield from self._told(idle, overlap, f"{is_closed} by {{}} {units} and does not act")

    def _holding(self, rule: Holds) -> Iterator[Contradiction]:
        own, of = self.element, self.numbers
        effort, limit, slip = rule.effort(own, of), rule.limit(own, of), rule.slip(own, of)
        least = FOUND * max(_largest(limit), _largest(effort)) + NOTHING
        beyond = np.maximum(np.abs(effort) - limit, -effort if rule.one_way else -np.inf)
        yield from self._told(beyond > least, beyond, f"exerts {{}} {self._units('magnitude')} more than its limit")
        below = np.abs(effort) < rule.sliding(own, of) - least
        holds = below & (effort > least) if rule.one_way else below
        units = self._units(rule.like)
        yield from self._sliding(holds, np.abs(slip), f"holds and slides by {{}} {units}", units)
        if rule.one_way:
            yield from self._sliding(below & (slip < 0.0), np.abs(slip), f"falls behind by {{}} {units}", units)

    def _sliding(self, held: NDArray[np.bool_], slip: Array, said: str, units: str) -> Iterator[Contradiction]:
        """What slides from frame to frame at which it is held: with the lesser one of both speeds, as it takes a short time to stop."""
        time = self.result.time
        way = np.minimum(slip[1:], slip[:-1]) * np.diff(time) * (held[1:] & held[:-1])
        total = float(way.sum())
        if total > SLID * (self.run.scales.size if units == "m" else 1.0):
            k = int(np.argmax(way))
            yield Contradiction(self.element.name, float(time[k]), said.format(number(total)), int((way > 0.0).sum()))

    def _told(self, wrong: NDArray[np.bool_], amount: Array, said: str) -> Iterator[Contradiction]:
        if wrong.any():
            k = int(np.argmax(np.where(wrong, amount, -np.inf)))
            time = float(self.result.time[k])
            yield Contradiction(self.element.name, time, said.format(number(float(amount[k]))), int(wrong.sum()))


def passed_over(run: Run) -> Iterator[Contradiction]:
    """Contacts with ground that has heights, into which steps of fixed size go deeper than at any of their ends."""
    elements = run.prepared.motion.system.record.elements
    names = [force.name for force in run.machine.forces if isinstance(force, Contact) and force.heights is not None]
    if not names:
        return
    heights = nivel.elements.contacts.heights
    first, last = rows_of(elements, OVER_HEIGHTS)
    for name, numbers in zip(names, elements.number[first:last], strict=True):
        missed, seen = float(numbers[heights.MISSED]), max(float(numbers[heights.SEEN]), 0.0)
        if missed > DEEPER * seen + PLACE * run.scales.size:
            said = f"touches by {number(missed)} m between two steps, which do not see it,"
            yield Contradiction(name, float(numbers[heights.MISSED_AT]), said, 1)


def look_at_sides(run: Run) -> list[Contradiction]:
    """The first contradiction of each element: between steps of fixed size, in the frames of the run, or in those of the second one."""
    found = {each.element: each for each in passed_over(run)} if run.plan.settings.steps > 0 else {}
    results = [run.result, *([run.second.result] if run.second is not None else [])]
    for second, result in enumerate(results):
        for element in (*run.machine.forces, *run.machine.hydraulics):
            if element.inequalities and element.name not in found and len(found) < SHOWN:
                for each in Frames(run, result, element).contradictions():
                    found.setdefault(each.element, replace(each, second=bool(second)))
    return list(found.values())


def _say_side(found: Contradiction) -> Item:
    of = " of the second run" if found.second else ""
    more = f", in {found.count} frames{of}" if found.count > 1 else of
    text = f"State: {found.element} {found.said} at t = {found.time:.6g} s{more}: its state is wrong, use shorter steps or another method"
    return Item("state", "red", text, row=found.element, time=found.time)


def _rises(values: Array) -> NDArray[np.bool_]:
    """(n,) whether they grew from the frame before, and do to the next."""
    grows = np.diff(values) > 0.0
    return np.append(False, grows) & np.append(grows, False)


def _largest(values: Array) -> float:
    """Of the magnitudes that are finite."""
    return float(np.max(np.abs(values), initial=0.0, where=np.isfinite(values)))


# A state whose values stay below this share of its scale is not followed, and where the tolerance is finer below the share of which that is
# FOLLOWED.
SMALL, FOLLOWED = 0.01, 1e-4


def _controls_errors(run: Run) -> bool:
    facts = run.prepared.integrator
    return bool(facts.chooses_steps or facts.optional_control or facts.residual)


TOLERANCE = Need("a method with a tolerance", _controls_errors)


class SmallState(Struct):
    """A first-order state whose `largest` magnitude stayed far below its `scale`, by which its errors were measured."""

    name: str
    largest: float
    scale: float

    @property
    def place(self) -> list[str]:
        """The section and the name of the record to which it belongs."""
        return self.name.split(".")[:2] if self.name.startswith("control.") else ["states", self.name]


def look_at_states(run: Run) -> list[SmallState]:
    """The small states of `states` and `control`; those of forces and circuits have the scales of their elements."""
    small = min(SMALL, (run.plan.settings.tolerance or 1.0) / FOLLOWED)
    out, given = [], {state.name for state in run.machine.states}
    for fact in run.prepared.motion.system.states:
        if fact.sampled or not (fact.name in given or fact.name.startswith("control.")):
            continue
        largest = peak(run.result, fact.result).value
        if 0.0 < largest < small * fact.scale:
            out.append(SmallState(fact.name, largest, fact.scale))
    return out


def _say_state(found: SmallState) -> Item:
    said = f"the largest value of {found.name} is {number(found.largest)}, its scale is {number(found.scale)}: the tolerance hardly held"
    section, name = found.place
    advice = f"write `{section}: {{{name}: {{scale: {found.largest:.1g}}}}}`"
    return Item("states", "amber", f"States: {said} it; {advice}", row=found.name)


CHARGED = Threshold(
    1e-3,
    1e-2,
    "How far the state of charge is beyond those that have a voltage. There the voltage is taken to be that of the nearest of them, which "
    "no battery keeps.",
)


class Charged(Struct):
    """The state of charge of the battery of a drive that is farthest `beyond` its `given` ones, the first and the last, and when [s]."""

    drive: str
    charge: float
    beyond: float
    time: float
    given: tuple[float, float]


def _look_at_batteries(run: Run) -> list[Charged]:
    out = []
    for force in run.machine.forces:
        if (battery := getattr(force, "battery", None)) is not None:
            charge, (first, *_, last) = run.result.array(f"state.{force.name}.charge"), battery.charges
            beyond = np.maximum(first - charge, charge - last)
            k = int(np.argmax(beyond))
            out.append(
                Charged(force.name, float(charge[k]), float(beyond[k]), float(run.result.time[k]), (first, last))
            )
    return out


def _say_battery(found: Charged) -> Item:
    first, last = map(number, found.given)
    charge = f"the charge of {found.drive} is {number(found.charge)} at t = {found.time:.6g} s"
    advice = "give it a larger `capacity` or another `start`, take less from it, or give `voltages` there"
    said = f"Battery: {charge}, its voltages are given from {first} to {last}; {advice}"
    return CHARGED.item("battery", said, found.beyond, found.time, found.drive)


CHECKS = (
    Check("battery", Run, _look_at_batteries, _say_battery, 219, (FRAMES,), "Battery", CHARGED, quiet=True),
    Check("state", Run, look_at_sides, _say_side, 218, (FRAMES,), "State", blind="both have {row} in a wrong state"),
    Check("states", Run, look_at_states, _say_state, 400, (TOLERANCE,), "States"),
)
