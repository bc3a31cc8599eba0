"""Outputs of a machine of rigid bodies in relative coordinates beyond what its equations need."""

from __future__ import annotations

from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.kernels.tree.tree_frames import show_tree
from nivel.kernels.tree.tree_reactions import hand_reactions, needed


@family
def complete(machine, number, t):
    """Everything of the state last evaluated that frames show and its equations did not need."""
    record = record_at(machine)
    show_tree(machine, t)
    for b in range(record.bodies.mass.shape[0]):
        needed(record.bodies, record.tree, b, record.tree.wrench[b])
    hand_reactions(machine)
    return OK
