"""Outputs of a machine in relative coordinates whose accelerations were found by its residual: this knows accelerations of all
bodies, and what their joints transmit."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.kernels.tree.tree_frames import show_tree
from nivel.kernels.tree.tree_reactions import multipliers_of


@family
def complete(machine, number, t):
    """Everything of the state last evaluated that frames show and its equations did not need."""
    record = record_at(machine)
    tree, own = record.tree, record.residual
    for b in range(own.acceleration.shape[0]):
        for i in range(3):
            tree.delta[b, i] = own.acceleration[b, i] - tree.alpha0[b, i]
            tree.delta[b, 3 + i] = own.acceleration[b, 3 + i] - tree.Rddot0[b, i]
        for i in range(6):
            tree.wrench[b, i] = own.wrench[b, i]
    show_tree(machine, t)
    for n in range(tree.node.shape[0]):
        multipliers_of(machine, n)
    return OK
