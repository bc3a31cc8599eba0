"""Panels of the elements whose numbers are named one by one: drivers, couplings, forces, sensors."""

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from typing import Any, Final

import numpy as np

from nivel.known import ComponentBalance, PowerFlow
from nivel.lazy import nivel
from nivel.report.panel import GROUPS, MOST, Curve, Group, Panel, left_out
from nivel.results.result import Result

# output of forces → what it is called; in the order in which they are offered
FORCE_WORDS = {
    "magnitude": "magnitude",
    "power": "power",
    "speed": "speeds of shafts",
    "torque": "torques of shafts",
    "current": "currents",
    "voltage": "voltages",
    "electrical_power": "electrical power",
    "loss": "losses",
    "length": "lengths",
    "angle": "angles",
    "rate": "rates",
    "depth": "depths, negative while apart",
    "normal_force": "normal forces",
    "friction_work": "heat of friction",
    "normal_load": "normal loads",
    "bristle": "deflections of bristles",
}
SENSOR_WORDS = {
    "m": "lengths",
    "m/s": "speeds",
    "m/s^2": "accelerations",
    "rad": "angles",
    "rad/s": "angular rates",
    "rad/s^2": "angular accelerations",
    "N": "forces",
    "N m": "torques",
    "W": "power",
    "J": "energies",
    "1": "numbers",
}


def drivers(result: Result, floors: Mapping[str, float]) -> Panel | None:
    """Efforts of drivers by unit, then their power."""
    return _panel(result, "Drivers", "driver", {"effort": "effort", "power": "power into the machine"}, floors)


def couplings(result: Result, floors: Mapping[str, float]) -> Panel | None:
    """Efforts of couplings by unit."""
    return _panel(result, "Couplings", "coupling", {"effort": "effort on the first coordinate"}, floors)


def forces(result: Result, floors: Mapping[str, float]) -> Panel | None:
    """Magnitudes of forces by unit, their power, what they measure, and the components of bushings.

    What a force on a joint coordinate measures is the joint coordinate, which has a panel of its own.
    """
    on_coordinate = {name for name, output in _outputs(result, "force") if output == "value"}
    plain = _panel(result, "Applied forces", "force", FORCE_WORDS, floors, {"rate": on_coordinate})
    vectors = list(_force_vectors(result, floors))
    groups = (*(plain.groups if plain else ()), *vectors[:GROUPS])
    note = "; ".join(each for each in (plain.note if plain else "", left_out(len(vectors))) if each)
    return Panel("Applied forces", groups, note=note) if groups else None


def sensors(result: Result, floors: Mapping[str, float]) -> Panel | None:
    """All sensors of one unit together; in several plots where they are too many to be told apart."""
    by_unit: dict[str, list[list[str]]] = {}  # unit → sensors, each with the names of its curves
    for sensor, outputs in _by_element(result, "sensor").items():
        if outputs == ["x", "y", "z"]:
            by_unit.setdefault(_unit(result, f"sensor.{sensor}.x"), []).append([f"{sensor}.{axis}" for axis in "xyz"])
            continue
        for output in outputs:
            name = f"{sensor}.{output}" if output else sensor
            by_unit.setdefault(_unit(result, f"sensor.{name}"), []).append([name])
    groups = []
    for unit, found in by_unit.items():
        parts = list(_in_parts(found))
        word = f"{SENSOR_WORDS[unit]}, {unit}".removesuffix(", 1") if unit in SENSOR_WORDS else unit
        for k, part in enumerate(parts):
            label = f"{word} ({k + 1} of {len(parts)})" if len(parts) > 1 else word
            groups.append(Group(label, unit, tuple(_sensor_curves(result, part)), floor=floors.get(unit, 0.0)))
    return Panel("Sensors", tuple(groups[:GROUPS]), note=left_out(len(groups))) if groups else None


def _sensor_curves(result: Result, chosen: list[list[str]]) -> Iterator[Curve]:
    """Curves of these sensors; the axes of a vector have their own colours where it is the only one."""
    alone = sum(len(names) == 3 for names in chosen) == 1
    count = 3 if alone else 0  # colours that differ from those of the axes
    for names in chosen:
        for name in names:
            axis = len(names) == 3 and alone
            yield Curve(name, result.array(f"sensor.{name}"), name[-1] if axis else str(count))
            count += not axis


def _in_parts(sensors: list[list[str]]) -> Iterator[list[list[str]]]:
    """Sensors in parts of at most MOST curves."""
    part: list[list[str]] = []
    for names in sensors:
        if sum(map(len, part)) + len(names) > MOST:
            yield part
            part = []
        part.append(names)
    yield part


