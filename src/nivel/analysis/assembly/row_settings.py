"""Settings of single rows of constraints, by the names of joints, couplings, drivers, bodies or rows."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeVar

from nivel.errors import Fault, refuse
from nivel.machine.settings.run import SimulationSettings
from nivel.system.system import System
from nivel.words.wording import unknown_word

Settings = TypeVar("Settings")


def of_rows(system: System, given: Mapping[str, Settings], place: str) -> dict[int, Settings]:
    """Row → its own settings; those of a row by its name go before those of its joint.

    place : of the settings, e.g. `simulation.baumgarte`. Raises ModelError with every name that no constraint has.
    """
    constrained = set(system.record.saddle.row.tolist())
    faults: list[Fault] = []
    of_joints: dict[int, Settings] = {}
    of_single: dict[int, Settings] = {}
    for name, settings in given.items():
        rows = [k for k, row in enumerate(system.rows) if name == row or row.startswith(f"{name}.")]
        if not rows:
            names = [*dict.fromkeys(row.split(".")[0] for row in system.rows), *system.rows]
            faults.append(Fault.at(f"{place}.rows.{name}", unknown_word(name, names, "constraint")))
        elif not constrained.intersection(rows):
            message = (
                f"`{name}` is no constraint in relative coordinates: it carries a body of the tree; write `coordinates: absolute`, or "
                f"`cut: [{name.split('.')[0]}]`"
            )
            faults.append(Fault.at(f"{place}.rows.{name}", message))
        (of_single if "." in name else of_joints).update(dict.fromkeys(rows, settings))
    refuse(faults)
    return {**of_joints, **of_single}


def refuse_unknown_rows(system: System, settings: SimulationSettings, *, penalised: bool) -> None:
    """Refuse names of the settings in use that no constraint has."""
    if penalised:
        of_rows(system, settings.penalty.rows, "simulation.penalty")
    if settings.stabilisation == "baumgarte" and settings.baumgarte is not None:
        of_rows(system, settings.baumgarte.rows, "simulation.baumgarte")
