"""The parts of a machine that nothing joins to the others but the ground."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from nivel.machine.bodies.inertia import mass_properties
from nivel.machine.machine_record import MachineRecord
from nivel.results.trust.part_energy import Part

WORD = re.compile(r"[^\W\d]\w*(?:-\w+)*")
MOST = 50  # parts: machines of more are not looked at


def separate_parts(machine: MachineRecord) -> list[Part]:
    """Those of rigid bodies on which weight alone acts; none of machines with beams or circuits, or of one part."""
    if machine.beams or machine.hydraulics or machine.is_flexible:
        return []
    words: dict[str, set[str]] = {}
    for each in (*machine.joints, *machine.couplings, *machine.drivers, *machine.forces):
        words.setdefault(each.name, set()).update(_words(each))
    acts_on = {name: _bodies_of(machine, name, words) for name in words}
    groups = _joined([body.name for body in machine.bodies], acts_on.values())
    if not 1 < len(groups) <= MOST:
        return []
    driven = {body for each in (*machine.forces, *machine.drivers) for body in acts_on[each.name]}
    return [_part(machine, group) for group in groups if not driven & set(group)]


def _part(machine: MachineRecord, names: list[str]) -> Part:
    its = [mass_properties(machine.body_named[name]) for name in names]
    return Part(
        bodies=tuple(names),
        mass=np.array([each.mass for each in its]),
        centre=np.array([each.centre_of_mass for each in its]),
        inertia=np.array([each.inertia for each in its]),
        gravity=np.array(machine.gravity, dtype=float),
    )


def _joined(names: list[str], joined: Iterable[set[str]]) -> list[list[str]]:
    """The names in groups: those of a set in one."""
    group = {name: {name} for name in names}
    for each in joined:
        whole = set().union(*(group[name] for name in each))
        group.update(dict.fromkeys(whole, whole))
    firsts = {id(whole): whole for whole in group.values()}
    return [[name for name in names if name in whole] for whole in firsts.values()]


def _bodies_of(machine: MachineRecord, name: str, words: Mapping[str, set[str]]) -> set[str]:
    """Bodies that the element names in any way: itself, by markers, by other elements and their coordinates."""
    left, seen, bodies = set(words[name]), {name}, set[str]()
    while left:
        word = left.pop()
        if word in machine.body_named:
            bodies.add(word)
        elif word in machine.marker_named:
            bodies.add(machine.marker_named[word].body)
        elif word in words and word not in seen:
            seen.add(word)
            left |= words[word]
    return bodies & set(machine.body_named)


def _words(element: Any) -> set[str]:
    """All words in the texts of an element."""
    found: set[str] = set()
    left: list[Any] = [element.model_dump(mode="python", exclude_none=True)]
    while left:
        each = left.pop()
        if isinstance(each, str):
            found |= {each, *WORD.findall(each)}
        elif isinstance(each, dict):
            left += each.values()
        elif isinstance(each, list | tuple | set):
            left += each
    return found
