"""Plots of the report, in the order of the story: motion, energy, what acts, what the joints carry, what is left open."""

from collections.abc import Iterator

import numpy as np

from nivel.judge.after.checks import joints
from nivel.known import Result
from nivel.lazy import Struct
from nivel.report.deflections import beam_nodes, stations
from nivel.report.element_panels import control, couplings, drivers, forces, sensors
from nivel.report.panel import GROUPS, MOST, TOGETHER, Array, Curve, Group, Panel, components, left_out
from nivel.results.scales import blocks, bodies, rotated

NEGLIGIBLE = 1e-9  # of the largest reaction in the machine, a torque counted as a force at its size: round-off


class PeakReaction(Struct):
    """Largest force [N] and torque [N m] between the bodies of a joint, with their times [s]; 0 where negligible.

    unique : False where redundant constraints share the load in more than one way.
    """

    joint: str
    kind: str
    force: float
    force_time: float
    torque: float
    torque_time: float
    unique: bool = True


def peak_reactions(result: Result) -> list[PeakReaction]:
    """One line per joint that constrains something, in the order of the machine."""
    if "joint_force" not in result.variables or not len(result.time):
        return []
    kinds = {joint["name"]: joint["type"] for joint in result.scene.get("joints", [])}
    shaky = set(result.trust.non_unique_joints)
    floors = negligible(result)
    force, torque = (
        [(value, time) if value > floors[variable] else (0.0, 0.0) for value, time in _peaks(result, variable)]
        for variable in ("joint_force", "joint_torque")
    )
    return [
        PeakReaction(name, kinds.get(name, ""), *force[k], *torque[k], name not in shaky)
        for k, name in enumerate(result.coordinates["joint"])
        if kinds.get(name) != "variable-distance"
    ]


def negligible(result: Result) -> dict[str, float]:
    """The force [N] and torque [N m] below which a reaction is round-off."""
    size = result.trust.size
    force, torque = (max((v for v, _ in _peaks(result, name)), default=0.0) for name in ("joint_force", "joint_torque"))
    largest = max(force, torque / size)
    return {"joint_force": NEGLIGIBLE * largest, "joint_torque": NEGLIGIBLE * largest * size}


def _peaks(result: Result, variable: str) -> list[tuple[float, float]]:
    """(largest magnitude, its time) of each joint; what is not a number is passed over."""
    best = np.full(len(result.coordinates["joint"]), -1.0)
    times = np.zeros(len(best))
    for frames in blocks(result):
        magnitude = np.linalg.norm(result.array(variable, frames), axis=-1)
        magnitude = np.where(np.isfinite(magnitude), magnitude, -1.0)
        k = np.argmax(magnitude, axis=0)
        largest = magnitude[k, np.arange(len(best))]
        times = np.where(largest > best, result.time[frames][k], times)
        best = np.maximum(best, largest)
    return [(float(value), float(time)) for value, time in zip(np.maximum(best, 0.0), times, strict=True)]


START = "hydraulics."
# how the last word of a name begins → heading, unit shown, SI value of it
KINDS = {
    "pressure": ("pressures", "bar", 1e5),
    "temperature": ("temperatures of gas", "K", 1.0),
    "flow": ("flows", "L/min", 1e-3 / 60.0),
    "position": ("positions", "", 1.0),
    "force": ("forces of actuators", "N", 1.0),
    "torque": ("torques of shafts", "N m", 1.0),
}


def circuits(result: Result) -> Panel | None:
    """All outputs of one kind together; in several plots where they are too many to be told apart."""
    groups = [group for kind in KINDS for group in _groups(result, kind)]
    return Panel("Hydraulics", tuple(groups[:GROUPS]), note=left_out(len(groups))) if groups else None


def _groups(result: Result, kind: str) -> Iterator[Group]:
    words, unit, factor = KINDS[kind]
    by_unit: dict[str, list[str]] = {}
    for name in result.variables:
        if name.startswith(START) and name.rpartition(".")[2].startswith(kind):
            by_unit.setdefault(result.variables[name].units or "1", []).append(name)
    for units, names in by_unit.items():
        shown = unit or units
        parts = [names[k : k + MOST] for k in range(0, len(names), MOST)]
        for k, part in enumerate(parts):
            label = f"{words}, {shown}".removesuffix(", 1")
            label += f" ({k + 1} of {len(parts)})" if len(parts) > 1 else ""
            values = [(name.removeprefix(START), result.array(name) / factor) for name in part]
            yield Group(label, shown, tuple(Curve(*each, str(place)) for place, each in enumerate(values)))


