"""Relative coordinates: joint coordinates of a spanning tree, loops closed by the constraints of the joints that are cut.

q = joint coordinates (Euler parameters of spherical and free joints), v = joint velocities. The mass matrix is factorised by the
articulated-body recursion, which gives W and z; multipliers of the cut joints follow as in all other coordinates.
"""

from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces, call_hook, family
from nivel.kernels.record.record import CORRECT, EVALUATE, LOAD, MODES, NEED, POINTS, record_at
from nivel.kernels.residual.residual import inertial_wrenches, load_multipliers, write_rows
from nivel.kernels.solve.saddle import factorise_rows
from nivel.kernels.tree.articulated import accelerate, factorise_tree, whiten_efforts, whiten_tree_rows
from nivel.kernels.tree.flexible_tree import clear_frames
from nivel.kernels.tree.tree import move_tree
from nivel.kernels.tree.tree_nodes import accelerate_nodes, hand_inwards, move_nodes
from nivel.motion.tree_motion import WIDTH, correct_tree, evaluate_tree, move_coordinates, normalise, read_markers
from nivel.native.entry import entry
from nivel.native.function import stage


@stage
def read_state(machine, t, y):
    """Poses and velocities of bodies and of the markers in use, and the rows that are left. Returns a status."""
    move_tree(machine, y)
    return read_markers(machine, t)


@stage
def load_tree(machine, t, y):
    """All applied forces on bodies. Returns a status."""
    load_weight(record_at(machine).bodies)
    return apply_forces(machine, t, y)


@stage
def factorise(machine, y):
    """Factors of the mass matrix and of S = W Wᵀ in the state last read; y is not needed for them here. Returns a status."""
    record = record_at(machine)
    factorise_tree(record.bodies, record.tree)
    if record.saddle.block.shape[0] == 0:
        return OK
    whiten_tree_rows(machine)
    return factorise_rows(machine, WIDTH)


@stage
def apply_change(machine, y, what):
    """Apply the change found to the positions, or to the velocities."""
    accelerate(machine, record_at(machine).tree.change)
    move_coordinates(machine, y, what)


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ. Leaves everything else in the record but what `nivel.kernels.tree.tree_outputs` adds for frames."""
    return evaluate_tree(machine, t, y, ydot, read_state, load_tree, factorise, whiten_efforts, accelerate)


@entry(CORRECT)
def normalise_state(machine, t, y):
    """No correction; |θ| is brought back to one, which moves nothing."""
    normalise(machine, y)
    return OK


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints."""
    return correct_tree(machine, t, y, read_state, factorise, apply_change)


# The residual in relative coordinates: accelerations from the ground outwards, wrenches inwards (recursive Newton–Euler; Luh, Walker,
# Paul 1980), one row a joint or modal velocity.
#
# One for all machines: joints carry rigid bodies and flexible ones at their interfaces, beams carry what slides along them, and any of
# these may have mass in common. What only some have is done by hooks of their nodes (`nivel.kernels.tree.tree_nodes`).


@family
def residual(machine, job, t):
    """Fill `residual.value` for `residual.y`, `vdot` and `lam`; see `nivel.kernels.residual.residual`."""
    record = record_at(machine)
    tree, own = record.tree, record.residual
    count = tree.node.shape[0]
    status = move_nodes(machine, t)
    if status == OK:
        status = read_markers(machine, t)
    if status != OK:
        return status
    load_weight(record.bodies)
    clear_frames(record.bodies)
    status = apply_forces(machine, t, own.y)
    if status != OK:
        return status
    call_hook(machine, MODES, LOAD * count, t)
    accelerate_nodes(machine, t)
    status = load_multipliers(machine, t)
    if status == OK:
        status = call_hook(machine, POINTS, 0, t)
    if status != OK:
        return status
    inertial_wrenches(machine)
    call_hook(machine, MODES, NEED * count, t)
    hand_inwards(machine, t)
    write_rows(machine, tree.column.shape[0])
    return OK
