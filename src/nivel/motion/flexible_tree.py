"""Relative coordinates with flexible bodies: joint coordinates of a spanning tree and modal coordinates of its flexible bodies.

As `nivel.motion.relative`, whose recursion also passes through the modes: see `nivel.kernels.tree.flexible_articulated`.
"""

from nivel.kernels.bodies.floating_dynamics import load_modes
from nivel.kernels.bodies.rigid import load_weight
from nivel.kernels.core.status import OK
from nivel.kernels.record.hook import apply_forces
from nivel.kernels.record.record import CORRECT, EVALUATE, record_at
from nivel.kernels.solve.saddle import factorise_rows
from nivel.kernels.tree.flexible_articulated import factorise_flexible_tree
from nivel.kernels.tree.flexible_tree import clear_frames, move_flexible_tree
from nivel.kernels.tree.flexible_whitening import (
    accelerate_flexible,
    whiten_flexible_efforts,
    whiten_flexible_tree_rows,
)
from nivel.motion.tree_motion import WIDTH, correct_tree, evaluate_tree, move_coordinates, normalise, read_markers
from nivel.native.entry import entry
from nivel.native.function import stage


@stage
def read_flexible_tree(machine, t, y):
    """Poses and velocities of bodies, frames and the markers in use, and the rows that are left. Returns a status."""
    move_flexible_tree(machine, y)
    return read_markers(machine, t)


@stage
def load_flexible_tree(machine, t, y):
    """All applied forces on bodies, frames and modes. Returns a status."""
    record = record_at(machine)
    load_weight(record.bodies)
    clear_frames(record.bodies)
    status = apply_forces(machine, t, y)
    load_modes(machine)
    return status


@stage
def factorise_flexible(machine, y):
    """Factors of the mass matrix and of S = W Wᵀ in the state last read; y is not needed for them here. Returns a status."""
    status = factorise_flexible_tree(machine)
    if status != OK or record_at(machine).saddle.block.shape[0] == 0:
        return status
    whiten_flexible_tree_rows(machine)
    return factorise_rows(machine, WIDTH)


@stage
def apply_change(machine, y, what):
    """Apply the change found to the positions, or to the velocities."""
    accelerate_flexible(machine, record_at(machine).tree.change)
    move_coordinates(machine, y, what)


@entry(EVALUATE)
def evaluate(machine, t, y, ydot):
    """ẏ. Leaves everything else in the record but what `nivel.kernels.tree.tree_outputs` adds for frames."""
    return evaluate_tree(
        machine,
        t,
        y,
        ydot,
        read_flexible_tree,
        load_flexible_tree,
        factorise_flexible,
        whiten_flexible_efforts,
        accelerate_flexible,
    )


@entry(CORRECT)
def normalise_state(machine, t, y):
    """No correction; |θ| is brought back to one, which moves nothing."""
    normalise(machine, y)
    return OK


@entry(CORRECT)
def correct(machine, t, y):
    """Direct correction of the state onto the constraints."""
    return correct_tree(machine, t, y, read_flexible_tree, factorise_flexible, apply_change)
