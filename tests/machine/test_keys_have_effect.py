"""A key of a machine that has no effect is refused or remarked on: every value of every kind is changed, and every key is added to it."""

import re
from copy import deepcopy

import numpy as np
import pytest
from everything import EVERYTHING

from lanes import parts
from nivel import MachineRecord
from nivel.elements.contacts.soil import SoilUnit
from nivel.errors import ModelError
from nivel.judge.before.unusual import remarks
from nivel.system.beam_nodes import with_nodes
from nivel.system.build import build
from nivel.system.system import Equations

PARTS = 8
# what stands apart from the element that is looked at, as long as the machine can be read
APART = [
    ("forces", "beams", "hydraulics", "control", "sensors", "states", "events"),
    ("forces", "beams", "hydraulics"),
    ("forces", "hydraulics"),
    ("forces", "beams", "sensors", "states", "events"),
    ("forces",),
    (),
]
NUMBER = re.compile(r"-?\d+(\.\d*)?([eE]-?\d+)?")
# ropes on wheels that lie in each other, which nobody builds, and what reads them
UNBUILT = {"capstan", "heavy", "later", "tension"}
# what acts later than the arrays of a system are made: on the assembly, the start, errors and steps, the picture, or who operates
LATER = {
    *(
        "hold",
        "assembly_weight",
        "start",
        "start_rates",
        "start_A",
        "start_B",
        "from_start",
        "scale",
        "range",
        "rate",
        "gamepad",
    ),
    *("name", "type", "description", "colour", "keys", "shape", "steps", "label"),
}
# directions, whose length means nothing; the largest speed of a trapezoid that is too short for it
ALIKE = {"axis", "x_axis", "up", "speed"}


def leaves(value):
    """All arrays and numbers of a record of a system."""
    for each in value if isinstance(value, tuple) else [value]:
        if isinstance(each, tuple):
            yield from leaves(each)
        else:
            yield each


def arrays(machine):
    """Everything of the system of a machine."""
    system = build(with_nodes(machine), Equations(6, normalisation=False))
    arguments, soils = system.record.functions.arguments, [each for each in system.units if isinstance(each, SoilUnit)]
    for each in soils:  # its cells count, and not where they are
        arguments[arguments == float(each.handle.address)] = 0.0
    of_soils = [array for each in soils for array in each.record]
    return [
        *leaves(tuple(system.record)),
        *of_soils,
        system.start,
        *system.rows,
        repr(system.layout),
        repr(system.states),
    ]


def told(machine):
    return [f"{each.place}: {each.text}" for each in remarks(machine)]


def same(first, second):
    return len(first) == len(second) and all(
        np.array_equal(a, b, equal_nan=a.dtype.kind == "f") if isinstance(a, np.ndarray) else repr(a) == repr(b)
        for a, b in zip(first, second, strict=True)
    )


def reduced(section, name):
    """The machine with this element and as little else as can be read, and its data."""
    for apart in APART if section != "fluids" else APART[3:]:
        data = deepcopy(EVERYTHING)
        for each in apart:
            data[each] = [element for element in data[each] if (each, element["name"]) == (section, name)]
        while True:
            try:
                return MachineRecord(**data), data
            except ModelError as error:
                faulty = {tuple(fault.path.split(".")[:2]) for fault in error.faults}
            if (section, name) in faulty or not any(len(each) > 1 for each in faulty):
                break
            for each, other in [pair for pair in faulty if len(pair) > 1]:
                data[each] = [element for element in data[each] if element["name"] != other]
    raise AssertionError(f"{section}.{name} stands in no machine that can be read")


def with_value(data, section, name, path, value):
    data = deepcopy(data)
    place = next(each for each in data[section] if each["name"] == name)
    for step in path[:-1]:
        place = place[step]
    place[path[-1]] = value
    return data


def values(data, path=()):
    """(path, value) of everything that is no list and no table."""
    if isinstance(data, dict | list):
        for key, value in data.items() if isinstance(data, dict) else enumerate(data):
            yield from values(value, (*path, key))
    else:
        yield path, data