def _panel(
    result: Result,
    title: str,
    section: str,
    words: Mapping[str, str],
    floors: Mapping[str, float],
    without: Mapping[str, set[str]] | None = None,
) -> Panel | None:
    """Outputs of all elements of a section: a group for every output and unit.

    without : output → elements whose output of this name is left out.
    """
    groups, most = [], 0
    found = list(_outputs(result, section))
    for output, word in words.items():
        by_unit: dict[str, list[str]] = {}
        for element, own in found:
            if own == output and element not in (without or {}).get(output, ()):
                by_unit.setdefault(_unit(result, f"{section}.{element}.{output}"), []).append(element)
        for unit, elements in by_unit.items():
            most = max(most, len(elements))
            values = [(name, result.array(f"{section}.{name}.{output}")) for name in elements[:MOST]]
            curves = tuple(Curve(name, each, str(k)) for k, (name, each) in enumerate(values))
            groups.append(Group(f"{word}, {unit}", unit, curves, floor=floors.get(unit, 0.0)))
    return Panel(title, tuple(groups), note=left_out(most, MOST)) if groups else None


def _force_vectors(result: Result, floors: Mapping[str, float]) -> Iterator[Group]:
    """x, y, z of the forces and torques of elements that have them."""
    for element, outputs in _by_element(result, "force").items():
        for word in ("force", "torque"):
            names = [f"{word}_{axis}" for axis in "xyz"]
            if set(names) <= set(outputs):
                full = [f"force.{element}.{name}" for name in names]
                unit = _unit(result, full[0])
                curves = tuple(Curve(axis, result.array(name), axis) for axis, name in zip("xyz", full, strict=True))
                yield Group(f"{element}, {word}", unit, curves, floor=floors.get(unit, 0.0))


def _by_element(result: Result, section: str) -> dict[str, list[str]]:
    """Element → its outputs, in the order of the result."""
    found: dict[str, list[str]] = {}
    for element, output in _outputs(result, section):
        found.setdefault(element, []).append(output)
    return found


def _outputs(result: Result, section: str) -> Iterator[tuple[str, str]]:
    """(element, output) of all variables `SECTION.ELEMENT.OUTPUT`; the output is empty in `SECTION.ELEMENT`."""
    for name in result.variables:
        start, _, rest = name.partition(".")
        if start == section:
            # the motions of a pose that is driven, `lift.x`, have efforts of their own
            element, _, output = rest.rpartition(".") if section == "driver" else rest.partition(".")
            yield element, output


def _unit(result: Result, name: str) -> str:
    return result.variables[name].units or "1"


TOTALS = ("supplied", "lost", "delivered")


def power_picture(result: Result, record: Mapping[str, Any], balances: Sequence[ComponentBalance]) -> str:
    """SVG of the power flow over the run; empty without a circuit through which energy flows."""
    flow = circuit_power(result, record, balances)
    return "" if flow is None else nivel.looks.circuit.power_flow.power_diagram(flow)


def circuit_power(result: Result, record: Mapping[str, Any], balances: Sequence[ComponentBalance]) -> PowerFlow | None:
    """What goes into the circuit of a run and comes out of it; None without a circuit, and for a run without a duration."""
    names = {each: f"state.hydraulics.{each}" for each in TOTALS} | {"stored": "hydraulics.stored"}
    if len(result.time) < 2 or any(name not in result.variables for name in names.values()):
        return None
    ends = {key: np.ravel(result.array(name)) for key, name in names.items()}
    totals = {key: float(values[-1] - values[0]) for key, values in ends.items()}
    if not np.all(np.isfinite(list(totals.values()))):
        return None
    components = record.get("hydraulics") or ()
    engines = {str(each["name"]): str(each["engine"]) for each in components if each.get("engine")}
    duration = float(result.time[-1] - result.time[0])
    return nivel.looks.circuit.power_flow.power_flow([asdict(each) for each in balances], totals, engines, duration)


# parts of blocks that stand in the result file only
INNER: Final = re.compile(r"(waiting|queued|guard|x)_?\d+|before|computed|entered|next|slope|.+_\d+")


def control(result: Result) -> Panel | None:
    """Values by unit, and of each block its value with its inputs and parts."""
    blocks: dict[str, list[str]] = {}
    for name in result.variables:
        section, _, rest = name.partition(".")
        block, _, part = rest.partition(".")
        if section == "control" and (not part or not INNER.fullmatch(part)):
            blocks.setdefault(block, []).append(part)
    if not blocks:
        return None
    groups = [*_block_values(result, blocks), *_of_each(result, blocks)]
    return Panel("Control", tuple(groups[:GROUPS]), note=left_out(len(groups)))


def _block_values(result: Result, blocks: dict[str, list[str]]) -> Iterator[Group]:
    by_unit: dict[str, list[str]] = {}
    for block in blocks:
        by_unit.setdefault(result.variables[f"control.{block}"].units or "1", []).append(block)
    for unit, names in by_unit.items():
        curves = tuple(Curve(name, result.array(f"control.{name}"), str(k)) for k, name in enumerate(names[:MOST]))
        label = "values" if unit == "1" else f"values, {unit}"
        yield Group(label, "" if unit == "1" else unit, curves)


def _of_each(result: Result, blocks: dict[str, list[str]]) -> Iterator[Group]:
    for block, parts in blocks.items():
        names = {part or "value": f"control.{block}.{part}" if part else f"control.{block}" for part in parts}
        if len(names) > 1:
            curves = tuple(Curve(part, result.array(name), str(k)) for k, (part, name) in enumerate(names.items()))
            yield Group(block, "", curves[:MOST])
