"""The nodes of a tree for the residual: joints here, others by the hooks that only some machines have.

Every node does three things: it moves its child, accelerates it, and hands its wrench on, with one row of the residual a velocity of its
own. Nodes of kinds MODAL and OUTWARD, between the frames of flexible bodies, do it in `nivel.kernels.tree.modal_nodes`, sliders on beams by
`pass_sliders`; which of them a machine has, in which order, and what hangs on what, makes no difference to any of them.
"""

import numpy as np

from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import call_hook, family
from nivel.kernels.record.record import ACCELERATE, HAND, MODES, MOVE, OUTWARD, SLIDERS, record_at
from nivel.kernels.tree.articulated import carry_motion, hand_wrench
from nivel.kernels.tree.joints import is_joint
from nivel.kernels.tree.slider import carry_slider, hand_slider, move_slider
from nivel.kernels.tree.tree import move_child
from nivel.native.function import stage


@stage
def ask_node(machine, what, n, t):
    """Let the hook of node n, which is no joint between bodies, do MOVE, ACCELERATE or HAND. Returns a status."""
    tree = record_at(machine).tree
    hook = MODES if tree.node[n, 2] <= OUTWARD else SLIDERS
    return call_hook(machine, hook, what * tree.node.shape[0] + n, t)


@stage
def add_own_acceleration(tree, own, n):
    """Add the acceleration by the joint velocities of node n to that of its child."""
    x = own.acceleration[tree.node[n, 0]]
    for k in range(np.int64(tree.node[n, 4]), np.int64(tree.node[n, 5])):
        for i in range(6):
            x[i] += own.vdot[k] * tree.column[k, i]


@stage
def write_efforts(tree, own, n):
    """The rows of the joint of node n, from the wrench of its child."""
    F = own.wrench[tree.node[n, 0]]
    for k in range(np.int64(tree.node[n, 4]), np.int64(tree.node[n, 5])):
        s = tree.column[k]
        own.value[k] = (s[0] * F[0] + s[1] * F[1] + s[2] * F[2]) + (s[3] * F[3] + s[4] * F[4] + s[5] * F[5])


@stage
def move_nodes(machine, t):
    """Poses and velocities of all bodies and frames from `residual.y`, and the columns of their motion. Returns a status."""
    record = record_at(machine)
    tree = record.tree
    for n in range(tree.node.shape[0]):
        if is_joint(tree.node[n, 2]):
            move_child(machine, record.bodies, tree, n, record.residual.y)
        else:
            status = ask_node(machine, MOVE, n, t)
            if status != OK:
                return status
    return OK


@stage
def accelerate_nodes(machine, t):
    """`residual.acceleration` of all bodies and frames, from the ground outwards."""
    record = record_at(machine)
    tree, own = record.tree, record.residual
    # less those that they have while no velocity changes ...
    for n in range(tree.node.shape[0]):
        node = tree.node[n]
        if is_joint(node[2]):
            carry_motion(own.acceleration[node[1]], tree.arm[node[0]], own.acceleration[node[0]])
            add_own_acceleration(tree, own, n)
        else:
            ask_node(machine, ACCELERATE, n, t)
    # ... and all of them
    for b in range(own.acceleration.shape[0]):
        for i in range(3):
            own.acceleration[b, i] += tree.alpha0[b, i]
            own.acceleration[b, 3 + i] += tree.Rddot0[b, i]


@stage
def hand_inwards(machine, t):
    """The rows of all velocities from `residual.wrench`, from the outermost node inwards; it becomes what the joints transmit."""
    record = record_at(machine)
    tree, own = record.tree, record.residual
    ground, count = record.bodies.mass.shape[0], tree.node.shape[0]
    for m in range(count):
        n = count - 1 - m
        node = tree.node[n]
        if not is_joint(node[2]):
            ask_node(machine, HAND, n, t)
            continue
        write_efforts(tree, own, n)
        if node[1] != ground:
            hand_wrench(own.wrench[node[0]], tree.arm[node[0]], own.wrench[node[1]])


# Nodes that slide along beams for the residual in relative coordinates: a slider gets its acceleration from the nodes beside it, and
# these its wrench; see `nivel.kernels.tree.slider`.


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
