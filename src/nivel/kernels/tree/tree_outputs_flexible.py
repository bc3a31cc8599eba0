"""Outputs of a machine in relative coordinates with flexible bodies beyond what its equations need."""

from __future__ import annotations

from nivel.kernels.bodies.floating_dynamics import inertia_wrench
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.kernels.tree.tree_frames import show_tree
from nivel.kernels.tree.tree_reactions import hand_reactions, needed


@family
def complete(machine, number, t):
    """Everything of the state last evaluated that frames show and its equations did not need."""
    record = record_at(machine)
    bodies, tree, own = record.bodies, record.tree, record.flexible
    show_tree(machine, t)
    for b in range(bodies.mass.shape[0]):
        if own.rigid[b] == 1:
            needed(bodies, tree, b, tree.wrench[b])
    for f in range(own.body.shape[0]):
        inertia_wrench(bodies, own, f, tree.wrench[own.body[f]])
    for v in range(bodies.mass.shape[0] + 1, tree.wrench.shape[0]):
        F, out = bodies.wrench[v], tree.wrench[v]
        for i in range(3):
            out[i], out[3 + i] = -F[3 + i], -F[i]
    hand_reactions(machine)
    return OK