# radians are counted as cosines are
UNITLESS = {"rad": "1", "rad/s": "1/s"}
ROUND_OFF = 1e-12  # of the largest energy: the round-off of an energy balance


def panels(result: Result) -> list[Panel]:
    """All panels of a result that have anything to show."""
    floors = _floors(result)
    found = [
        _joint_coordinates(result),
        _positions(result),
        sensors(result, floors),
        control(result),
        circuits(result),
        _energies(result),
        _energy_error(result),
        drivers(result, floors),
        couplings(result, floors),
        forces(result, floors),
        _reactions(result, "joint_force", "Joint forces", "force", floors["N"]),
        _reactions(result, "joint_torque", "Joint torques", "torque", floors["N m"]),
        _violations(result),
    ]
    if (iterations := result.iterations) is not None:  # of implicit methods, between each frame and the one before
        mean, most = iterations.at(result.time)
        found.append(
            Panel("Iterations per step", (Group("", "1", (Curve("mean", mean, "0"), Curve("most", most, "1"))),))
        )
    return [panel for panel in found if panel is not None and panel.groups]


def _floors(result: Result) -> dict[str, float]:
    """Unit → what is smaller is round-off."""
    trust = result.trust
    floors = {"m": trust.size, "m/s": trust.speed, "rad": 1.0, "rad/s": trust.speed / trust.size}
    floors = {unit: NEGLIGIBLE * scale for unit, scale in floors.items()}
    least = negligible(result) if {"joint_force", "joint_torque"} <= result.variables.keys() else {}
    return {**floors, "N": least.get("joint_force", 0.0), "N m": least.get("joint_torque", 0.0)}


def _joint_coordinates(result: Result) -> Panel | None:
    if "joint_coordinate" not in result.variables:
        return None
    names = result.coordinates[result.variables["joint_coordinate"].dims[1]]
    groups, most = [], 0
    for variable, words in (
        ("joint_coordinate", {"rad": "angles", "m": "displacements"}),
        ("joint_rate", {"rad/s": "angular rates", "m/s": "rates"}),
    ):
        if variable not in result.variables:
            continue
        values = result.array(variable)
        suffix = "" if variable == "joint_coordinate" else ".rate"
        units = [result.units(f"{name}{suffix}") for name in names]
        for unit, word in words.items():
            chosen = [k for k, own in enumerate(units) if own == unit]
            most, chosen = max(most, len(chosen)), chosen[:MOST]
            curves = tuple(Curve(names[k], values[:, k], str(i)) for i, k in enumerate(chosen))
            if curves:
                groups.append(Group(word, unit, curves))
    return Panel("Joint coordinates", tuple(groups), note=left_out(most, MOST))


def _positions(result: Result) -> Panel | None:
    """Body origins and stations of beams; where one rests, the centre of mass of its body; bodies that rest altogether are left out."""
    if "position" not in result.variables:
        return None
    position, orientation = result.array("position"), result.array("orientation")
    floor = NEGLIGIBLE * result.trust.size
    nodes = beam_nodes(result)
    named = {name for beam in nodes for name in stations(result, beam)}
    shown = named | {name for name in result.coordinates["body"] if name.partition(".")[0] not in nodes}
    groups = []
    for k, body in enumerate(bodies(result)):
        name, values = result.coordinates["body"][k], position[:, k]
        if name not in shown:
            continue
        if not _moves(values, floor):
            name = f"{name}, centre of mass"
            values = values + rotated(orientation[:, k], np.array(body.get("centre_of_mass", [0.0, 0.0, 0.0])))
        if _moves(values, floor):
            groups.append(Group(name, "m", tuple(components(values)), floor=floor))
    return Panel("Body positions", tuple(groups[:GROUPS]), note=left_out(len(groups)))


def _moves(values: Array, floor: float) -> bool:
    """Whether any component (n, 3) changes by more than `floor` in the frames that are numbers."""
    known = values[np.isfinite(values).all(axis=1)]
    return len(known) > 0 and float(np.ptp(known, axis=0).max()) > floor


