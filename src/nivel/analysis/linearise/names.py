"""Names and units of the velocities of a machine: joint coordinates where there are any, else bodies with their axes."""

from __future__ import annotations

from nivel.system.system import System

UNITS = {"m": "m", "1": "rad", "kg^0.5 m": "kg^0.5 m"}


def velocity_names(system: System) -> list[tuple[str, str]]:
    """(name, unit of the position) of every velocity, e.g. `hinge.angle` or `rod.turn_x`; turns are about axes of the body. A name of a
    joint coordinate of the results stands only where its rate is the velocity, or minus that."""
    place = system.record.newton.place
    units = [UNITS.get(system.map.units[int(p)], "") for p, _ in place]
    if system.tree_names:
        return list(zip(system.tree_names, units, strict=True))
    names: list[str] = []
    for body in system.bodies:
        names += [f"{body}.{axis}" for axis in "xyz"] + [f"{body}.turn_{axis}" for axis in "xyz"]
    return list(zip([*names, *system.modes][: len(place)], units, strict=True))
