"""What the report plots: panels, each with groups of curves of one unit to choose from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from nivel.report.peaks import NEGLIGIBLE, negligible
from nivel.results.scales import bodies, rotated
from nivel.results.verdicts import THRESHOLDS

if TYPE_CHECKING:
    from nivel.results.result import Result

Array = NDArray[np.float64]

GROUPS = 24  # elements of a panel that can be chosen; more stand in the result file
TOGETHER = 8  # curves that can be told apart in one plot


@dataclass(frozen=True)
class Curve:
    """One curve (n,); `tone` is the place of its colour, "x", "y", "z" or a number."""

    label: str
    values: Array
    tone: str


@dataclass(frozen=True)
class Group:
    """Curves of one unit.

    limits : (value, colour word) of lines that the curves are held against.
    floor : the least height of the plot, in its unit: what is smaller is round-off and drawn flat.
    """

    label: str
    unit: str
    curves: tuple[Curve, ...]
    limits: tuple[tuple[float, str], ...] = ()
    floor: float = 0.0


@dataclass(frozen=True)
class Panel:
    """A plot; with several groups the reader chooses one."""

    title: str
    groups: tuple[Group, ...]
    log: bool = False
    note: str = ""


def panels(result: Result) -> list[Panel]:
    """All panels of a result that have anything to show."""
    found = [
        _joint_coordinates(result),
        _positions(result),
        _energies(result),
        _energy_error(result),
        _reactions(result, "joint_force", "Joint forces", "force"),
        _reactions(result, "joint_torque", "Joint torques", "torque"),
        _applied(result),
        _violations(result),
    ]
    return [panel for panel in found if panel is not None and panel.groups]


def _joint_coordinates(result: Result) -> Panel | None:
    if "joint_coordinate" not in result.variables:
        return None
    names = result.coordinates[result.variables["joint_coordinate"].dims[1]]
    groups, most = [], 0
    for variable, words in (
        ("joint_coordinate", {"rad": "angles", "m": "displacements"}),
        ("joint_rate", {"rad/s": "angular rates", "m/s": "rates"}),
    ):
        values = result.array(variable)
        suffix = "" if variable == "joint_coordinate" else ".rate"
        units = [result.units(f"{name}{suffix}") for name in names]
        for unit, word in words.items():
            chosen = [k for k, own in enumerate(units) if own == unit]
            most, chosen = max(most, len(chosen)), chosen[: 2 * TOGETHER]
            curves = tuple(Curve(names[k], values[:, k], str(i)) for i, k in enumerate(chosen))
            if curves:
                groups.append(Group(word, unit, curves))
    return Panel("Joint coordinates", tuple(groups), note=_left_out(most, 2 * TOGETHER))


def _positions(result: Result) -> Panel | None:
    """Body origins; where one rests, the centre of mass of its body; bodies that rest altogether are left out."""
    if "position" not in result.variables:
        return None
    position, orientation = result.array("position"), result.array("orientation")
    floor = NEGLIGIBLE * result.trust.size
    groups = []
    for k, body in enumerate(bodies(result)):
        name, values = result.coordinates["body"][k], position[:, k]
        if not _moves(values, floor):
            name = f"{name}, centre of mass"
            values = values + rotated(orientation[:, k], np.array(body.get("centre_of_mass", [0.0, 0.0, 0.0])))
        if _moves(values, floor):
            groups.append(Group(name, "m", tuple(_components(values)), floor=floor))
    return Panel("Body positions", tuple(groups[:GROUPS]), note=_left_out(len(groups)))


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
    return Panel("Energy error", (Group("", "J", (Curve("energy error", result.array("energy_error"), "0"),)),))


def _reactions(result: Result, variable: str, title: str, word: str) -> Panel | None:
    """Magnitudes of the joints with the largest ones, then the components of each joint."""
    if variable not in result.variables:
        return None
    values, names, units = result.array(variable), result.coordinates["joint"], result.variables[variable].units
    magnitude = np.linalg.norm(values, axis=-1)
    peaks = np.max(np.nan_to_num(magnitude, nan=0.0, posinf=0.0), axis=0, initial=0.0)
    floor = negligible(result)[variable]
    if not np.any(peaks > floor):
        return None
    order = np.argsort(-peaks, kind="stable")[:TOGETHER]
    largest = tuple(Curve(names[k], magnitude[:, k], str(i)) for i, k in enumerate(sorted(order)))
    groups = [Group(_which(len(names)), units, largest, floor=floor)]
    for k, name in enumerate(names[:GROUPS]):
        curves = (Curve(word, magnitude[:, k], "0"), *_components(values[:, k]))
        groups.append(Group(name, units, curves, floor=floor))
    return Panel(title, tuple(groups), note=_left_out(len(names)))


def _applied(result: Result) -> Panel | None:
    groups = []
    for quantity, word in (("power", "power"), ("magnitude", "magnitude")):
        by_unit: dict[str, list[Curve]] = {}
        for name, variable in result.variables.items():
            if name.startswith("force.") and name.endswith(f".{quantity}"):
                curves = by_unit.setdefault(variable.units, [])
                label = name.removeprefix("force.").removesuffix(f".{quantity}")
                curves.append(Curve(label, result.array(name), str(len(curves))))
        groups += [Group(f"{word}, {units}", units, tuple(curves[: 2 * TOGETHER])) for units, curves in by_unit.items()]
    return Panel("Applied forces", tuple(groups)) if groups else None


def _violations(result: Result) -> Panel | None:
    """The largest violation of each joint, apart for lengths and cosines, at position and at velocity level."""
    groups = []
    trust = result.trust
    position, rate = THRESHOLDS["violation"], THRESHOLDS["rate_violation"]
    for variable, suffix, level, threshold, scales in (
        ("constraint_violation", "violation", "", position, {"m": trust.size, "1": 1.0}),
        (
            "constraint_rate_violation",
            "rate_violation",
            " rates",
            rate,
            {"m/s": trust.speed, "1/s": trust.speed / trust.size},
        ),
    ):
        if variable not in result.variables:
            continue
        rows = result.coordinates[result.variables[variable].dims[1]]
        units = np.array([result.units(f"{row}.{suffix}") or next(iter(scales)) for row in rows])
        owners = np.array([row.split(".", maxsplit=1)[0] for row in rows])
        values = np.abs(result.array(variable))
        for (unit, scale), word in zip(scales.items(), ("gaps", "misalignments"), strict=True):
            here = [owner for owner in dict.fromkeys(owners.tolist()) if np.any((owners == owner) & (units == unit))]
            worst = [np.max(values[:, (owners == owner) & (units == unit)], axis=1) for owner in here]
            order = sorted(range(len(here)), key=lambda k: -np.nanmax(worst[k], initial=0.0))[:TOGETHER]
            curves = tuple(Curve(here[k], worst[k], str(i)) for i, k in enumerate(sorted(order)))
            if curves:
                limits = ((threshold.green * scale, "green"), (threshold.amber * scale, "amber"))
                groups.append(Group(f"{word}{level}", unit, curves, limits))
    note = f"the {TOGETHER} worst joints are shown" if len(result.coordinates.get("joint", ())) > TOGETHER else ""
    return Panel("Constraint violations", tuple(groups), log=True, note=note) if groups else None


def _left_out(count: int, shown: int = GROUPS) -> str:
    return f"{count - shown} more in the result file" if count > shown else ""


def _which(count: int) -> str:
    return "all, magnitude" if count <= TOGETHER else f"the {TOGETHER} largest, magnitude"


def _components(values: Array) -> Iterator[Curve]:
    """x, y, z of a vector (n, 3)."""
    for k, name in enumerate("xyz"):
        yield Curve(name, values[:, k], name)
