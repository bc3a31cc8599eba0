"""Plausibility: numbers of the machine and of the result that are far from those of real machines."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from nivel.analysis.trust.check import Check
from nivel.analysis.trust.subject import Equilibria, Positions, Run
from nivel.machine.bodies.body import Body
from nivel.machine.given import Usual
from nivel.machine.joints.joint import CoordinateRates
from nivel.machine.machine_record import MachineRecord
from nivel.machine.plausible import excess, in_words, remarks
from nivel.results.trust import Item, Threshold
from nivel.system.forces.stretched_ropes import stretched_ropes

SHOWN = 8  # numbers of which each has a line
THRESHOLD = Threshold(
    1.0,
    math.inf,
    "By how many times a number is beyond those of real machines, from small instruments to the largest that are built. The result is "
    "exact for the model all the same; the model may have a slip of a unit.",
)


@dataclass(frozen=True)
class Unusual:
    """A number of the machine file or of the result, in words, and by how many times it is beyond what is usual; infinite where that is
    no matter of its size. time [s] : of a result, when it is largest."""

    name: str
    said: str
    share: float
    time: float | None = None


def look(subject: Run | Equilibria | Positions) -> list[Unusual]:
    """What is farthest beyond the usual."""
    found = [Unusual(each.place, f"{each.place}: {each.message}", each.share) for each in remarks(subject.machine)]
    found += [Unusual(name, f"forces.{name}: {said}", math.inf) for name, said in stretched_ropes(subject.machine)]
    found += _of_result(subject)
    return sorted(found, key=lambda each: -each.share)[:SHOWN]


def say(found: Unusual) -> Item:
    """The number, and what is usual."""
    text = f"Plausibility: {found.said}"
    if math.isinf(found.share):
        return Item("plausible", "amber", text, row=found.name)
    return THRESHOLD.item("plausible", text, found.share, found.time, found.name)


def _of_result(subject: Run | Equilibria | Positions) -> Iterator[Unusual]:
    """Outputs of elements, speeds of bodies and joints, and the size of the machine."""
    machine, result = subject.machine, subject.result
    if not len(result.time):
        return
    kinds = {("hydraulics", each.name): type(each).usual for each in machine.hydraulics}
    kinds |= {("force", each.name): type(each).usual for each in machine.forces}
    for name in result.variables:
        section, _, output = name.partition(".")
        owner, _, word = output.partition(".")
        ranges = kinds.get((section, owner), {})
        known = next((usual for start, usual in ranges.items() if word.startswith(start)), None)
        if known is not None:
            yield from _of_columns(subject, result.array(name)[:, None], [output], [known])
    names = result.coordinates.get("body", ())
    for variable, usual in Body.usual.items():
        if variable in result.variables:
            speed = np.linalg.norm(result.array(variable), axis=-1)
            yield from _of_columns(subject, speed, [f"{variable} of {name}" for name in names], [usual] * len(names))
    if "joint_rate" in result.variables:
        labels = result.coordinates[result.variables["joint_rate"].dims[1]]
        units = ["rad/s" if each.rpartition(".")[2].startswith("angle") else "m/s" for each in labels]
        usual = [CoordinateRates.usual[each] for each in units]
        yield from _of_columns(subject, result.array("joint_rate"), [f"rate of {each}" for each in labels], usual)
    size, kind = subject.scales.size, subject.scales.size_kind
    if machine.joints or machine.beams:  # what flies freely may be anywhere
        share = excess(size, MachineRecord.usual["size"])
        if share > 1.0:
            yield Unusual(kind, f"the {kind} is {in_words(size, MachineRecord.usual['size'])}", share)


def _of_columns(
    subject: Run | Equilibria | Positions, values: Any, names: list[str], ranges: list[Usual]
) -> Iterator[Unusual]:
    """The largest magnitude of each column that is beyond its range; small ones, as of a valve that is shut, are usual."""
    sizes = np.abs(np.nan_to_num(np.asarray(values, dtype=float), nan=0.0))
    frames = np.argmax(sizes, axis=0)
    for k, (name, usual) in enumerate(zip(names, ranges, strict=True)):
        value = float(sizes[frames[k], k])
        share = excess(value, Usual(0.0, usual.most, usual.unit))
        if share > 1.0:
            time = float(subject.result.time[frames[k]])
            yield Unusual(name, f"{name} is {in_words(value, usual)}, at t = {time:.6g} s", share, time)


CHECKS = (Check("plausible", (Run, Equilibria, Positions), look, say, 920, (), "Plausibility", THRESHOLD, quiet=True),)
