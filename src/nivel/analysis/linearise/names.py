"""Names and units of the velocities of a machine: joint coordinates where there are any, else bodies with their axes."""

from __future__ import annotations

from nivel.kernels.record.record import MODAL, NONE
from nivel.system.system import System

UNITS = {"m": "m", "1": "rad", "kg^0.5 m": "kg^0.5 m"}


def velocity_names(system: System) -> list[tuple[str, str]]:
    """(name, unit of the position) of every velocity, e.g. `hinge.angle` or `rod.turn_x`; turns are about axes of the body."""
    record = system.record
    place = record.newton.place
    units = [UNITS.get(system.map.units[int(p)], "") for p, _ in place]
    if len(record.tree.node):
        return list(zip(_of_tree(system), units, strict=True))
    names: list[str] = []
    for body in system.bodies:
        names += [f"{body}.{axis}" for axis in "xyz"] + [f"{body}.turn_{axis}" for axis in "xyz"]
    return list(zip([*names, *system.modes][: len(place)], units, strict=True))


def _of_tree(system: System) -> list[str]:
    record = system.record
    place, out = record.newton.place, [""] * len(record.newton.place)
    known = system.layout.coordinates["joint_coordinate"]
    nodes = record.tree.node.tolist()
    # an interface that carries its body stands for it
    bodies = {node[1]: node[0] for node in nodes if node[2] == MODAL}
    for child, _, kind, joint, first, last in nodes:
        if first == last:
            continue
        if kind == MODAL:
            flexible = record.flexible.body.tolist().index(child)
            mode = int(record.flexible.mode[flexible, 0])
            out[first:last] = system.modes[mode : mode + last - first]
            continue
        owner = system.joints[joint] if joint < len(system.joints) else system.bodies[bodies.get(child, child)]
        own = [name for name in known if joint < len(system.joints) and name.startswith(f"{owner}.")]
        if len(own) == last - first:
            out[first:last] = own
            continue
        shifts = iter("xyz")
        for k in range(first, last):
            axis = int(place[k, 1])
            out[k] = f"{owner}.{next(shifts)}" if axis == NONE else f"{owner}.turn_{'xyz'[axis]}"
    return out
