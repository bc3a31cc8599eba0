"""What a frame shows of a machine in relative coordinates whose accelerations were found by its residual; see `nivel.kernels.carried`."""

from __future__ import annotations

from nivel.kernels.carried import count_turns, multipliers_of, orient, show_frames
from nivel.kernels.constraint import combine, constraint_rows
from nivel.kernels.hook import family
from nivel.kernels.marker import move_markers, place_markers
from nivel.kernels.record import record_at
from nivel.kernels.status import OK


@family
def complete(machine, number, t):
    """Everything of the state last evaluated that frames show and its equations did not need: the residual knows accelerations of bodies
    and what their joints transmit."""
    record = record_at(machine)
    bodies, tree, own = record.bodies, record.tree, record.residual
    for b in range(bodies.mass.shape[0]):
        for i in range(3):
            tree.delta[b, i] = own.acceleration[b, i] - tree.alpha0[b, i]
            tree.delta[b, 3 + i] = own.acceleration[b, 3 + i] - tree.Rddot0[b, i]
        for i in range(6):
            tree.wrench[b, i] = own.wrench[b, i]
    orient(machine)
    show_frames(machine)
    count_turns(record.coordinates, tree)
    place_markers(bodies, record.markers)
    move_markers(bodies, record.markers)
    constraint_rows(bodies, record.markers, tree.rows)
    combine(machine, tree.rows, record.coordinates, record.friction, t)
    for m in range(tree.node.shape[0]):
        multipliers_of(machine, tree.node.shape[0] - 1 - m)
    return OK
