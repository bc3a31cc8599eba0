"""Outputs of a machine in relative coordinates beyond what its equations need: of rigid bodies, then of others."""

from nivel.kernels.bodies.floating_dynamics import inertia_wrench
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import family
from nivel.kernels.record.record import record_at
from nivel.kernels.tree.tree_frames import show_tree
from nivel.kernels.tree.tree_reactions import hand_reactions, multipliers_of, needed


@family
def complete(machine, number, t):
    """Everything of the state last evaluated that frames show and its equations did not need."""
    record = record_at(machine)
    show_tree(machine, t)
    for b in range(record.bodies.mass.shape[0]):
        needed(record.bodies, record.tree, b, record.tree.wrench[b])
    hand_reactions(machine)
    return OK


# Outputs of a machine in relative coordinates whose accelerations were found by its residual: this knows accelerations of all
# bodies, and what their joints transmit.


@family
def complete_implicit(machine, number, t):
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


@family
def complete_flexible(machine, number, t):
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
