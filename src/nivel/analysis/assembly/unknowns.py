"""Names of the unknowns of implicit methods: what moves in a joint or a body, the states of forces, the rows of constraints, the efforts
of frictions with stiction."""

from __future__ import annotations

from nivel.kernels.record.record import MODAL
from nivel.system.system import System

POSITIONS = tuple(f"{axis} of its position" for axis in "xyz")
TURNS = tuple(f"its turn about its {axis} axis" for axis in "xyz")


def unknown_name(system: System, number: int) -> str:
    """Unknown `number` of the iteration in words: a joint and its coordinate, a body and its direction, a friction, a constraint row."""
    record = system.record
    n, states = len(record.residual.vdot), len(record.newton.state)
    if number >= n + states + len(record.residual.row):
        return f"the effort of {system.frictions[record.residual.stiction[number - n - states - len(record.residual.row)]]}"
    if number >= n + states:
        return f"the constraint {system.rows[record.residual.row[number - n - states]]}"
    if number >= n:
        return f"the state {system.states[number - n].name}"
    if not len(record.tree.node):
        width = system.equations.velocities
        if number >= width * system.body_count:
            return f"the mode {system.modes[number - width * system.body_count]}"
        rates = tuple(f"its rotation coordinate {k}" for k in range(1, width - 2))
        directions = POSITIONS + (TURNS if len(system.map.turns) else rates)
        return f"{system.bodies[number // width]}, {directions[number % width]}"
    nodes = record.tree.node.tolist()
    of_node = next(node for node in nodes if node[4] <= number < node[5])
    child, _, kind, joint, first, _ = of_node
    if kind == MODAL:
        flexible = record.flexible.body.tolist().index(child)
        return f"the mode {system.modes[int(record.flexible.mode[flexible, 0]) + number - first]}"
    if joint >= len(system.joints):
        # an interface that carries its body stands for it
        body = next((node[0] for node in nodes if node[2] == MODAL and node[1] == child), child)
        return f"{system.bodies[body]}, free in space"
    name = system.tree_names[number]
    if name in system.layout.coordinates["joint_coordinate"]:
        return f"the joint {system.joints[joint]}, coordinate {name}"
    return f"the joint {system.joints[joint]}"
