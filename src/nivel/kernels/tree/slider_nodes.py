"""Nodes that slide along beams for the residual in relative coordinates: a slider gets its acceleration from the nodes beside it, and
these its wrench; see `nivel.kernels.tree.tree_nodes` and `nivel.kernels.tree.slider`."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import ACCELERATE, MOVE, record_at
from nivel.kernels.tree.slider import carry_slider, hand_slider, move_slider
from nivel.kernels.tree.tree_nodes import add_own_acceleration, write_efforts


@family
def pass_sliders(machine, job, t):
    """MOVE, ACCELERATE or HAND for a node that slides along a beam. Returns a status."""
    record = record_at(machine)
    tree, own = record.tree, record.residual
    count = tree.node.shape[0]
    what, n = job // count, job % count
    if what == MOVE:
        return move_slider(machine, n, own.y)
    if what == ACCELERATE:
        carry_slider(machine, n, own.acceleration)
        add_own_acceleration(tree, own, n)
    else:
        write_efforts(tree, own, n)
        hand_slider(machine, n, own.wrench)
    return OK