def other_values(value):
    """Two values near this one; none of texts without a number."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, str):
        found = NUMBER.match(value.strip())
        return (
            [f"{each!r}{value.strip()[found.end() :]}" for each in other_values(float(found.group()))] if found else []
        )
    return [1.07 * value + (0.01 if value == 0 else 0.0), value + 1] if isinstance(value, int | float) else []


def has_effect(base, data):
    """Whether this data is refused, remarked on in another way, or makes another system."""
    try:
        machine = MachineRecord(**data)
        return told(machine) != base[1] or not same(base[0], arrays(machine))
    except ModelError:
        return True


ELEMENTS = [
    (section, each["name"])
    for section, elements in EVERYTHING.items()
    if isinstance(elements, list) and section != "gravity"
    for each in elements
    if each["name"] not in UNBUILT
]


@parts(PARTS)
def test_every_value_that_is_changed_has_an_effect(part):
    idle = []
    for section, name in ELEMENTS[part::PARTS]:
        machine, data = reduced(section, name)
        base = arrays(machine), told(machine)
        element = next(each for each in data[section] if each["name"] == name)
        for path, value in values(element):
            if LATER.isdisjoint(path) and ALIKE.isdisjoint(path):
                changed = [with_value(data, section, name, path, each) for each in other_values(value)]
                if changed and not any(has_effect(base, each) for each in changed):
                    idle.append((section, name, path, value))
    assert not idle


def examples():
    """Values of each key, wherever it stands."""
    found, waiting = {}, [EVERYTHING]
    while waiting:
        each = waiting.pop()
        for key, value in each.items() if isinstance(each, dict) else ():
            found.setdefault(key, []).append(value)
        waiting += each.values() if isinstance(each, dict) else each if isinstance(each, list) else []
    return found


@parts(4 * PARTS)
def test_every_key_that_is_added_has_an_effect(part):
    """With some value of its kind, in two sizes, so that it is not the default."""
    idle, known = [], examples()
    for section, name in ELEMENTS[part :: 4 * PARTS]:
        machine, data = reduced(section, name)
        base = arrays(machine), told(machine)
        element = next(each for each in getattr(machine, section) if each.name == name)
        present = next(each for each in data[section] if each["name"] == name)
        for key in (
            {field.alias or key for key, field in type(element).model_fields.items()} - LATER - ALIKE - set(present)
        ):
            added = [
                with_value(data, section, name, (key,), each)
                for value in [*known.get(key, [])[:4], 0.37]
                for each in (value, *other_values(value))
            ]
            if (section, key) != ("sensors", "limit") and not any(has_effect(base, each) for each in added):
                idle.append((section, name, key))
    assert not idle


CONTACT = {"type": "contact", "bodies": ["a", "b"], "stiffness": 1e6, "restitution": 0.5}
PORTS = {"ports": {"A": "tank", "B": "line"}}
RELIEF = {"name": "relief", "type": "relief-valve", "ports": {"P": "line", "T": "tank"}, "opens_at": 2e7} | {
    "flow": 1e-3,
    "pressure_drop": 2e7,
    "opening_range": 2e6,
}
PUMP = {"type": "pump", **PORTS, "displacement": 1e-6, "speed": 100}


@pytest.mark.parametrize(
    ("section", "element", "key", "value", "word"),
    [
        ("forces", CONTACT, "friction_model", "stiction", "friction"),
        ("forces", CONTACT, "friction_transition_speed", 0.01, "friction"),
        ("hydraulics", PUMP, "damping_ratio", 0.7, "frequency"),
        ("hydraulics", PUMP, "nominal_speed", 150, "volumetric_efficiency"),
        ("hydraulics", {"type": "orifice", **PORTS, "leakage": 1e-12}, "discharge_coefficient", 0.6, "diameter"),
    ],
)
def test_a_key_that_belongs_to_one_that_is_missing_is_remarked_on(section, element, key, value, word):
    ball = {"mass": 1, "shape": {"type": "sphere", "radius": 0.1}}
    data = {"name": "two", "bodies": [{"name": "a", **ball}, {"name": "b", "position": [1, 0, 0], **ball}]}
    if section == "hydraulics":
        data["fluids"] = [{"name": "oil", "bulk_modulus": 1.4e9, "viscosity": 46e-6, "density": 870}]
        data[section] = [{"name": "tank", "type": "tank"}, {"name": "line", "type": "volume", "volume": 1e-3}, RELIEF]
    data[section] = [*data.get(section, []), {"name": "it", **element, key: value}]
    (said,) = [each for each in told(MachineRecord(**data)) if "no effect" in each]
    assert said.startswith(f"{section}.it.{key}: `{key}` has no effect without `{word}`")