def _energies(result: Result) -> Panel | None:
    words = {
        "kinetic_energy": "kinetic",
        "potential_energy": "potential",
        "external_work": "work of forces",
        "dissipated_energy": "dissipated",
    }
    present = [(name, word) for name, word in words.items() if name in result.variables]
    curves = tuple(Curve(word, result.array(name), str(i)) for i, (name, word) in enumerate(present))
    shown = tuple(curve for curve in curves if curve.label != "dissipated" or np.any(curve.values != 0.0))
    return Panel("Energies", (Group("", "J", shown),)) if shown else None


def _energy_error(result: Result) -> Panel | None:
    if "energy_error" not in result.variables:
        return None
    floor = ROUND_OFF * max(_largest(result, name) for name in ("kinetic_energy", "potential_energy", "external_work"))
    curve = Curve("energy error", result.array("energy_error"), "0")
    return Panel("Energy error", (Group("", "J", (curve,), floor=floor),))


def _largest(result: Result, name: str) -> float:
    """The largest magnitude of a variable of the result; 0 where there is none."""
    return float(np.nanmax(np.abs(result.array(name)), initial=0.0)) if name in result.variables else 0.0


def _reactions(result: Result, variable: str, title: str, word: str, floor: float) -> Panel | None:
    """Magnitudes of the joints with the largest ones, then the components of each joint."""
    if variable not in result.variables:
        return None
    values, names, units = result.array(variable), result.coordinates["joint"], result.variables[variable].units
    magnitude = np.linalg.norm(values, axis=-1)
    peaks = np.max(np.nan_to_num(magnitude, nan=0.0, posinf=0.0), axis=0, initial=0.0)
    if not np.any(peaks > floor):
        return None
    order = np.argsort(-peaks, kind="stable")[:TOGETHER]
    largest = tuple(Curve(names[k], magnitude[:, k], str(i)) for i, k in enumerate(sorted(order)))
    label = "all, magnitude" if len(names) <= TOGETHER else f"the {TOGETHER} largest, magnitude"
    groups = [Group(label, units, largest, floor=floor)]
    for k, name in enumerate(names[:GROUPS]):
        curves = (Curve(word, magnitude[:, k], "0"), *components(values[:, k]))
        groups.append(Group(name, units, curves, floor=floor))
    return Panel(title, tuple(groups), note=left_out(len(names)))


def _violations(result: Result) -> Panel | None:
    """The largest violation of each joint, apart for lengths and cosines, at position and at velocity level."""
    groups = []
    trust = result.trust
    for suffix, level, threshold, scales in (
        ("violation", "", joints.OPENING, {"m": trust.size, "1": 1.0}),
        ("rate_violation", " rates", joints.RATES, {"m/s": trust.speed, "1/s": trust.speed / trust.size}),
    ):
        variable = f"constraint_{suffix}"
        if variable not in result.variables:
            continue
        rows = result.coordinates[result.variables[variable].dims[1]]
        own = [result.units(f"{row}.{suffix}") or next(iter(scales)) for row in rows]
        values = np.abs(result.array(variable))
        for (unit, scale), word in zip(scales.items(), ("gaps", "misalignments"), strict=True):
            of_joint: dict[str, list[int]] = {}
            for k, row in enumerate(rows):
                if UNITLESS.get(own[k], own[k]) == unit:
                    of_joint.setdefault(row.split(".", maxsplit=1)[0], []).append(k)
            here = list(of_joint)
            worst = [np.max(values[:, of_joint[owner]], axis=1) for owner in here]
            order = sorted(range(len(here)), key=lambda k: -np.nanmax(worst[k], initial=0.0))[:TOGETHER]
            curves = tuple(Curve(here[k], worst[k], str(i)) for i, k in enumerate(sorted(order)))
            if curves:
                limits = ((threshold.green * scale, "green"), (threshold.amber * scale, "amber"))
                groups.append(Group(f"{word}{level}", unit, curves, limits))
    note = f"the {TOGETHER} worst joints are shown" if len(result.coordinates.get("joint", ())) > TOGETHER else ""
    return Panel("Constraint violations", tuple(groups), log=True, note=note) if groups else None
